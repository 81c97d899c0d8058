// SPDX-License-Identifier: GPL-3.0-or-later
//
// `crackle run` in field time: the quasi-static stage from a case to its run folder.
#include "run_quasi_static.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "crackle/core/errors.hpp"
#include "crackle/core/version.hpp"
#include "progress.hpp"
#include "quasi_static_scene.hpp"
#include "signals.hpp"

namespace crackle {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

FieldTimeRow history_row(const QuasiStaticRow& row, const Case& scene) {
  constexpr double wings = 2.0;
  FieldTimeRow h;
  h.time = row.time;
  h.time_step = row.step;
  h.pressure = row.well_pressure;
  h.rate = row.rate * wings * scene.well.height;
  h.perforation_rate = row.perforation_rate * wings;
  h.fracture_pressure = row.fracture_pressure;
  h.least_pressure = row.least_pressure;
  h.injected = row.injected * wings;
  h.well_stored = row.well_stored * wings;
  h.fracture_volume = row.fracture_volume * wings;
  h.leaked = row.leaked * wings;
  h.mass_defect = row.mass_defect * wings;
  h.broken_length = row.broken_length;
  h.damaged_length = row.damaged_length;
  h.half_length = 0.5 * (row.broken_length + row.damaged_length);
  h.opening = row.opening;
  h.mean_opening = row.mean_opening;
  h.contact_fraction = row.contact_fraction;
  h.closure_stress = scene.rock.pore_pressure - scene.stress.yy;
  h.energy_fracture = 2.0 * row.dissipated;
  h.iterations = row.iterations;
  return h;
}

FieldFrame field_frame(const QuasiStatic& stage, const std::vector<std::string>& fields) {
  const auto wanted = [&](const char* name) {
    return fields.empty() || std::find(fields.begin(), fields.end(), name) != fields.end();
  };
  const Mesh& mesh = *stage.scene().mesh;
  FieldFrame frame;
  frame.time = stage.time();
  const std::vector<Vec2> moved = stage.corner_displacement();
  Field displacement{"displacement_m", 2, {}}, stress{"stress_Pa", 3, {}}, region{"region", 1, {}};
  for (Index t = 0; t < mesh.triangle_count(); ++t) {
    frame.triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec2 u = moved[3 * at(t) + i];
      frame.points.push_back(mesh.vertices[at(mesh.triangles[at(t)][i])] + u);
      for (const double value : {u.x, u.y}) displacement.add(value);
    }
    region.add(static_cast<double>(mesh.regions[at(t)]));
  }
  for (const Sym2& s : stage.stress(moved))
    for (const double value : {s.xx, s.yy, s.xy}) stress.add(value);
  if (wanted("displacement_m")) frame.point_fields.push_back(std::move(displacement));
  if (wanted("stress_Pa")) frame.cell_fields.push_back(std::move(stress));
  if (wanted("region")) frame.cell_fields.push_back(std::move(region));
  return frame;
}

FractureFrame fracture_frame(const QuasiStatic& stage) {
  const Mesh& mesh = *stage.scene().mesh;
  FractureFrame frame;
  frame.time = stage.time();
  Field opening{"opening_m", 1, {}}, slip{"slip_m", 1, {}}, damage{"damage", 1, {}}, mode{"mode", 1, {}},
      pressure{"pressure_Pa", 1, {}}, broken{"broken", 1, {}}, leaked{"leaked_m", 1, {}};
  const std::vector<FractureCell> cells = stage.cells();
  for (std::size_t c = 0; c < cells.size(); ++c) {
    const FractureCell& cell = cells[c];
    if (!cell.wet) continue;
    const auto p = static_cast<Index>(frame.points.size());
    for (const Index v : stage.path().edges()[c].vertex) frame.points.push_back(mesh.vertices[at(v)]);
    frame.lines.push_back({p, p + 1});
    const bool is_broken = std::min(cell.damage[0], cell.damage[1]) >= 1.0;
    opening.add(0.5 * (cell.opening[0] + cell.opening[1]));
    slip.add(0.0);
    damage.add(0.5 * (cell.damage[0] + cell.damage[1]));
    mode.add(is_broken ? static_cast<double>(FailureMode::tensile) : 0.0);
    pressure.add(cell.pressure);
    broken.add(is_broken ? 1.0 : 0.0);
    leaked.add(0.5 * cell.leaked / cell.length);
  }
  frame.cell_fields = {std::move(opening),  std::move(slip),   std::move(damage), std::move(mode),
                       std::move(pressure), std::move(broken), std::move(leaked)};
  return frame;
}

}  // namespace

int run_quasi_static(const RunOptions& options, const Case& scene, RunFolder& folder, Status& status) {
  heed_stops();
  folder.set_field_time();
  const auto say = [&](const std::string& line) {
    folder.log(line);
    if (!options.quiet) fmt::print(stderr, "{}\n", line);
  };
  const auto start = std::chrono::steady_clock::now();
  const QuasiStaticScene stage_scene =
      make_quasi_static_scene(scene, std::make_shared<const Mesh>(make_quasi_static_mesh(scene)));
  const Index triangles = stage_scene.mesh->triangle_count();
  say(fmt::format("mesh: {} triangles, {} vertices, half of the domain", triangles,
                  stage_scene.mesh->vertex_count()));
  for (const std::string& line : quasi_static_notes(scene, stage_scene)) say(line);
  QuasiStatic stage(stage_scene);
  say(fmt::format("rock factorised, initial fracture in equilibrium ({:.1f} s)", seconds_since(start)));
  folder.write_resolved(scene);
  const auto write_frame = [&] {
    folder.write_frame(field_frame(stage, scene.output.fields), fracture_frame(stage));
  };

  const double late = 0.9 * scene.run.end_time;
  RunSummary summary;
  summary.triangles = triangles;
  summary.magnitude_min = summary.magnitude_max = std::numeric_limits<double>::quiet_NaN();
  double late_sum = 0.0, late_time = 0.0, next_frame = 0.0, worst = 0.0;
  QuasiStaticRow row;
  Progress progress(scene.run.end_time, options.quiet);
  const auto now = [&] {
    return Progress::Now{row.time, row.well_pressure, summary.steps,
                         static_cast<std::int64_t>(stage.cells().size())};
  };
  const auto finish = [&](const std::string& exit) {
    write_frame();
    if (late_time > 0.0) summary.propagation_pressure = late_sum / late_time;
    summary.broken_length = 2.0 * row.broken_length;
    summary.extent_x = 2.0 * row.broken_length;
    summary.energy_residual_max = std::numeric_limits<double>::quiet_NaN();
    summary.mass_residual_max = worst;
    summary.wall = seconds_since(start);
    summary.core_ns_per_triangle_step =
        1e9 * summary.wall /
        (static_cast<double>(triangles) * static_cast<double>(std::max<std::int64_t>(1, summary.steps)));
    summary.exit = exit;
    folder.write_quakeml({}, scene);
    folder.write_summary(summary);
    progress.finish(now());
  };
  std::string exit = "done";
  try {
    while (stage.time() < scene.run.end_time && !stop_requested()) {
      if (stage.time() >= next_frame) {
        write_frame();
        next_frame += scene.output.fields_every *
                      std::ceil((stage.time() - next_frame) / scene.output.fields_every + 1e-12);
      }
      row = stage.step(scene.run.end_time);
      folder.append_field_time(history_row(row, scene));
      worst = std::max(worst, std::abs(row.mass_defect) / std::max(row.injected, 1e-12));
      if (row.well_pressure > summary.breakdown_pressure || summary.steps == 0) {
        summary.breakdown_pressure = row.well_pressure;
        summary.breakdown_time = row.time;
      }
      if (row.time >= late) {
        late_sum += row.well_pressure * row.step;
        late_time += row.step;
      }
      ++summary.steps;
      progress.show(now());
      status.show(now());
    }
  } catch (const NumericalError& error) {
    finish(error.what());
    folder.log(error.what());
    throw;
  }
  if (stage.time() < scene.run.end_time) exit = "interrupted";
  finish(exit);
  say(fmt::format(
      "{} steps, {} Newton iterations, {} steps taken back; mass balance {:.1e} of what was injected; "
      "{:.1f} s",
      summary.steps, stage.newton_iterations(), stage.rejected_steps(), worst, summary.wall));
  say(fmt::format(
      "highest pressure {:.3f} MPa at {:.4g} s; fracture of {:.2f} m (both wings), {:.3f} mm open at the "
      "well at the end",
      1e-6 * summary.breakdown_pressure, summary.breakdown_time, summary.broken_length, 1e3 * row.opening));
  say(fmt::format("{}: {}", exit, folder.path()));
  return exit == "done" ? 0 : static_cast<int>(ExitCode::interrupted);
}

}  // namespace crackle
