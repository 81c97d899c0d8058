// SPDX-License-Identifier: GPL-3.0-or-later
#include "crackle/solve/quasi_static.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "bore.hpp"
#include "crackle/core/errors.hpp"
#include "crackle/solve/estimates.hpp"
#include "dynamics.hpp"
#include "growth.hpp"
#include "ledger.hpp"
#include "newton.hpp"
#include "path_rock.hpp"
#include "record.hpp"

namespace crackle {

namespace qs = quasi_static;

namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

// Where an elastic crack would have its tip: 0.39 of the cohesive zone from its front, where w ~ x^{3/2}.
constexpr double damage_at_tip = 0.25;

constexpr int most_cuts = 6;  // of a step whose energy does not add up

// Hand-over to explicit steps and back:
constexpr double fast = 0.1;       // of the Rayleigh speed: a tip that is faster snaps
constexpr int steps_in_row = 200;  // explicit ones between two rows
constexpr double calm = 0.01;      // kinetic energy over what was torn and went into motion
constexpr double close_by = 0.02;  // change of pressure and jumps as equilibrium takes over
constexpr double shortest = 1e-3;  // share of the stable step

void check(const QuasiStaticScene& scene) {
  const auto require = [](bool holds, const char* what) {
    if (!holds) throw CaseError(std::string("quasi-static stage: ") + what);
  };
  require(!scene.wings.empty(), "no fracture to start from");
  for (const Wing& wing : scene.wings)
    require((wing.open >= 1 || qs::on_wall(*scene.mesh, wing.start)) && !wing.path.empty() &&
                wing.open < wing.path.size() + (wing.free ? 1 : 0),
            "a wing needs an open edge, or to start at the wall of a wellbore, and an edge ahead of it");
  require(scene.slip || scene.joints.empty(), "joints slip: give slip");
  for (std::size_t layer = 0; layer <= scene.layers.size(); ++layer) {
    const CohesiveMaterial& m = scene.rock(layer).cohesive;
    require(m.tensile_strength > 0.0 && m.fracture_energy_mode1 > 0.0,
            "tensile strength and fracture energy have to be positive");
  }
  require(
      scene.edges_per_zone >= 2.0,
      "a strength that the mesh does not resolve stops the fracture: edges_per_zone has to be 2 at least");
  require(scene.closure.residual_aperture > 0.0,
          "residual aperture has to be positive: a mated fracture without any would never let fluid in");
  require(scene.fluid.compressibility > 0.0, "the fluid needs a compressibility");
  require(!scene.control.hand_over || scene.density > 0.0,
          "explicit steps where the fracture snaps need the density of the rock");
  require(scene.pore_pressure - scene.fluid.cavitation_pressure >= 1e6,
          "cavitation pressure has to be at least 1 MPa below the initial pressure");
}

}  // namespace

class QuasiStatic::Solver {
 public:
  explicit Solver(QuasiStaticScene scene)
      : scene_((check(scene), std::move(scene))),
        materials_(edge_materials(scene_)),
        bulk_(bulk_of(scene_, {})),
        path_(scene_.mesh, scene_.held, scene_.slip),
        rock_(scene_.mesh, bulk_, scene_.held),
        equations_{scene_, bulk_, path_, rock_, laws_, matrix_, qs::bore_volume(*scene_.mesh)} {
    if (equations_.bore > 0.0) qs::load_wall(*scene_.mesh, bulk_, rock_);
    qs::balance_in_situ(scene_, rock_, bulk_);
    if (const auto* rock = std::get_if<MatrixRock>(&scene_.leak_off)) matrix_.emplace(*rock);
  }

  void begin() {
    state_.well_pressure = scene_.pore_pressure;
    state_.connected = !scene_.well.breakdown_pressure.has_value();
    for (const JointEdge& joint : scene_.joints) {
      if (!joint.bonded) add_joint(joint.edge);
    }
    for (std::size_t w = 0; w < scene_.wings.size(); ++w) start(static_cast<Index>(w));
    settle();
    state_.step = scene_.control.first;
    qs::begin_ledger(equations_, state_);
  }

  void go_on(qs::State state) {
    for (const qs::Cell& cell : state.cells) join(cell);
    rock_.follow(path_.unknowns());
    state_ = std::move(state);
  }

  QuasiStaticRow step(double end) {
    if (!(end > state_.time)) throw CaseError("quasi-static stage: a step has to end later than it starts");
    if (state_.motion.moves()) return go_on_moving(end);
    double shorter = 0.5;
    ran_away_ = false;
    int too_long = 0;
    for (double dt = choose(end);; dt *= shorter) {
      if (scene_.control.hand_over && (ran_away_ || dt < scene_.control.smallest)) {
        state_.motion = qs::set_in_motion(equations_, state_);
        state_.motion.tried = racing_step();
        return move(end);
      }
      if (dt < scene_.control.smallest) stop(dt);
      const std::size_t edges = path_.edges().size();
      qs::State trial = state_;
      trial.well_before = state_.well_pressure;
      const double until = dt >= end - state_.time ? end : state_.time + dt;
      const double rate = scene_.pump.volume(state_.time, until) / dt;
      const int iterations = advance(trial, dt, rate);
      state_.iterations += spent_;
      double error = 0.0;  // over what is allowed
      if (iterations >= 0) {
        finish(trial, until, dt, rate);
        error = qs::error_of_step(state_.energies, trial.energies) / scene_.control.energy;
      }
      // What is left after a few cuts is not the step's.
      const double suits =
          0.9 / std::sqrt(std::max(error, 1e-9));  // the error of a step goes with its square
      const bool cut = error > 1.0 && 0.1 * dt > scene_.control.smallest && too_long++ < most_cuts;
      shorter = cut ? std::clamp(suits, 0.1, 0.5) : 0.5;
      if (iterations < 0 || cut) {
        take_back(edges);
        continue;
      }
      trial.step = std::max(dt * std::clamp(suits, 0.5, scene_.control.growth), scene_.control.smallest);
      return commit(std::move(trial), until, dt, rate, iterations);
    }
  }

  const QuasiStaticScene& scene() const { return scene_; }
  const FracturePath& path() const { return path_; }
  const qs::State& state() const { return state_; }
  const qs::Equations& equations() const { return equations_; }
  double strength() const {
    double least = scene_.cohesive.tensile_strength;
    for (const InterfaceLaw& law : laws_) least = std::min(least, law.strength());
    return least;
  }

 private:
  // Makes a mesh edge part of the path.
  Index join(const qs::Cell& cell) {
    const bool joint = cell.parent == qs::of_joint;
    const Index c =
        path_.add(cell.edge, cell.inner, cell.parent, joint ? mated_aperture(cell.edge) : 0.0, cell.along);
    const PathEdge& edge = path_.edges()[at(c)];
    laws_.push_back(qs::law_of(scene_, materials_, cell.edge, edge.normal, edge.length));
    return c;
  }

  // In-situ tractions across an edge and along it [Pa].
  void set_in_situ(qs::Cell& cell, const PathEdge& edge) const {
    const Vec2 pull = qs::in_situ_beside(*scene_.mesh, bulk_, edge.edge) * edge.normal;
    for (qs::Point& p : cell.points) {
      p.bond = p.in_situ = dot(edge.normal, pull);
      if (scene_.slip) p.bond_shear = p.in_situ_shear = dot(Vec2{-edge.normal.y, edge.normal.x}, pull);
    }
  }

  double mated_aperture(Index mesh_edge) const {
    const auto& v = scene_.mesh->edges[at(mesh_edge)].vertex;
    const Vec2 along = scene_.mesh->vertices[at(v[1])] - scene_.mesh->vertices[at(v[0])];
    const Vec2 normal = (1.0 / norm(along)) * right_normal(along);
    return scene_.closure.opening(-dot(normal, qs::in_situ_beside(*scene_.mesh, bulk_, mesh_edge) * normal));
  }

  void add_joint(Index mesh_edge) {
    qs::Cell cell;
    cell.edge = mesh_edge;
    cell.inner = scene_.mesh->edges[at(mesh_edge)].vertex[0];
    cell.parent = qs::of_joint;
    cell.wet = 1;
    cell.pressure = scene_.pore_pressure;
    const Index c = join(cell);
    set_in_situ(cell, path_.edges()[at(c)]);
    for (qs::Point& p : cell.points)
      p.max_opening = std::max(laws_[at(c)].broken_opening(), scene_.closure.residual_aperture);
    append(state_, cell);
  }

  void append(qs::State& state, const qs::Cell& cell) const {
    if (matrix_) {
      state.matrix.resize(state.matrix.size() + matrix_->cells(),
                          std::get<MatrixRock>(scene_.leak_off).reservoir_pressure);
    }
    state.cells.push_back(cell);
    state.jumps.resize(path_.unknowns().size(), 0.0);
  }

  // Adds the next edge of a wing behind the last one of `tip`, intact and dry.
  void extend(qs::State& state, qs::Tip& tip, std::size_t number) {
    const Wing& w = scene_.wings[at(tip.wing)];
    qs::Cell cell;
    cell.inner = tip.cell < 0 ? w.start : path_.edges()[at(tip.cell)].vertex[1];
    cell.parent = tip.cell;
    if (number < w.path.size()) {
      cell.edge = w.path[number];
    } else {
      qs::NextEdge next = qs::next_in_joint(equations_, tip);
      if (next.edge < 0) {
        if (!dynamics_) rock_.follow(path_.unknowns());
        next = qs::choose_edge(equations_, state, tip);
      }
      cell.edge = next.edge;
      cell.along = next.along;
    }
    add_tip_cell(state, tip, cell);
  }

  // Makes a cell that is intact and dry the last one of `tip`.
  void add_tip_cell(qs::State& state, qs::Tip& tip, qs::Cell cell) {
    tip.cell = join(cell);
    const PathEdge& edge = path_.edges()[at(tip.cell)];
    tip.place = norm(cell.along) > 0.0 ? tip.place + cell.along : scene_.mesh->vertices[at(edge.vertex[1])];
    set_in_situ(cell, edge);
    cell.pressure = scene_.pore_pressure;
    append(state, cell);
  }

  // Joints that hold leave the vertex that the last edge of a tip starts at: each of their edges there is a
  // tip beside it.
  void meet_joints(qs::State& state, qs::Tip tip) {
    qs::Cell cell;
    cell.inner = state.cells[at(tip.cell)].inner;
    cell.parent = state.cells[at(tip.cell)].parent;
    for (const Index edge : qs::joints_met(equations_, cell.inner)) {
      cell.edge = edge;
      qs::Tip arm{tip.wing, -1, {}};
      add_tip_cell(state, arm, cell);
      if (cell.parent < 0) state.inlets.push_back({arm.cell, 0.0});
      state.tips.push_back(arm);
    }
  }

  void start(Index wing) {
    const Wing& w = scene_.wings[at(wing)];
    qs::Tip tip;
    tip.wing = wing;
    for (std::size_t i = 0; i <= w.open; ++i) {
      const Index parent = tip.cell;
      extend(state_, tip, i);
      const Index c = tip.cell;
      meet_joints(state_, tip);
      if (i == 0) state_.inlets.push_back({c, 0.0});
      if (i < w.open) {
        const double free = std::max(laws_[at(c)].broken_opening(), scene_.closure.residual_aperture);
        state_.cells[at(c)].wet = 1;
        state_.cells[at(c)].exposed = 0.0;
        state_.cells[at(c)].points[0].max_opening = free;
        if (i > 0) state_.cells[at(parent)].points[1].max_opening = free;
      }
    }
    state_.tips.push_back(tip);
  }

  // Mated faces under the in-situ stress at pore pressure.
  void settle() {
    rock_.follow(path_.unknowns());
    for (std::size_t c = 0; c < state_.cells.size(); ++c) {
      for (std::size_t i = 0; i < 2; ++i) {
        const qs::Point& p = state_.cells[c].points[i];
        if (p.max_opening == 0.0 || state_.cells[c].parent == qs::of_joint) continue;
        for (const JumpTerm& t : path_.edges()[c].jump[i]) {
          state_.jumps[at(t.unknown)] = t.normal * scene_.closure.opening(-p.in_situ);
        }
      }
    }
    if (!qs::solve(equations_, state_, 0.0, 0.0).converged)
      throw NumericalError("quasi-static stage: no equilibrium of the initial fracture at pore pressure");
    for (std::size_t c = 0; c < state_.cells.size(); ++c) remember_slip(state_, c);
    for (std::size_t c = 0; c < state_.cells.size(); ++c) {
      state_.cells[c].mass = qs::fluid_in_cell(equations_, state_, c);
    }
    state_.initial_fracture = qs::fracture_volume(state_);
    state_.initial_well = state_.well_pressure;
    state_.bore = state_.initial_bore = qs::fluid_in_bore(equations_, state_);
  }

  // Length of the next step: it lands on changes of the schedule and on breakdown.
  double choose(double end) {
    const double change = scene_.pump.next_change(state_.time);
    const TimeControl& control = scene_.control;
    double dt =
        std::min(state_.step, std::max(control.first, control.relative * (state_.time - state_.event)));
    if (!state_.connected) {
      const double rate = scene_.pump.rate(state_.time), breakdown = *scene_.well.breakdown_pressure;
      // a line, in rows enough to be drawn
      const double rise =
          std::min(breakdown - state_.well_pressure, 0.05 * (breakdown - scene_.pore_pressure));
      dt = rate > 0.0 ? std::max(rise * qs::well_storage(equations_, state_) / rate, control.smallest)
                      : std::numeric_limits<double>::infinity();
    }
    const double stop = std::min(end, change);
    const double left = stop - state_.time;
    // Two equal steps rather than a full one and a sliver.
    return dt >= left ? left : std::min(dt, std::max(0.5 * left, 1e-3 * dt));
  }

  int advance(qs::State& trial, double dt, double rate) {
    int iterations = spent_ = 0;
    std::vector<int> grown;
    std::vector<double> far;  // in this step [m]
    while (true) {
      grown.resize(trial.tips.size(), 0);
      far.resize(trial.tips.size(), 0.0);
      if (!dynamics_) rock_.follow(path_.unknowns());
      const qs::NewtonResult result = qs::solve(equations_, trial, dt, rate);
      iterations += result.iterations;
      spent_ = iterations;
      if (!result.converged) return -1;
      bool changed = wet(trial);
      for (std::size_t t = 0; t < grown.size(); ++t) {
        if (!opens(trial, trial.tips[t])) continue;
        if (++grown[t] > scene_.control.edges_per_step) return -1;
        far[t] += path_.edges()[at(trial.tips[t].cell)].length;
        if (!dynamics_ && scene_.control.hand_over &&
            far[t] > fast_tip() * (trial.time + dt - trial.tips[t].since)) {
          ran_away_ = true;
          return -1;
        }
        grow(trial, trial.tips[t]);
        changed = true;
      }
      if (changed) continue;
      for (std::size_t t = 0; t < trial.tips.size(); ++t) {
        if (grown[t] > 0) trial.tips[t].since = trial.time + dt;
      }
      return iterations;
    }
  }

  bool opens(const qs::State& state, const qs::Tip& tip) const {
    const double w = qs::openings(path_.edges()[at(tip.cell)], state.jumps)[0];
    return w > laws_[at(tip.cell)].elastic_opening();
  }

  void grow(qs::State& state, qs::Tip& tip) {
    const Wing& wing = scene_.wings[at(tip.wing)];
    const auto here = std::find(wing.path.begin(), wing.path.end(), path_.edges()[at(tip.cell)].edge);
    const auto next = std::min(static_cast<std::size_t>(here - wing.path.begin()) + 1, wing.path.size());
    if (next >= wing.path.size() && !wing.free) {
      throw NumericalError(
          fmt::format("quasi-static stage: at {:g} s the fracture has come to the end of its path; "
                      "make the path longer (mesh.fine_radius), or end the run earlier",
                      state.time));
    }
    const std::size_t jumps = state.jumps.size();
    extend(state, tip, next);
    meet_joints(state, tip);
    if (dynamics_) {
      dynamics_->follow_path(state);
    } else {
      rock_.follow(path_.unknowns());
    }
    qs::take_over(equations_, state, jumps);
    if (dynamics_) dynamics_->set_faces(qs::face_forces(equations_, state), jumps);
  }

  void fill(qs::State& state, Index cell) const {
    qs::Cell& c = state.cells[at(cell)];
    const Index parent = path_.edges()[at(cell)].parent;
    c.wet = 1;
    c.pressure = parent < 0 ? state.well_pressure : state.cells[at(parent)].pressure;
  }

  // Lets the fluid into damaged (or broken) edges next to it.
  bool wet(qs::State& state) const {
    bool changed = false;
    for (std::size_t c = 0; c < state.cells.size(); ++c) {
      const Index parent = path_.edges()[c].parent;
      if (state.cells[c].wet || parent == qs::of_joint) continue;
      if (parent < 0 ? !state.connected : !state.cells[at(parent)].wet) continue;
      const auto w = qs::openings(path_.edges()[c], state.jumps);
      const bool enters = scene_.wetting == Wetting::broken
                              ? std::min(w[0], w[1]) >= laws_[c].broken_opening()
                              : w[0] > laws_[c].elastic_opening();
      if (!enters) continue;
      fill(state, static_cast<Index>(c));
      changed = true;
    }
    return changed;
  }

  // Lets a cell leak off from when an elastic crack's tip has passed its inner end, whose damage in this step
  // goes from `before` to `after`; it goes on at the speed that it had over the last edge.
  static void expose(const qs::State& trial, qs::Cell& cell, double before, double after, double dt) {
    if (!cell.wet || after < damage_at_tip) return;
    const double share = before < damage_at_tip ? (damage_at_tip - before) / (after - before) : 0.0;
    cell.exposed = trial.time + share * dt;
    if (cell.parent < 0 || !(trial.cells[at(cell.parent)].exposed > 0.0)) return;
    cell.sweep = std::max(0.0, cell.exposed - trial.cells[at(cell.parent)].exposed);
  }

  void remember_slip(qs::State& state, std::size_t c) const {
    if (!scene_.slip) return;
    const auto w = qs::openings(path_.edges()[c], state.jumps),
               slip = qs::slips(path_.edges()[c], state.jumps);
    for (std::size_t i = 0; i < 2; ++i) {
      qs::Point& p = state.cells[c].points[i];
      p.plastic_slip =
          laws_[c].traction(w[i], slip[i], p.max_opening, p.plastic_slip, p.bond, p.bond_shear).plastic_slip;
    }
  }

  // Histories, masses and energies at the end of a step that has converged.
  void finish(qs::State& trial, double until, double dt, double rate) {
    finish_cells(trial, until, dt, rate);
    qs::account(equations_, state_, trial, dt, rate);
  }

  void finish_cells(qs::State& trial, double until, double dt, double rate) {
    for (std::size_t c = 0; c < trial.cells.size(); ++c) {
      qs::Cell& cell = trial.cells[c];
      const auto w = qs::openings(path_.edges()[c], trial.jumps);
      if (cell.wet) {
        const double lost = qs::leak(equations_, trial, static_cast<Index>(c), cell.pressure, dt).value;
        cell.leaked += lost;
        trial.leaked += lost;
        if (matrix_ && trial.time >= cell.exposed) {
          const std::size_t n = matrix_->cells();
          matrix_->advance(std::span(trial.matrix).subspan(c * n, n), dt, cell.pressure);
        }
      }
      cell.mass = qs::fluid_in_cell(equations_, trial, c);
      const double before = laws_[c].damage(cell.points[0].max_opening);
      remember_slip(trial, c);
      for (std::size_t i = 0; i < 2; ++i)
        cell.points[i].max_opening = std::max(cell.points[i].max_opening, w[i]);
      if (cell.exposed > until) expose(trial, cell, before, laws_[c].damage(cell.points[0].max_opening), dt);
    }
    trial.bore = qs::fluid_in_bore(equations_, trial);
    trial.injected += rate * dt;
  }

  QuasiStaticRow commit(qs::State trial, double until, double dt, double rate, int iterations) {
    const bool entered = trial.connected;
    const bool changes = until >= scene_.pump.next_change(state_.time);
    trial.time = until;
    if (changes) trial.event = until;
    if (!trial.connected && trial.well_pressure >= *scene_.well.breakdown_pressure * (1.0 - 1e-12)) {
      trial.connected = 1;
      trial.breakdown_time = trial.event = until;
    }
    if (trial.event == until) trial.step = scene_.control.first;
    trial.rejected = state_.rejected;
    trial.iterations = state_.iterations;
    state_ = std::move(trial);
    QuasiStaticRow row = qs::row_of(equations_, state_);
    for (const qs::Inlet& inlet : state_.inlets) row.perforation_rate += entered ? inlet.rate : 0.0;
    row.step = dt;
    row.rate = rate;
    row.iterations = iterations;
    return row;
  }

  void take_back(std::size_t edges) {
    path_.truncate(edges);
    laws_.erase(laws_.begin() + static_cast<std::ptrdiff_t>(edges), laws_.end());
    ++state_.rejected;
  }

  // A tip as fast as this [m/s] makes inertia count.
  double fast_tip() const { return fast * 0.92 * std::sqrt(bulk_.stiffness(0).c66 / bulk_.density(0)); }
  // As long as as many edges as a tip may take in one step would last at that speed [s].
  double racing_step() const {
    double shortest_edge = std::numeric_limits<double>::infinity();
    for (const qs::Tip& tip : state_.tips)
      shortest_edge = std::min(shortest_edge, path_.edges()[at(tip.cell)].length);
    return scene_.control.edges_per_step * shortest_edge / fast_tip();
  }

  // At rest again if the step that there was no equilibrium for has one now, near the moving state and
  // without growth; else explicit steps.
  QuasiStaticRow go_on_moving(double end) {
    const qs::Motion& motion = state_.motion;
    const double released =
        state_.energies.radiated - motion.radiated + state_.energies.fracture - motion.fracture;
    if (motion.kinetic < calm * released) {
      if (std::optional<QuasiStaticRow> row = come_to_rest(end)) return *row;
    }
    if (state_.time - motion.begin > longest_motion()) {
      throw NumericalError(fmt::format(
          "quasi-static stage: explicit steps from {:g} s on, where no step converged, have not come to rest "
          "within {:.2g} s, in which a fracture at a tenth of the Rayleigh speed leaves the domain (well "
          "pressure {:.4g} MPa); look at the fluid's compressibility, the pump and run.regime = \"dynamic\"",
          motion.begin, longest_motion(), state_.well_pressure * 1e-6));
    }
    return move(end);
  }

  // What goes on for longer is no snap [s].
  double longest_motion() const {
    double reach = 0.0;
    for (const Vec2 v : scene_.mesh->vertices) reach = std::max({reach, std::abs(v.x), std::abs(v.y)});
    return reach / fast_tip();
  }

  std::optional<QuasiStaticRow> come_to_rest(double end) {
    const double left = std::min(end, scene_.pump.next_change(state_.time)) - state_.time;
    const double dt = std::min(state_.motion.tried, left),
                 until = dt < left ? state_.time + dt : state_.time + left;
    const double rate = scene_.pump.volume(state_.time, until) / dt;
    const std::size_t edges = path_.edges().size();
    const qs::State moving = state_;
    rock_.follow(path_.unknowns());
    start_rest();
    qs::State trial = state_;
    trial.well_before = state_.well_pressure;
    const int iterations = advance(trial, dt, rate);
    if (iterations < 0 || path_.edges().size() > edges || !near(trial)) {
      take_back(edges);
      state_ = moving;
      return std::nullopt;
    }
    finish(trial, until, dt, rate);
    trial.step = dt;
    return commit(std::move(trial), until, dt, rate, iterations);
  }

  // One length of explicit steps, that ends at changes of the schedule.
  QuasiStaticRow move(double end) {
    const double stop_at = std::min(end, scene_.pump.next_change(state_.time));
    const std::size_t edges = path_.edges().size();
    for (double share = 1.0; share > shortest; share *= 0.5) {
      qs::State trial = state_;
      trial.motion.place.clear();
      trial.motion.velocity.clear();
      const int iterations = steps_moving(trial, share, stop_at);
      if (iterations < 0) {
        take_back(edges);
        continue;
      }
      trial.step = trial.motion.tried;
      const double until = trial.time, dt = until - state_.time;
      return commit(std::move(trial), until, dt, scene_.pump.volume(state_.time, until) / dt, iterations);
    }
    stop(shortest * qs::Dynamics(equations_, state_).stable_step());
  }

  // @param share of the stable step @return iterations of the last one; below 0: of one that does not
  // converge
  int steps_moving(qs::State& trial, double share, double stop_at) {
    const std::size_t edges = path_.edges().size();
    qs::Dynamics dynamics(equations_, state_);
    equations_.moving = dynamics_ = &dynamics;
    int iterations = 0;
    try {
      dynamics.set_faces(qs::face_forces(equations_, trial), 0);
      for (int i = 0; i < steps_in_row && trial.time < stop_at && iterations >= 0; ++i)
        iterations = step_moving(trial, share * dynamics.stable_step(), stop_at);
      if (iterations >= 0) {
        dynamics.find_forces(trial);
        dynamics.give_back(trial);
        trial.energies.radiated = trial.motion.radiated + trial.motion.damped + trial.motion.kinetic;
        qs::account_kept(equations_, state_, trial);
      }
    } catch (const NumericalError&) {  // the path has come to its end
      equations_.moving = dynamics_ = nullptr;
      take_back(edges);
      throw;
    }
    equations_.moving = dynamics_ = nullptr;
    return iterations;
  }

  int step_moving(qs::State& trial, double stable, double stop_at) {
    const double left = stop_at - trial.time, dt = std::min(stable, left);
    const double until = dt < left ? trial.time + dt : stop_at;
    const double rate = scene_.pump.volume(trial.time, until) / dt;
    const qs::State before = trial;
    trial.well_before = trial.well_pressure;
    dynamics_->predict(trial, dt);
    const int iterations = advance(trial, dt, rate);
    if (iterations < 0) return iterations;
    dynamics_->move(trial);
    finish_cells(trial, until, dt, rate);
    qs::account_flow(equations_, before, trial, dt, rate);
    trial.time = until;
    ++trial.motion.steps;
    return iterations;
  }

  // The state in motion as one at rest, with the same jumps and pressures.
  void start_rest() {
    qs::account_rest(equations_, state_);
    state_.motion.place.clear();
    state_.motion.velocity.clear();
  }

  bool near(const qs::State& other) const {
    double off = 0.0, all = 0.0;
    for (std::size_t k = 0; k < state_.jumps.size(); ++k) {
      off += std::pow(other.jumps[k] - state_.jumps[k], 2);
      all += std::pow(state_.jumps[k], 2);
    }
    const double pressure = state_.well_pressure - scene_.pore_pressure;
    return off <= close_by * close_by * all &&
           std::abs(other.well_pressure - state_.well_pressure) <= close_by * std::abs(pressure);
  }

  [[noreturn]] void stop(double dt) const {
    throw NumericalError(fmt::format(
        "quasi-static stage: no step converges at {:g} s (tried down to {:.1e} s, well pressure "
        "{:.4g} MPa); the fracture may be about to snap: give the well an impedance, or the fluid "
        "a viscosity{}",
        state_.time, dt, state_.well_pressure * 1e-6,
        scene_.control.hand_over ? "" : ", or allow run.hand_over"));
  }

  QuasiStaticScene scene_;
  EdgeMaterials materials_;
  Bulk bulk_;
  FracturePath path_;
  Condensation rock_;
  std::vector<InterfaceLaw> laws_;
  std::optional<MatrixDiffusion> matrix_;
  qs::Equations equations_;
  qs::State state_;
  int spent_ = 0;                     // iterations of the last attempt at a step
  bool ran_away_ = false;             // it would have grown too fast
  qs::Dynamics* dynamics_ = nullptr;  // during explicit steps
};

QuasiStatic::QuasiStatic(QuasiStaticScene scene) : solver_(std::make_unique<Solver>(std::move(scene))) {
  solver_->begin();
}
QuasiStatic::QuasiStatic(QuasiStaticScene scene, quasi_static::State state)
    : solver_(std::make_unique<Solver>(std::move(scene))) {
  solver_->go_on(std::move(state));
}
QuasiStatic::~QuasiStatic() = default;

const QuasiStaticScene& QuasiStatic::scene() const { return solver_->scene(); }
double QuasiStatic::time() const { return state().time; }
const quasi_static::State& QuasiStatic::state() const { return solver_->state(); }
QuasiStaticRow QuasiStatic::row() const { return qs::row_of(solver_->equations(), state()); }
QuasiStaticRow QuasiStatic::step(double end) { return solver_->step(end); }
void QuasiStatic::run(double end, const std::function<void(const QuasiStaticRow&)>& record) {
  while (time() < end) {
    const QuasiStaticRow row = step(end);
    if (record) record(row);
  }
}
SeismicEvent QuasiStatic::last_snap() const { return qs::snap_of(solver_->equations(), state()); }
std::vector<FractureCell> QuasiStatic::cells() const { return qs::cells_of(solver_->equations(), state()); }
const FracturePath& QuasiStatic::path() const { return solver_->path(); }
std::vector<Vec2> QuasiStatic::corner_displacement() const {
  return qs::corners_of(solver_->equations(), state());
}
std::vector<Sym2> QuasiStatic::stress(const std::vector<Vec2>& corner_displacement) const {
  return qs::stress_of(solver_->equations(), corner_displacement);
}
double QuasiStatic::strength() const { return solver_->strength(); }

}  // namespace crackle
