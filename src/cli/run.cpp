// SPDX-License-Identifier: GPL-3.0-or-later
//
// `crackle run`: a case from its file to its run folder.
#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <limits>

#include "commands.hpp"
#include "crackle/core/errors.hpp"
#include "crackle/core/version.hpp"
#include "crackle/io/case.hpp"
#include "crackle/io/output.hpp"
#include "crackle/solve/scene_warnings.hpp"
#include "forecast.hpp"
#include "frames.hpp"
#include "joints.hpp"
#include "load.hpp"
#include "progress.hpp"
#include "scene.hpp"
#include "status.hpp"

namespace crackle {
namespace {

volatile std::sig_atomic_t interrupted = 0;
void interrupt(int) { interrupted = 1; }

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// Counts, extents and pressures that end up in summary.json.
class Tally {
 public:
  explicit Tally(double end_time) : late_(0.9 * end_time) {
    summary_.magnitude_min = summary_.magnitude_max = std::numeric_limits<double>::quiet_NaN();
  }
  void event(const SeismicEvent& e) {
    if (e.kind == EventKind::breaking) broke(e);
    summary_.magnitude_min = std::fmin(summary_.magnitude_min, e.magnitude);
    summary_.magnitude_max = std::fmax(summary_.magnitude_max, e.magnitude);
    ++summary_.events;
  }
  void pressure(double time, double value, double dt) {
    if (value > summary_.breakdown_pressure || summary_.steps == 0) {
      summary_.breakdown_pressure = value;
      summary_.breakdown_time = time;
    }
    if (time >= late_) {
      late_sum_ += value * dt;
      late_time_ += dt;
    }
    ++summary_.steps;
  }
  void residual(double r) { summary_.energy_residual_max = std::max(summary_.energy_residual_max, r); }
  std::int64_t broken(FailureMode mode) const { return broken_[static_cast<std::size_t>(mode)]; }
  std::int64_t broken() const { return broken_[1] + broken_[2] + broken_[3]; }
  RunSummary finish() const {
    RunSummary s = summary_;
    if (late_time_ > 0.0) s.propagation_pressure = late_sum_ / late_time_;
    return s;
  }

 private:
  void broke(const SeismicEvent& e) {
    ++broken_[static_cast<std::size_t>(e.mode)];
    summary_.broken_length += e.length;
    low_ = {std::min(low_.x, e.place.x), std::min(low_.y, e.place.y)};
    high_ = {std::max(high_.x, e.place.x), std::max(high_.y, e.place.y)};
    summary_.extent_x = high_.x - low_.x;
    summary_.extent_y = high_.y - low_.y;
  }

  RunSummary summary_;
  std::array<std::int64_t, 4> broken_{};
  Vec2 low_{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  Vec2 high_{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  double late_, late_sum_ = 0.0, late_time_ = 0.0;
};

// Says when an output at regular times is due: at the step nearest to each.
class Due {
 public:
  explicit Due(double interval) : interval_(interval) {}
  bool is(double time, double dt) {
    if (time + 0.5 * dt < interval_ * static_cast<double>(next_)) return false;
    next_ = static_cast<std::int64_t>(std::floor((time + 0.5 * dt) / interval_)) + 1;
    return true;
  }

 private:
  double interval_;
  std::int64_t next_ = 0;
};

HistoryRow history_row(const Simulation& s, const Energies& e, const Tally& tally, double time, double dt,
                       double pressure) {
  HistoryRow row;
  row.time = time;
  row.time_step = dt;
  row.pressure = pressure;
  row.injection_rate = s.scene().pump.rate(time);
  if (s.fluid() != nullptr && !s.state().fluid.cavities.empty()) {
    row.injected = s.state().fluid.cavities.front().injected;
    row.cavity_volume = s.state().fluid.cavities.front().volume;
    row.wetted_length = s.fluid()->wetted_length(s.state());
  }
  row.broken_tensile = tally.broken(FailureMode::tensile);
  row.broken_shear = tally.broken(FailureMode::shear);
  row.broken_mixed = tally.broken(FailureMode::mixed);
  row.energy_kinetic = e.kinetic;
  row.energy_strain = e.strain;
  row.energy_cohesive = e.cohesive;
  row.energy_fracture = e.fracture;
  row.energy_friction = e.friction;
  row.energy_viscous = e.viscous;
  row.energy_fluid = e.fluid;
  row.work_external = e.external;
  row.energy_residual = e.residual;
  return row;
}

int run_in_folder(const RunOptions& options, const Case& scene, RunFolder& folder, Status& status) {
  const int threads = options.threads > 0 ? options.threads : omp_get_num_procs();
  omp_set_num_threads(threads);
  const auto say = [&](const std::string& line) {
    folder.log(line);
    if (!options.quiet) fmt::print(stderr, "{}\n", line);
  };
  say(fmt::format("crackle {}: {}", version, scene.title.empty() ? options.case_file : scene.title));

  const auto start = std::chrono::steady_clock::now();
  NetworkReport network;
  auto mesh = std::make_shared<const Mesh>(excavate(make_mesh(scene, &network)));
  say(fmt::format("mesh: {} triangles, {} vertices ({:.1f} s)", mesh->triangle_count(), mesh->vertex_count(),
                  seconds_since(start)));
  if (network.joints > 0) say(network_text(network));
  if (network.joints > 0) throw CaseError(scene.file, 0, 0, "joints can be meshed but not simulated yet");
  require_memory(scene, mesh->triangle_count());  // known only now for a mesh from a file
  const Scene solver_scene = make_scene(scene, mesh);
  if (const std::string error = scene_error(solver_scene); !error.empty())
    throw CaseError(scene.file, 0, 0, error);
  const auto settle_start = std::chrono::steady_clock::now();
  Simulation simulation(solver_scene);
  say(fmt::format(
      "geostatic stage and excavation: unbalanced force {:.1e} of the largest{} ({:.1f} s)",
      simulation.imbalance(),
      simulation.geostatic_slips() > 0
          ? fmt::format(", {} elements slipped or broke and came to rest", simulation.geostatic_slips())
          : "",
      seconds_since(settle_start)));
  say(simulation.stable().explain(*mesh));
  for (const std::string& line : scene_warnings(solver_scene, scene.run.end_time, simulation.stable()))
    say(line);

  double dt = scene.run.safety * simulation.stable().limit;
  if (scene.run.time_step > 0.0) {
    dt = scene.run.time_step;
    if (dt > simulation.stable().limit) {
      throw CaseError(scene.file, 0, 0,
                      fmt::format("run.time_step = {:.3g} s is above the {}; write \"auto\"", dt,
                                  simulation.stable().explain(*mesh)));
    }
  }
  const auto steps =
      std::max<std::int64_t>(1, static_cast<std::int64_t>(std::ceil(scene.run.end_time / dt - 1e-9)));
  dt = scene.run.end_time / static_cast<double>(steps);
  say(fmt::format("{} steps of {:.3g} s on {} threads", steps, dt, threads));

  folder.write_resolved(scene);
  const auto write_frame = [&] {
    folder.write_frame(field_frame(simulation, scene.output.fields), fracture_frame(simulation));
  };

  std::signal(SIGINT, interrupt);
  std::signal(SIGTERM, interrupt);
  Tally tally(scene.run.end_time);
  std::vector<SeismicEvent> events;
  Progress progress(scene.run.end_time, options.quiet);
  const auto now = [&] {
    return Progress::Now{simulation.state().time, simulation.wellbore_pressure(), simulation.state().step,
                         tally.broken()};
  };
  const auto note = [&](const std::vector<SeismicEvent>& happened) {
    for (const SeismicEvent& e : happened) {
      folder.append_event(e);
      events.push_back(e);
      tally.event(e);
    }
  };
  std::string exit = "done";
  int code = 0;
  double loop_wall = 0.0;
  const auto loop_start = std::chrono::steady_clock::now();
  double output_wall = 0.0;
  const auto timed_output = [&](const auto& work) {
    const auto t = std::chrono::steady_clock::now();
    work();
    output_wall += seconds_since(t);
  };
  const auto finish = [&] {
    timed_output(write_frame);
    loop_wall = seconds_since(loop_start) - output_wall;
    RunSummary summary = tally.finish();
    summary.triangles = mesh->triangle_count();
    summary.steps = simulation.state().step;
    summary.wall = seconds_since(start);
    summary.core_ns_per_triangle_step = 1e9 * loop_wall * threads /
                                        (static_cast<double>(summary.triangles) *
                                         static_cast<double>(std::max<std::int64_t>(1, summary.steps)));
    summary.exit = exit;
    folder.write_quakeml(events, scene);
    folder.write_summary(summary);
    progress.finish(now());
    return summary;
  };
  try {
    Due history(scene.output.history_every), fields(scene.output.fields_every);
    while (interrupted == 0) {
      const double time = simulation.state().time;
      const double left = scene.run.end_time - time;
      if (left <= 0.5e-9 * scene.run.end_time) break;
      // Shorter than planned where faces have come into general contact, and to land on the end.
      double now_dt = std::min(dt, scene.run.safety * simulation.stable_limit());
      const bool last = left <= now_dt * (1.0 + 1e-9);
      if (last) now_dt = left;
      if (fields.is(time, now_dt)) timed_output(write_frame);
      const double pressure = simulation.wellbore_pressure();
      if (history.is(time, now_dt) || last) {
        const Energies e = simulation.step_and_account(now_dt);
        tally.residual(e.residual);
        folder.append_history(history_row(simulation, e, tally, time, now_dt, pressure));
        if (e.residual > 1e-2) {
          throw NumericalError(
              fmt::format("energy residual {:.3g} passes 1e-2 at step {}, time {:.6g} s, step size {:.3g} s "
                          "(stable: {:.3g} s): take a smaller run.safety",
                          e.residual, simulation.state().step, time, now_dt, simulation.stable_limit()));
        }
      } else {
        simulation.step(now_dt);
      }
      note(simulation.new_events());
      tally.pressure(time, pressure, now_dt);
      progress.show(now());
      status.show(now());
    }
  } catch (const NumericalError& error) {
    exit = error.what();
    finish();
    folder.log(exit);
    throw;
  }
  if (interrupted == 0) {
    note(simulation.end_slips());
  } else {
    exit = "interrupted";
    code = static_cast<int>(ExitCode::interrupted);
  }
  const RunSummary summary = finish();

  std::string parts;
  for (int p = 0; p < Stopwatch::parts; ++p) {
    const double share =
        simulation.stopwatch().seconds(static_cast<Stopwatch::Part>(p)) / std::max(loop_wall, 1e-9);
    parts += fmt::format("{}{} {:.0f} %", p > 0 ? ", " : "", Stopwatch::names[static_cast<std::size_t>(p)],
                         100.0 * share);
  }
  say(fmt::format("time: {:.1f} s in steps ({}), {:.1f} s in output; {:.1f} core-ns per triangle and step",
                  loop_wall, parts, output_wall, summary.core_ns_per_triangle_step));
  say(fmt::format(
      "breakdown {:.3f} MPa at {:.4f} ms, propagation {:.3f} MPa; {} broken elements, {:.3f} m; energy "
      "residual {:.1e}",
      1e-6 * summary.breakdown_pressure, 1e3 * summary.breakdown_time, 1e-6 * summary.propagation_pressure,
      tally.broken(), summary.broken_length, summary.energy_residual_max));
  say(fmt::format("{}: {}", exit, folder.path()));
  return code;
}

}  // namespace

int run_command(const RunOptions& options) {
  const Case scene = load_case(options.case_file, options.overrides, options.seed);
  require_memory(scene);
  const std::string path =
      options.output.empty()
          ? (std::filesystem::path("runs") / std::filesystem::path(options.case_file).stem()).string()
          : options.output;
  RunFolder folder(path);
  Status status(folder, scene.run.end_time);
  try {
    const int code = run_in_folder(options, scene, folder, status);
    status.finish(code == 0 ? "done" : "interrupted");
    return code;
  } catch (const std::exception& error) {
    try {
      status.finish("failed", error.what());
    } catch (const CaseError&) {  // what went wrong first is what the user has to know
    }
    throw;
  }
}

}  // namespace crackle
