// SPDX-License-Identifier: GPL-3.0-or-later
#include "forecast.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <optional>
#include <system_error>
#include <vector>

#include "crackle/core/errors.hpp"
#include "crackle/solve/lanczos.hpp"
#include "crackle/solve/scene_warnings.hpp"
#include "crackle/solve/tiles.hpp"
#include "frames.hpp"
#include "regime.hpp"

namespace crackle {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

// Measured on runs of the granite wellbore, mean of 21 frames; bytes a triangle: places, and fields.
struct FrameBytes {
  double base, displacement, velocity, stress;
};
constexpr FrameBytes frame_split{44.7, 20.6, 23.0, 10.2}, frame_on_demand{14.3, 4.2, 4.2, 10.3};
constexpr FrameBytes frame_field_time{19.0, 8.5, 0.0, 9.5};
constexpr double history_row = 270.0, history_row_field_time = 450.0;
constexpr double frame_heads = 7e3, other_files = 6e3;  // of fields and fractures; log, case, summary
// A run in field time takes some hundred steps a stage of its pump.
constexpr double rows_field_time = 600.0;
constexpr double checkpoint_triangle = 510.0,
                 checkpoint_triangle_field_time = 100.0;  // there the mesh for the most
constexpr double frame_seconds_per_byte = 1.3e-8;         // of the file, most of it compression

// The geostatic solve where it is not timed: it grows faster than the mesh (fill of the factor). Measured at
// 1e5 and 2e6 triangles.
constexpr double solve_seconds_at_1e5 = 1.1, solve_growth = 1.42;
// Steps of a run that breaks over those of whole rock, on demand: granite wellbore, 1e5 triangles.
constexpr double with_fractures = 1.6;

constexpr int timed_steps = 24;

// Years for any mesh worth a run.
constexpr double most_steps = 1e11;

/// Wall time [s] that one call takes when nothing else disturbs it: the lower quartile of some.
template <class Work>
double undisturbed_seconds(int calls, const Work& work) {
  std::vector<double> seconds;
  for (int i = 0; i < calls; ++i) {
    const auto start = std::chrono::steady_clock::now();
    work();
    seconds.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  std::sort(seconds.begin(), seconds.end());
  return seconds[seconds.size() / 4];
}

RunOutput output_of(const Case& scene, double triangles, const FrameBytes& bytes, double most_frames,
                    double history, double more_frames = 0.0) {
  const auto wanted = [&](const char* name) {
    const auto& fields = scene.output.fields;
    return fields.empty() || std::find(fields.begin(), fields.end(), name) != fields.end();
  };
  double frame = bytes.base;
  if (wanted("displacement_m")) frame += bytes.displacement;
  if (wanted("velocity_m_s")) frame += bytes.velocity;
  if (wanted("stress_Pa")) frame += bytes.stress;
  const double frames =
      1.0 + more_frames +
      std::min(most_frames, std::ceil(scene.run.end_time / scene.output.fields_every - 1e-9));
  return {(frame * triangles + frame_heads) * frames + history + other_files,
          static_cast<std::int64_t>(frames)};
}

// The rock of a scene as its run begins, at rest.
struct WholeRock {
  State state;
  Bulk bulk;
  std::optional<Cohesive> cohesive;

  explicit WholeRock(const Scene& scene)
      : state(scene.law && !scene.insertion.on_demand ? make_split_state(scene.mesh)
                                                      : make_tied_state(scene.mesh)),
        bulk(bulk_of(scene, scene.damping)) {
    set_mass(state, bulk);
    if (!scene.absorbing_boundary && !scene.free_boundary && scene.loads.empty())
      fix_nodes(state, EdgeKind::outer);
    if (!scene.law) return;
    const EdgeMaterials materials = edge_materials(scene);
    if (!scene.insertion.on_demand) {
      insert_all(state);
      set_materials(state, scene, materials);
    }
    cohesive.emplace(scene.law, materials.all);
  }
};

// Nothing slips in its geostatic stage, whatever the scene is.
Scene without_stress(Scene scene) {
  scene.stress = {};
  for (RockMass& layer : scene.layers) layer.stress = {};
  scene.initial_pressure = 0.0;
  if (scene.fluid) scene.fluid->reference_pressure = 0.0;
  return scene;
}

// A step of the rock alone [s].
double step_of_rock(const Scene& scene, double dt) {
  WholeRock rock(without_stress(scene));
  if (rock.bulk.viscous()) rock.state.strain_rate.resize(at(block_count(scene.mesh->triangle_count())));
  const Tiles::Physics physics{rock.bulk, rock.cohesive ? &*rock.cohesive : nullptr};
  Tiles tiles(rock.state, physics);
  const bool screened = scene.insertion.on_demand || scene.damage.law;
  std::vector<std::uint8_t> stressed(screened ? scene.mesh->triangles.size() : 0);
  std::vector<char> tile_stressed(at(block_count(scene.mesh->triangle_count())));
  const StressScreen screen{scene.cohesive.tensile_strength, scene.cohesive.cohesion,
                            scene.cohesive.tan_friction};
  const auto step = [&] { tiles.move(rock.state, physics, dt, screen, stressed, tile_stressed); };
  step();  // first touch of the memory
  return undisturbed_seconds(timed_steps, step);
}

// When the wall of the wellbore comes to the share of its strength at which elements are inserted [s].
double ramp_end_by_theory(Scene scene, double end_time) {
  scene.cohesive.tensile_strength *= scene.insertion.threshold;
  const Onset onset = expected_onset(scene, end_time);
  return onset.expected ? std::min(onset.time, end_time) : 0.0;
}

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

RunOutput output_of_run(const Case& scene, double triangles, const Steps& steps) {
  const double count = static_cast<double>(steps.count);
  const FrameBytes& bytes = scene.cohesive.insertion == "all" ? frame_split : frame_on_demand;
  return output_of(scene, triangles, bytes, count,
                   history_row * std::min(scene.run.end_time / scene.output.history_every, count));
}

RunOutput output_of_field_time(const Case& scene, double triangles) {
  const auto& pump = scene.fluid.pump;
  const auto shut_ins = std::ranges::count_if(pump, [&](const Case::PumpStage& ending) {
    const auto goes_on = [&](const Case::PumpStage& p) { return p.from <= ending.to && ending.to < p.to; };
    return ending.to < scene.run.end_time && std::ranges::none_of(pump, goes_on);
  });
  return output_of(scene, triangles, frame_field_time, rows_field_time,
                   rows_field_time * history_row_field_time, static_cast<double>(shut_ins));
}

void require_disk(const Case& scene, double triangles, const RunOutput& output, const std::string& folder) {
  if (scene.output.max_bytes > 0.0 && output.bytes > scene.output.max_bytes) {
    throw CaseError(
        scene.file, 0, 0,
        fmt::format("the run would write {} in {} frames, more than output.max_bytes allows, {}: write "
                    "fewer frames ([output] fields_every) or fields",
                    bytes_text(output.bytes), output.frames, bytes_text(scene.output.max_bytes)));
  }
  std::error_code unknown;
  const auto space = std::filesystem::space(folder, unknown);
  if (unknown) return;
  // Two checkpoints and a third that is being written.
  const double a_triangle = in_field_time(scene) ? checkpoint_triangle_field_time : checkpoint_triangle;
  const double needed = output.bytes + 3.0 * a_triangle * triangles;
  const double available = static_cast<double>(space.available);
  if (needed <= available) return;
  throw CaseError(scene.file, 0, 0,
                  fmt::format("the run would write {} in {} frames and {} are free in {}: write fewer frames "
                              "([output] fields_every) or fields, or give another folder with -o DIR",
                              bytes_text(needed), output.frames, bytes_text(available), folder));
}

Steps steps_of_run(const Case& scene, const StableStep& stable, const Mesh& mesh, bool allow_unstable) {
  double dt = scene.run.safety * stable.limit;
  if (scene.run.time_step > 0.0) {
    dt = scene.run.time_step;
    if (dt > stable.limit && !allow_unstable) {
      throw CaseError(
          scene.file, 0, 0,
          fmt::format("run.time_step = {:.3g} s is above the {}; write \"auto\"", dt, stable.explain(mesh)));
    }
  }
  const double count = std::max(1.0, std::ceil(scene.run.end_time / dt - 1e-9));
  if (count > most_steps) {
    throw CaseError(
        scene.file, 0, 0,
        fmt::format("run.end_time = {:.3g} s takes {:.1e} steps, more than the {:.0e} that can be "
                    "waited for: {}",
                    scene.run.end_time, count, most_steps, stable.explain(mesh)));
  }
  return {static_cast<std::int64_t>(count), scene.run.end_time / count};
}

StableStep stable_step_of(const Scene& scene) {
  const WholeRock rock(scene);
  if (!scene.law) {
    const StableStep proven = stable_step(rock.state, rock.bulk, nullptr);
    return scene.damage.law ? sharpened(proven, rock.state, rock.bulk, nullptr) : proven;
  }
  StableStep stable = stable_step(rock.state, rock.bulk, &*rock.cohesive);
  if (scene.insertion.on_demand) stable.limit *= scene.insertion.step;
  return stable;
}

std::string needs_text(const Case& scene, double triangles, const RunOutput& output) {
  const RunMemoryUse use = memory_of_run(scene, triangles);
  return fmt::format("{} of memory{}; {} of output in {} frames", bytes_text(use.run),
                     scene.output.checkpoint_every > 0.0 && use.checkpoint > use.run
                         ? fmt::format(", {} while a checkpoint is written", bytes_text(use.checkpoint))
                         : "",
                     bytes_text(output.bytes), output.frames);
}

WallTime wall_time_of_run(const Case& scene, const Scene& solver_scene, const Steps& steps, int threads) {
  const Index triangles = solver_scene.mesh->triangle_count();
  WallTime time;
  time.output = frame_seconds_per_byte * output_of_run(scene, triangles, steps).bytes;
  time.simulated = triangles <= largest_solved_mesh;
  double step = 0.0;
  if (time.simulated) {
    const auto start = std::chrono::steady_clock::now();
    Simulation simulation(solver_scene.may_ramp() ? solver_scene : without_stress(solver_scene));
    time.start = seconds_since(start);
    time.ramp_end = std::min(simulation.ramp_end(), scene.run.end_time);
    simulation.step(steps.length);  // first touch of the memory
    step = undisturbed_seconds(timed_steps, [&] { simulation.step(steps.length); });
    const double row =
        undisturbed_seconds(timed_steps / 4, [&] { simulation.step_and_account(steps.length); });
    const double rows = std::min(1.0, steps.length / scene.output.history_every);  // a step
    step += rows * std::max(0.0, row - step);
  } else {
    if (solver_scene.may_ramp()) time.ramp_end = ramp_end_by_theory(solver_scene, scene.run.end_time);
    time.start = solve_seconds_at_1e5 * std::pow(1e-5 * triangles, solve_growth);
    step = step_of_rock(solver_scene, steps.length);
  }
  time.core_ns = 1e9 * step * threads / static_cast<double>(triangles);
  time.count = steps.after(time.ramp_end);
  time.steps = step * static_cast<double>(time.count);
  const Onset onset = expected_onset(solver_scene, scene.run.end_time);
  time.breaks = solver_scene.insertion.on_demand && onset.expected && onset.time < scene.run.end_time;
  if (time.breaks) time.steps *= with_fractures;
  return time;
}

std::string bytes_text(double bytes) {
  const int power = bytes < 1e6 ? 1 : bytes < 1e9 ? 2 : 3;
  const double value = bytes / std::pow(1e3, power);
  return fmt::format("{:.{}f} {}B", value, value < 10.0 ? 1 : 0, " kMG"[power]);
}

std::string duration_text(double seconds) {
  const double s = std::round(seconds);
  if (seconds < 1.0) return "under 1 s";
  if (s < 60.0) return fmt::format("{:.0f} s", s);
  if (s < 3600.0) return fmt::format("{:.0f} min {:02.0f} s", std::floor(s / 60.0), std::fmod(s, 60.0));
  if (s < 48.0 * 3600.0) {
    return fmt::format("{:.0f} h {:02.0f} min", std::floor(s / 3600.0),
                       std::floor(std::fmod(s, 3600.0) / 60.0));
  }
  return fmt::format("{:.0f} days", s / 86400.0);
}

}  // namespace crackle
