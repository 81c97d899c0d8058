// SPDX-License-Identifier: GPL-3.0-or-later
//
// `crackle check`: what a run of a case would be, without running it.
#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <sstream>

#include "commands.hpp"
#include "crackle/core/errors.hpp"
#include "crackle/core/version.hpp"
#include "crackle/solve/scene_warnings.hpp"
#include "forecast.hpp"
#include "joints.hpp"
#include "layers.hpp"
#include "load.hpp"
#include "parameters.hpp"
#include "quasi_static_scene.hpp"
#include "regime.hpp"
#include "scene.hpp"
#include "threads.hpp"

namespace crackle {
namespace {

void print_mesh(const Case& scene, const Mesh& with_core, const Mesh& mesh, const NetworkReport& network,
                double seconds) {
  fmt::print("\nMesh, by {} ({:.1f} s)\n", scene.mesh.file.empty() ? scene.mesh.generator : scene.mesh.file,
             seconds);
  const auto interior = std::count_if(mesh.edges.begin(), mesh.edges.end(),
                                      [](const Edge& e) { return e.kind == EdgeKind::interior; });
  const MeshMeasure measure = measure_mesh(mesh);
  const std::string& insertion = scene.cohesive.insertion;
  fmt::print("  {} triangles, {} vertices, {} edges{}\n", mesh.triangle_count(), mesh.vertex_count(),
             mesh.edge_count(),
             insertion == "all"         ? fmt::format(", {} of them with a cohesive element", interior)
             : insertion == "on_demand" ? fmt::format(", {} of them may receive a cohesive element", interior)
                                        : "");
  if (measure.wellbore_edges > 0) {
    fmt::print("  wellbore of {} edges; {} triangles of its core are excavated\n", measure.wellbore_edges,
               with_core.triangle_count() - mesh.triangle_count());
  }
  const MeshRecipe recipe = mesh_recipe(scene);
  const MeshQuality quality = measure_quality(mesh, scene.mesh.file.empty() ? &recipe : nullptr);
  fmt::print("  edges from {:.3g} to {:.3g} mm, half of them below {:.3g} mm\n", 1e3 * quality.min_edge,
             1e3 * quality.max_edge, 1e3 * measure.edge);
  if (scene.mesh.file.empty()) {
    fmt::print("  edge over target size: {:.2f} on average, {:.2f} at most\n", quality.mean_size_ratio,
               quality.max_size_ratio);
  }
  fmt::print("  smallest angle {:.1f} degrees\n", quality.min_angle_deg);
  if (!scene.layers.empty()) fmt::print("  {}\n", layers_text(scene, mesh));
  std::istringstream lines(network_text(network));
  for (std::string line; std::getline(lines, line);) fmt::print("  {}\n", line);
}

void print_onset(const Scene& scene, double end_time) {
  const Onset onset = expected_onset(scene, end_time);
  if (!onset.expected || onset.end_pressure < onset.wall_pressure) return;  // the warnings say so
  fmt::print(
      "\nTheory\n  the wellbore wall breaks from {:.2f} MPa (Hubbert-Willis), reached after {:.3g} ms in "
      "elastic rock\n",
      1e-6 * onset.wall_pressure, 1e3 * onset.time);
}

void print_cost(const Case& scene, const Mesh& mesh, const Steps& steps, const WallTime& time, double meshing,
                int threads) {
  fmt::print("\nCost\n");
  fmt::print("  {}; {} of memory are available\n",
             needs_text(scene, mesh.triangle_count(), output_of_run(scene, mesh.triangle_count(), steps)),
             bytes_text(available_memory()));
  fmt::print("  wall time about {} on {} thread{}: mesh {}, geostatic stage {}, steps {}, output {}\n",
             duration_text(meshing + time.total()), threads, threads == 1 ? "" : "s", duration_text(meshing),
             duration_text(time.start), duration_text(time.steps), duration_text(time.output));
  if (time.ramp_end > 0.0) {
    fmt::print("    (the elastic ramp to about {:.3g} ms is static solves: {} steps are left)\n",
               1e3 * time.ramp_end, time.count);
  }
  fmt::print(
      "    ({:.1f} core-ns per triangle and step, timed just now on intact rock{}; {}a busy machine adds to "
      "it)\n",
      time.core_ns, time.simulated ? "" : ", the static solves not timed",
      time.breaks ? "taken as more with fractures; " : "");
}

void check_quasi_static(const Case& scene) {
  NetworkReport network;
  const auto mesh = std::make_shared<const Mesh>(make_quasi_static_mesh(scene, &network));
  const QuasiStaticScene stage = make_quasi_static_scene(scene, mesh);
  fmt::print("\nMesh: {}\n", quasi_static_mesh_text(scene, stage));
  if (const std::string joints = network_text(network); !joints.empty()) fmt::print("{}\n", joints);
  fmt::print("\nNumbers and warnings\n");
  for (const std::string& line : quasi_static_notes(scene, stage)) fmt::print("  {}\n", line);
  fmt::print("\nCost\n  {}; {} of memory are available\n",
             needs_text(scene, mesh->triangle_count(), output_of_field_time(scene, mesh->triangle_count())),
             bytes_text(available_memory()));
}

}  // namespace

int check_command(const CheckOptions& options) {
  const RegimeChoice regime = choose_regime(load_case(options.case_file, options.overrides, options.seed));
  const Case& scene = regime.scene;
  require_memory(scene);
  const int threads = require_threads(options.threads);
  omp_set_num_threads(threads);

  fmt::print("crackle {}: {}\n", version, scene.title.empty() ? options.case_file : scene.title);
  fmt::print("\nParameters, in SI units; tension is positive\n{}", parameter_table(scene));
  fmt::print("\n{}\n", fmt::join(regime.reasons, "\n"));
  std::fflush(stdout);
  if (regime.quasi_static) {
    check_quasi_static(scene);
    return 0;
  }

  const auto start = std::chrono::steady_clock::now();
  NetworkReport network;
  const Mesh with_core = make_mesh(scene, &network);
  const auto mesh = std::make_shared<const Mesh>(excavate(with_core));
  const double meshing = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  require_memory(scene, mesh->triangle_count());
  print_mesh(scene, with_core, *mesh, network, meshing);

  const Scene solver_scene = make_scene(scene, mesh);
  if (const std::string error = scene_error(solver_scene); !error.empty()) {
    throw CaseError(scene.file, 0, 0, error);
  }
  const StableStep stable = stable_step_of(solver_scene);
  const Steps steps = steps_of_run(scene, stable, *mesh);
  fmt::print("\nTime step\n  {}\n  {} steps of {:.3g} s to {:.4g} s\n", stable.explain(*mesh), steps.count,
             steps.length, scene.run.end_time);
  print_onset(solver_scene, scene.run.end_time);
  std::fflush(stdout);
  print_cost(scene, *mesh, steps, wall_time_of_run(scene, solver_scene, steps, threads), meshing, threads);

  const std::vector<std::string> warnings = scene_warnings(solver_scene, scene.run.end_time, stable);
  fmt::print("\n{}\n", warnings.empty() ? "No warnings" : "Warnings");
  for (const std::string& line : warnings) fmt::print("  {}\n", line);
  return 0;
}

}  // namespace crackle
