// SPDX-License-Identifier: GPL-3.0-or-later
//
// `crackle run` in field time: the quasi-static stage from a case to its run folder.
#include "run_quasi_static.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "checkpoint.hpp"
#include "crackle/seismic/listener.hpp"
#include "forecast.hpp"
#include "frames.hpp"
#include "joints.hpp"
#include "quasi_static_scene.hpp"
#include "regime.hpp"
#include "run_loop.hpp"

namespace crackle {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

// The last snap, of both halves.
SeismicEvent snap_event(const QuasiStatic& stage, const Case& scene) {
  SeismicEvent e = stage.last_snap();
  if (modelled_halves(scene) == 1.0) {
    for (double* of_half : {&e.energy, &e.fracture_energy, &e.friction_energy, &e.length, &e.moment.xx,
                            &e.moment.yy, &e.moment.zz})
      *of_half *= 2.0;
    e.edges *= 2;
    e.moment.xy = e.place.x = 0.0;
  }
  e.magnitude = magnitude_of_energy(e.energy * scene.seismic.thickness);
  e.moment_magnitude = moment_magnitude(scalar_moment(e.moment) * scene.seismic.thickness);
  return e;
}

FieldTimeRow history_row(const QuasiStatic& stage, const QuasiStaticRow& row, const Case& scene) {
  const double halves = modelled_halves(scene), wings = 2.0 / halves;
  FieldTimeRow h;
  h.time = row.time;
  h.time_step = row.step;
  h.pressure = row.well_pressure;
  h.rate = stage.scene().pump.rate(row.time) * wings * scene.well.height;
  h.perforation_rate = row.perforation_rate * wings;
  h.fracture_pressure = row.fracture_pressure;
  h.least_pressure = row.least_pressure;
  h.injected = row.injected * wings;
  h.well_stored = row.well_stored * wings;
  h.fracture_volume = row.fracture_volume * wings;
  h.leaked = row.leaked * wings;
  h.mass_defect = row.mass_defect * wings;
  h.broken_length = row.broken_length / halves;
  h.damaged_length = row.damaged_length / halves;
  h.half_length = row.elastic_length / halves;
  h.opening = row.opening;
  h.mean_opening = row.mean_opening;
  h.contact_fraction = row.contact_fraction;
  h.closure_stress = scene.rock.pore_pressure + confinement(scene);
  const quasi_static::Energies& e = row.energies;
  h.work_pump = wings * e.pumped;
  h.energy_well = wings * e.well;
  h.energy_entry = wings * e.entry;
  h.energy_viscous = wings * e.viscous;
  h.energy_leaked = wings * e.leaked;
  h.energy_fluid = wings * e.fluid;
  h.energy_strain = wings * e.strain;
  h.energy_confinement = wings * e.confinement;
  h.energy_faces = wings * e.faces;
  h.energy_fracture = wings * e.fracture;
  h.energy_friction = wings * e.friction;
  h.energy_radiated = wings * e.radiated;
  h.energy_residual = e.residual;
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
  const std::vector<std::uint16_t>& layers = stage.scene().layer_of_triangle;
  if (wanted("layer") && !layers.empty()) frame.cell_fields.push_back(layer_field(layers));
  return frame;
}

// Joints are, from the beginning.
bool is_broken(const FractureCell& cell) { return std::min(cell.damage[0], cell.damage[1]) >= 1.0; }

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
    opening.add(0.5 * (cell.opening[0] + cell.opening[1]));
    slip.add(0.5 * (cell.slip[0] + cell.slip[1]));
    damage.add(0.5 * (cell.damage[0] + cell.damage[1]));
    mode.add(is_broken(cell) && !cell.joint ? static_cast<double>(FailureMode::tensile) : 0.0);
    pressure.add(cell.pressure);
    broken.add(is_broken(cell) ? 1.0 : 0.0);
    leaked.add(0.5 * cell.leaked / cell.length);
  }
  frame.cell_fields = {std::move(opening),  std::move(slip),   std::move(damage), std::move(mode),
                       std::move(pressure), std::move(broken), std::move(leaked)};
  return frame;
}

// Width and height of the box round what is broken [m], joints left out.
Vec2 broken_extent(const QuasiStatic& stage) {
  const Mesh& mesh = *stage.scene().mesh;
  constexpr double far = std::numeric_limits<double>::infinity();
  Vec2 low{far, far}, high{-far, -far};
  const std::vector<FractureCell> cells = stage.cells();
  for (std::size_t c = 0; c < cells.size(); ++c) {
    for (std::size_t i = 0; i < 2; ++i) {
      if (cells[c].joint || cells[c].damage[i] < 1.0) continue;
      const Vec2 p = mesh.vertices[at(stage.path().edges()[c].vertex[i])];
      low = {std::min(low.x, p.x), std::min(low.y, p.y)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    }
  }
  return high.x < low.x ? Vec2{} : high - low;
}

class FieldTimeRun final : public RunLoop {
 public:
  FieldTimeRun(const RunOptions& options, const Case& scene, RunFolder& folder, Status& status)
      : RunLoop(options, scene, folder, status) {
    folder.set_field_time();
  }

 private:
  bool is_at_end() const override { return stage_->time() >= scene_.run.end_time; }
  Progress::Now now() const override {
    return {row_.time, row_.well_pressure, tally_.memory().steps,
            std::ranges::count_if(stage_->cells(),
                                  [](const FractureCell& c) { return !c.joint && is_broken(c); })};
  }

  void begin() override {
    NetworkReport network;
    auto mesh = std::make_shared<Mesh>();
    quasi_static::State state;
    const bool resumed =
        !options_.resume.empty() &&
        take_up_field_time(
            folder_, text_, [&](const std::string& line) { say(line); }, *mesh, state, memory_);
    if (!resumed) *mesh = make_quasi_static_mesh(scene_, &network);
    const QuasiStaticScene stage = make_quasi_static_scene(scene_, mesh);
    triangles_ = stage.mesh->triangle_count();
    say("mesh: " + quasi_static_mesh_text(scene_, stage));
    if (network.joints > 0) say(network_text(network));
    for (const std::string& line : quasi_static_notes(scene_, stage)) say(line);
    const RunOutput output = output_of_field_time(scene_, triangles_);
    if (options_.resume.empty()) {
      require_memory(scene_, triangles_);
      require_disk(scene_, triangles_, output, folder_.path());
    }
    say(needs_text(scene_, triangles_, output));
    stage_ = resumed ? std::make_unique<QuasiStatic>(stage, std::move(state))
                     : std::make_unique<QuasiStatic>(stage);
    row_ = stage_->row();
    if (resumed) {
      tally_ = Tally(scene_.run.end_time, memory_.tally);
      for (const SeismicEvent& e : memory_.events) tally_.event(e);
      return;
    }
    say(fmt::format("rock factorised, initial fracture in equilibrium ({:.1f} s)", wall()));
    folder_.write_resolved(scene_);
    folder_.append_field_time(history_row(*stage_, row_, scene_));
  }

  void step() override {
    const double time = stage_->time();
    const bool shut_in =
        time > 0.0 && stage_->state().event == time && stage_->scene().pump.rate(time) == 0.0;
    if (shut_in || time >= memory_.next_frame) write_frame();
    if (time >= memory_.next_frame) {
      const double every = scene_.output.fields_every;
      memory_.next_frame += every * std::ceil((time - memory_.next_frame) / every + 1e-12);
    }
    const bool moved = stage_->state().motion.moves();
    if (!moved) before_ = row_;
    row_ = stage_->step(scene_.run.end_time);
    tell_hand_over(moved, stage_->state().motion.moves());
    folder_.append_field_time(history_row(*stage_, row_, scene_));
    memory_.mass_residual_max =
        std::max(memory_.mass_residual_max, std::abs(row_.mass_defect) / std::max(row_.injected, 1e-12));
    tally_.pressure(row_.time, row_.well_pressure, row_.step);
    tally_.residual(row_.energies.residual);
  }

  void tell_hand_over(bool moved, bool moves) {
    const quasi_static::Motion& motion = stage_->state().motion;
    if (!moved && moves) {
      say(fmt::format("{:.6g} s, {:.3f} MPa: the fracture snaps, on by explicit steps of {:.2g} s",
                      before_.time, 1e-6 * before_.well_pressure,
                      row_.step / static_cast<double>(motion.steps)));
    } else if (moved && !moves) {
      const double wings = 2.0 / modelled_halves(scene_);
      const SeismicEvent event = snap_event(*stage_, scene_);
      say(
          fmt::format("{:.6g} s, {:.3f} MPa: in equilibrium again after {:.3g} ms: the fracture has grown by "
                      "{:.3g} m (both wings), {:.3g} J/m went into waves, magnitude {:.2f}",
                      row_.time, 1e-6 * row_.well_pressure, 1e3 * (row_.time - motion.begin),
                      wings * (row_.damaged_length - motion.length), event.energy, event.magnitude));
      memory_.events.push_back(event);
      tally_.event(event);
      folder_.append_event(event);
    }
  }

  void write_frame() {
    folder_.write_frame(field_frame(*stage_, scene_.output.fields), fracture_frame(*stage_));
  }

  FieldTimeMemory memory_now() const {
    FieldTimeMemory memory = memory_;
    memory.tally = tally_.memory();
    memory.wall += wall();
    return memory;
  }

  void write_checkpoint() override {
    FieldTimeMemory memory = memory_now();
    memory.folder = folder_.marks();
    folder_.write_checkpoint(
        pack_field_time(*stage_->scene().mesh, stage_->state(), std::move(memory), text_));
  }

  RunSummary finish() override {
    write_frame();
    RunSummary summary = tally_.finish();
    summary.triangles = triangles_;
    summary.steps = tally_.memory().steps;
    summary.broken_length = 2.0 / modelled_halves(scene_) * row_.broken_length;
    const Vec2 extent = broken_extent(*stage_);
    summary.extent_x = 2.0 / modelled_halves(scene_) * extent.x;
    summary.extent_y = extent.y;
    summary.mass_residual_max = memory_.mass_residual_max;
    summary.wall = memory_now().wall;
    summary.core_ns_per_triangle_step =
        1e9 * summary.wall /
        (static_cast<double>(triangles_) * static_cast<double>(std::max<std::int64_t>(1, summary.steps)));
    summary.exit = exit_reason();
    folder_.write_quakeml(memory_.events, scene_);
    folder_.write_summary(summary);
    return summary;
  }

  void report(const RunSummary& summary) override {
    say(
        fmt::format("{} steps, {} Newton iterations, {} steps taken back; mass balance {:.1e} of what was "
                    "injected, energy residual {:.1e}; {:.1f} s",
                    summary.steps, stage_->newton_iterations(), stage_->rejected_steps(),
                    summary.mass_residual_max, summary.energy_residual_max, summary.wall));
    say(fmt::format(
        "highest pressure {:.3f} MPa at {:.4g} s; fracture of {:.2f} m (both wings), {:.3f} mm open "
        "at the well at the end",
        1e-6 * summary.breakdown_pressure, summary.breakdown_time, summary.broken_length,
        1e3 * row_.opening));
  }

  std::unique_ptr<QuasiStatic> stage_;
  QuasiStaticRow row_, before_;  // now; the last one at rest
  FieldTimeMemory memory_;       // of the processes before this one
  Index triangles_ = 0;
};

}  // namespace

int run_quasi_static(const RunOptions& options, const Case& scene, RunFolder& folder, Status& status) {
  return FieldTimeRun(options, scene, folder, status).go();
}

}  // namespace crackle
