// SPDX-License-Identifier: GPL-3.0-or-later
//
// `crackle run` by explicit steps: a simulation from a case to its run folder.
#include "run_dynamic.hpp"

#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include "checkpoint.hpp"
#include "crackle/core/errors.hpp"
#include "crackle/solve/guards.hpp"
#include "crackle/solve/scene_warnings.hpp"
#include "forecast.hpp"
#include "frames.hpp"
#include "joints.hpp"
#include "run_loop.hpp"
#include "scene.hpp"
#include "threads.hpp"

namespace crackle {
namespace {

HistoryRow history_row(Simulation& s, const Energies& e, const Tally& tally, double time, double dt,
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
  row.energy_inserted = e.inserted;
  row.energy_path = e.path;
  row.energy_residual = e.residual;
  for (const LoadRecord& load : s.take_loads()) row.loads.push_back({load.force, load.displacement});
  return row;
}

class DynamicRun final : public RunLoop {
 public:
  DynamicRun(const RunOptions& options, const Case& scene, RunFolder& folder, Status& status)
      : RunLoop(options, scene, folder, status),
        threads_(require_threads(options.threads)),
        history_(scene.output.history_every),
        fields_(scene.output.fields_every) {
    omp_set_num_threads(threads_);
    std::vector<std::string> loads;
    for (const Case::Load& load : scene.loads) loads.push_back(load.name);
    folder.set_loads(std::move(loads));
  }

 private:
  void begin() override {
    if (options_.resume.empty() || !resume()) settle();
  }

  void set_out() override {
    guards_.emplace(*simulation_, memory_.guards);
    if (options_.allow_unstable) say("--allow-unstable: what the guards find does not stop this run");
    loop_start_ = Clock::now();
    if (simulation_->state().step == 0) climb_ramp();
  }

  void arrive() override { note(simulation_->end_slips()); }

  Progress::Now now() const override {
    return {simulation_->state().time, simulation_->wellbore_pressure(), simulation_->state().step,
            tally_.broken()};
  }

  bool is_at_end() const override {
    return scene_.run.end_time - simulation_->state().time <= 0.5e-9 * scene_.run.end_time;
  }

  // Mesh and geostatic stage.
  void settle() {
    NetworkReport network;
    auto mesh = std::make_shared<const Mesh>(excavate(make_mesh(scene_, &network)));
    say(fmt::format("mesh: {} triangles, {} vertices ({:.1f} s)", mesh->triangle_count(),
                    mesh->vertex_count(), wall()));
    if (network.joints > 0) say(network_text(network));
    require_memory(scene_, mesh->triangle_count());  // known only now for a mesh from a file
    const Scene solver_scene = make_scene(scene_, mesh);
    if (const std::string error = scene_error(solver_scene); !error.empty())
      throw CaseError(scene_.file, 0, 0, error);
    const auto settle_start = Clock::now();
    simulation_ = std::make_unique<Simulation>(solver_scene);
    say(fmt::format(
        "geostatic stage and excavation: unbalanced force {:.1e} of the largest{} ({:.1f} s)",
        simulation_->imbalance(),
        simulation_->geostatic_slips() > 0
            ? fmt::format(", {} elements slipped or broke and came to rest", simulation_->geostatic_slips())
            : "",
        seconds_since(settle_start)));
    if (simulation_->ramp_end() > 0.0) {
      say(fmt::format(
          "elastic ramp by static solves to {:.4g} ms, where the first edge comes to {:.0f} % of its "
          "strength (run.fast_forward = false: by steps)",
          1e3 * simulation_->ramp_end(), 100.0 * solver_scene.insertion.threshold));
    }
    say(simulation_->stable().explain(*mesh));
    for (const std::string& line : scene_warnings(solver_scene, scene_.run.end_time, simulation_->stable()))
      say(line);
    const Steps steps = steps_of_run(scene_, simulation_->stable(), *mesh, options_.allow_unstable);
    const RunOutput output = output_of_run(scene_, mesh->triangle_count(), steps);
    require_disk(scene_, mesh->triangle_count(), output, folder_.path());
    memory_.step_length = steps.length;
    say(fmt::format("{} steps of {:.3g} s on {} thread{}; {}", steps.after(simulation_->ramp_end()),
                    steps.length, threads_, threads_ == 1 ? "" : "s",
                    needs_text(scene_, mesh->triangle_count(), output)));
    folder_.write_resolved(scene_);
  }

  // False where there is no checkpoint yet.
  bool resume() {
    RunSnapshot snapshot = take_up(folder_, text_, [&](const std::string& line) { say(line); });
    if (snapshot.mesh == nullptr) return false;
    simulation_ = std::make_unique<Simulation>(make_scene(scene_, snapshot.mesh), std::move(snapshot.state),
                                               std::move(snapshot.simulation));
    memory_ = std::move(snapshot.run);
    tally_ = Tally(scene_.run.end_time, memory_.tally);
    for (const SeismicEvent& e : memory_.events) tally_.event(e);
    history_ = Due(scene_.output.history_every, memory_.next_history);
    fields_ = Due(scene_.output.fields_every, memory_.next_fields);
    return true;
  }

  // The elastic ramp: rows and frames at their times, a hundred rows at most.
  void climb_ramp() {
    const double end = std::min(simulation_->ramp_end(), scene_.run.end_time);
    const double row_every =
        scene_.output.history_every * std::ceil(0.01 * end / scene_.output.history_every);
    for (double row = 0.0, frame = 0.0; std::min(row, frame) < end;) {
      const double time = std::min(row, frame);
      const Energies e = simulation_->ramp_to(time);
      if (time == frame) {
        write_frame();
        frame += scene_.output.fields_every;
      }
      if (time == row) {
        const double pressure = simulation_->wellbore_pressure();
        tally_.residual(e.residual);
        tally_.pressure(time, pressure, row_every);
        folder_.append_history(history_row(*simulation_, e, tally_, time, row_every, pressure));
        row += row_every;
      }
    }
    if (end > 0.0) simulation_->ramp_to(end);
  }

  void step() override {
    const double time = simulation_->state().time;
    const double left = scene_.run.end_time - time;
    // Shorter than planned where faces have come into general contact, and to land on the end.
    double dt = memory_.step_length;
    if (!options_.allow_unstable) dt = std::min(dt, scene_.run.safety * simulation_->stable_limit());
    const bool last = left <= dt * (1.0 + 1e-9);
    if (last) dt = left;
    if (fields_.is(time, dt)) write_frame();
    const double pressure = simulation_->wellbore_pressure();
    if (history_.is(time, dt) || last) {
      const Energies e = simulation_->step_and_account(dt);
      tally_.residual(e.residual);
      folder_.append_history(history_row(*simulation_, e, tally_, time, dt, pressure));
      heed(guards_->after_step(*simulation_, e));
    } else {
      simulation_->step(dt);
      heed(guards_->after_step(*simulation_));
    }
    note(simulation_->new_events());
    tally_.pressure(time, pressure, dt);
  }

  void heed(const std::vector<Finding>& findings) {
    for (const Finding& f : findings) {
      if (f.stops && !options_.allow_unstable) throw NumericalError(f.text);
      say(f.stops ? "unstable, and goes on: " + f.text : f.text);
    }
  }

  void note(const std::vector<SeismicEvent>& happened) {
    for (const SeismicEvent& e : happened) {
      folder_.append_event(e);
      memory_.events.push_back(e);
      tally_.event(e);
    }
  }

  template <class Work>
  void timed_output(const Work& work) {
    const auto begin = Clock::now();
    work();
    output_wall_ += seconds_since(begin);
  }

  void write_frame() {
    timed_output([&] {
      folder_.write_frame(field_frame(*simulation_, scene_.output.fields), fracture_frame(*simulation_));
    });
  }

  // What was before this process and what it has done.
  RunMemory memory_now() {
    RunMemory memory = memory_;
    memory.tally = tally_.memory();
    memory.next_history = history_.next();
    memory.next_fields = fields_.next();
    memory.guards = guards_->memory();
    memory.wall += wall();
    memory.loop_wall += seconds_since(loop_start_) - output_wall_;
    memory.output_wall += output_wall_;
    for (std::size_t p = 0; p < Stopwatch::parts; ++p)
      memory.parts[p] += simulation_->stopwatch().seconds(static_cast<Stopwatch::Part>(p));
    return memory;
  }

  void write_checkpoint() override {
    timed_output([&] {
      RunMemory memory = memory_now();
      memory.folder = folder_.marks();
      folder_.write_checkpoint(pack_run(*simulation_, memory, text_));
    });
  }

  RunSummary finish() override {
    write_frame();
    const RunMemory memory = memory_now();
    RunSummary summary = tally_.finish();
    summary.triangles = simulation_->state().mesh->triangle_count();
    summary.steps = simulation_->state().step;
    summary.energy_inserted = simulation_->state().dissipation.inserted;
    summary.energy_path = simulation_->state().dissipation.path;
    summary.wall = memory.wall;
    summary.core_ns_per_triangle_step = 1e9 * memory.loop_wall * threads_ /
                                        (static_cast<double>(summary.triangles) *
                                         static_cast<double>(std::max<std::int64_t>(1, summary.steps)));
    summary.alarms = memory.guards.alarms;
    summary.unstable_allowed = options_.allow_unstable;
    summary.exit = exit_reason();
    folder_.write_quakeml(memory_.events, scene_);
    folder_.write_summary(summary);
    return summary;
  }

  void report(const RunSummary& summary) override {
    const RunMemory memory = memory_now();
    std::string parts;
    for (std::size_t p = 0; p < Stopwatch::parts; ++p) {
      const double share = memory.parts[p] / std::max(memory.loop_wall, 1e-9);
      parts += fmt::format("{}{} {:.0f} %", p > 0 ? ", " : "", Stopwatch::names[p], 100.0 * share);
    }
    say(fmt::format("time: {:.1f} s in steps ({}), {:.1f} s in output; {:.1f} core-ns per triangle and step",
                    memory.loop_wall, parts, memory.output_wall, summary.core_ns_per_triangle_step));
    if (simulation_->scene().insertion.on_demand) {
      say(fmt::format("{} of {} edges got a cohesive element, {} of them with a jump in force",
                      simulation_->state().cohesive.count(), simulation_->state().mesh->edge_count(),
                      simulation_->rough_insertions()));
    }
    if (const DamageState& d = simulation_->state().damage; !d.of_triangle.empty()) {
      const auto failed =
          std::ranges::count_if(d.triangles, [](const DamagedTriangle& t) { return t.failed != 0; });
      say(fmt::format("{} damaged triangles, {} of them failed; {} above the size limit got a lower strength",
                      d.triangles.size(), failed, d.lowered));
    }
    say(fmt::format("{}{} broken elements, {:.3f} m; energy residual {:.1e}", pressures(summary),
                    tally_.broken(), summary.broken_length, summary.energy_residual_max));
  }

  /// What the wellbore's pressure did; nothing without a pump.
  std::string pressures(const RunSummary& summary) const {
    if (scene_.fluid.pump.empty()) return {};
    const double highest = 1e-6 * summary.breakdown_pressure, time = 1e3 * summary.breakdown_time;
    if (summary.final_pressure > 0.99 * summary.breakdown_pressure) {
      return fmt::format(
          "no breakdown, the pressure is at its highest when the run ends: {:.3f} MPa at {:.4f} ms; ",
          highest, time);
    }
    return fmt::format("breakdown {:.3f} MPa at {:.4f} ms, propagation {:.3f} MPa; ", highest, time,
                       1e-6 * summary.propagation_pressure);
  }

  int threads_;
  std::unique_ptr<Simulation> simulation_;
  Due history_, fields_;
  std::optional<Guards> guards_;
  RunMemory memory_;  // of the processes before this one, but for the events: all
  Clock::time_point loop_start_ = Clock::now();
  double output_wall_ = 0.0;
};

}  // namespace

int run_dynamic(const RunOptions& options, const Case& scene, RunFolder& folder, Status& status) {
  return DynamicRun(options, scene, folder, status).go();
}

}  // namespace crackle
