// SPDX-License-Identifier: GPL-3.0-or-later
#include "crackle/solve/simulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

#include "crackle/core/errors.hpp"
#include "crackle/core/parallel.hpp"
#include "crackle/seismic/listener.hpp"
#include "crackle/solve/lanczos.hpp"
#include "sparse_solver.hpp"

namespace crackle {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

}  // namespace

double Simulation::longest_joint_edge(const Mesh& mesh) {
  double longest = 0.0;
  for (const Edge& edge : mesh.edges) {
    if (edge.joint < 0) continue;
    longest = std::max(longest, norm(mesh.vertices[at(edge.vertex[1])] - mesh.vertices[at(edge.vertex[0])]));
  }
  return longest;
}

Simulation::Simulation(Scene scene)
    : scene_(std::move(scene)), materials_(edge_materials(scene_)), bulk_(bulk_of(scene_, scene_.damping)) {
  // First, while there is little else in memory: the factorisation is the largest thing of all.
  const std::vector<Vec2> displacement = geostatic_displacement();
  const bool split = scene_.law && !scene_.insertion.on_demand;
  state_ = split ? make_split_state(scene_.mesh) : make_tied_state(scene_.mesh);
  for (std::size_t c = 0; c < state_.node_of_corner.size(); ++c) {
    state_.displacement[at(state_.node_of_corner[c])] =
        displacement[at(scene_.mesh->triangles[c / 3][c % 3])];
  }
  set_mass(state_, bulk_);
  if (bulk_.viscous()) state_.strain_rate.resize(at(block_count(scene_.mesh->triangle_count())));
  if (scene_.law) {
    cohesive_.emplace(scene_.law, materials_.all);
    if (split) {
      insert_all(state_);
      set_materials(state_, scene_, materials_);
      cut_cracks();
    }
  }
  if (scene_.contact.normal_penalty > 0.0) contact_.emplace(state_, scene_.contact);
  if (scene_.fluid) {
    fluid_.emplace(state_, *scene_.fluid, scene_.pump);
    if (scene_.joints_edge_by_edge) fluid_->enter_joints_as_they_open();
    fluid_->fill(state_, wetted_edges(scene_), scene_.initial_pressure);
  }
  if (scene_.free_boundary || !scene_.loads.empty()) {
    loads_.emplace(*scene_.mesh, scene_.loads);
    loads_->hold(state_, scene_.free_boundary);
  } else if (!scene_.absorbing_boundary) {
    fix_nodes(state_, EdgeKind::outer);
  }
  stable_ = stable_step(state_, bulk_, cohesive());
  if (!split && scene_.law) {
    stable_.limit *= scene_.insertion.step;
    prepare_insertion();
  }
  // Nothing is inserted, and damage only makes the rock softer: its highest frequency holds for the whole
  // run.
  if (scene_.damage.law && !scene_.law) stable_ = sharpened(stable_, state_, bulk_, nullptr);
  if (scene_.damage.law) {
    begin_damage();
    for (const CutTriangle& cut : scene_.damage.cut) {
      damage_->cut(state_, bulk_, cut.triangle, cut.normal);
      bulk_.drop_viscosity(cut.triangle);
    }
    if (fluid_) {
      std::vector<Index> cut(scene_.damage.cut.size());
      std::iota(cut.begin(), cut.end(), 0);
      fluid_->connect_triangles(state_, cut);
      fluid_->refill(state_, scene_.initial_pressure);
    }
  }
  settle();
}

Simulation::Simulation(Scene scene, State state, SimulationMemory memory)
    : scene_(std::move(scene)),
      materials_(edge_materials(scene_)),
      state_(std::move(state)),
      bulk_(bulk_of(scene_, scene_.damping)),
      stable_(memory.stable),
      stressed_(std::move(memory.stressed)),
      slowed_(memory.slowed),
      rough_insertions_(memory.rough_insertions),
      reference_(memory.reference),
      scale_(memory.scale),
      geostatic_slips_(memory.geostatic_slips) {
  const Index triangles = scene_.mesh->triangle_count();
  block_stressed_.assign(at(block_count(triangles)), 0);
  for (Index t = 0; t < triangles && !stressed_.empty(); ++t) {
    if (stressed_[at(t)]) block_stressed_[at(t / block_size)] = 1;
  }
  if (!stressed_.empty()) set_screen();
  if (scene_.damage.law) begin_damage();
  if (scene_.law) cohesive_.emplace(scene_.law, materials_.all);
  if (scene_.contact.normal_penalty > 0.0) {
    contact_.emplace(state_, scene_.contact);
    contact_->rebuild(state_);
  }
  if (scene_.fluid) {
    fluid_.emplace(state_, *scene_.fluid, scene_.pump);
    if (scene_.joints_edge_by_edge) fluid_->enter_joints_as_they_open();
    if (scene_.flow) fluid_->flow(state_, {*scene_.flow, sparse_solver()});
  }
  if (scene_.absorbing_boundary) boundary_.emplace(std::move(memory.boundary));
  if (scene_.free_boundary || !scene_.loads.empty()) {
    loads_.emplace(*scene_.mesh, scene_.loads);
    loads_->restore(std::move(memory.loads));
  }
  tiles_.emplace(state_, physics());
}

Sym2 Simulation::stress(Index triangle) const {
  const auto& numbers = state_.damage.of_triangle;
  const Index d = numbers.empty() ? -1 : numbers[at(triangle)];
  return d < 0 ? bulk_.stress(state_, triangle) : state_.damage.triangles[at(d)].stress;
}

SimulationMemory Simulation::memory() const {
  return {reference_,
          scale_,
          stable_,
          geostatic_slips_,
          slowed_,
          rough_insertions_,
          stressed_,
          boundary_ ? boundary_->nodes() : std::vector<BoundaryNode>{},
          loads_ ? loads_->memory() : LoadsMemory{}};
}

std::vector<LoadRecord> Simulation::take_loads() {
  return loads_ ? loads_->take(state_) : std::vector<LoadRecord>{};
}

double Simulation::stable_limit() const {
  const double contact = contact_ ? contact_->largest_frequency_squared(state_) : 0.0;
  if (contact == 0.0) return slowed_ * stable_.limit;
  const double alone = 2.0 / (slowed_ * stable_.limit);
  return 2.0 / std::sqrt(alone * alone + contact);
}

double Simulation::wellbore_pressure() const {
  return state_.fluid.cavities.empty() ? 0.0 : scene_.pore_pressure + state_.fluid.cavities.front().pressure;
}

void Simulation::move_nodes(double dt) {
  for (const double p : tiles_->move(state_, physics(), dt, screen_, stressed_, block_stressed_))
    state_.dissipation.viscous += dt * p;
}

void Simulation::heed_activated() {
  const auto fresh = std::span(state_.cohesive.active).subspan(active_known_);
  if (!fresh.empty()) tiles_->elements_changed(state_, physics(), fresh);
  active_known_ = state_.cohesive.active.size();
}

std::vector<SeismicEvent> Simulation::with_edges_of_mesh(std::vector<SeismicEvent> slips) const {
  for (SeismicEvent& e : slips) {
    const Index corner = e.edge - scene_.mesh->edge_count();
    if (corner >= 0) e.edge = scene_.mesh->triangle_edges[at(corner / 3)][at(corner % 3)];
  }
  return slips;
}

void Simulation::listen_to_slips() {
  std::vector<SlidingEdge> edges;
  if (longest_joint_edge_ > 0.0) edges = sliding_edges(state_);
  if (contact_) {
    const auto sides = sliding_sides(state_, contact_->slips());
    edges.insert(edges.end(), sides.begin(), sides.end());
  }
  if (edges.empty() && state_.slips.edges.empty()) return;
  // Quiet for as long as a shear wave takes along three of the longest edges, or sides.
  double longest = longest_joint_edge_;
  const auto heed_side = [&](const auto& e) {
    if (e.edge >= scene_.mesh->edge_count()) longest = std::max(longest, 2.0 * e.length);
  };
  std::ranges::for_each(edges, heed_side);
  std::ranges::for_each(state_.slips.edges, heed_side);
  const double quiet = 3.0 * longest / slowest_shear_wave(scene_);
  const SlipRule rule{scene_.slip_rate, 0.5 * scene_.slip_rate, quiet};
  const auto ended =
      with_edges_of_mesh(track_slip(state_.slips, edges, {state_.time, state_.time_step}, rule, medium()));
  new_events_.insert(new_events_.end(), ended.begin(), ended.end());
}

void Simulation::advance(double dt, Energies* account) {
  stopwatch_.start();
  new_events_.clear();
  heed_activated();
  if (cohesive_) {
    cohesive_->advance_histories(state_);
    if (!damage_ && !stressed_.empty()) insert_stressed();
    stopwatch_.lap(Stopwatch::cohesive);
  }
  if (damage_) {
    damage_->update(state_, bulk_);
    crack_stressed();
    stopwatch_.lap(Stopwatch::cohesive);
    if (!damage_->newly_failed().empty()) {
      new_events_ = listen_to_damage(state_, damage_->newly_failed(), medium());
      stopwatch_.lap(Stopwatch::events);
      if (fluid_) fluid_->connect_triangles(state_, damage_->newly_failed());
      stopwatch_.lap(Stopwatch::fluid);
    }
  }
  if (contact_) {
    contact_->update(state_);
    stopwatch_.lap(Stopwatch::contact);
  }
  if (cohesive_ && !cohesive_->newly_broken().empty()) {
    const auto broke = listen(state_, cohesive_->newly_broken(), medium());
    new_events_.insert(new_events_.end(), broke.begin(), broke.end());
    stopwatch_.lap(Stopwatch::events);
    if (fluid_) fluid_->connect(state_, cohesive_->newly_broken());
    stopwatch_.lap(Stopwatch::fluid);
  }
  if (fluid_ && scene_.wets_damaged) {
    const std::vector<Index> damaged = fluid_->damaged_ahead(state_);
    if (!damaged.empty()) fluid_->connect(state_, damaged);
    const std::vector<Index> triangles = fluid_->damaged_triangles_ahead(state_);
    if (!triangles.empty()) fluid_->connect_triangles(state_, triangles);
    stopwatch_.lap(Stopwatch::fluid);
  }
  if (fluid_ && scene_.joints_edge_by_edge) {
    const std::vector<Index> opened = fluid_->opened_joints(state_);
    if (!opened.empty()) fluid_->connect(state_, opened);
    stopwatch_.lap(Stopwatch::fluid);
  }
  if ((longest_joint_edge_ > 0.0 || contact_) &&
      state_.time > 0.0) {  // what slid before was the geostatic stage
    listen_to_slips();
    stopwatch_.lap(Stopwatch::events);
  }
  if (fluid_ && fluid_->leaks()) {  // its cavity is no longer closed
    throw NumericalError(
        fmt::format("a fracture has reached the outer boundary at step {}, time {:.6g} s, and the "
                    "fluid would leave the model there: end the run earlier or make the domain larger",
                    state_.step, state_.time));
  }
  if (account != nullptr) {
    *account = potential_energies();
    velocity_before_ = state_.velocity;
    stopwatch_.lap(Stopwatch::ledger);
  }
  if (boundary_) boundary_->begin(state_);
  if (loads_) loads_->begin(state_);
  move_nodes(dt);
  if (contact_) contact_->apply(state_, dt);
  double radiated = boundary_ ? boundary_->apply(state_, dt) : 0.0;
  if (loads_) radiated += loads_->apply(state_, dt);
  stopwatch_.lap(Stopwatch::rock);
  if (fluid_) {
    fluid_->advance(state_, dt);
    stopwatch_.lap(Stopwatch::fluid);
  }
  if (account != nullptr) {
    // ½ Σ m v(n−½)·v(n+½): with the stored energies at n this is what the integrator conserves.
    account->kinetic = kinetic_energy(velocity_before_);
    account->viscous = state_.dissipation.viscous - (fluid_ ? fluid_->lost_ahead() : 0.0);
    account->external -= radiated;
    stopwatch_.lap(Stopwatch::ledger);
  }
  state_.time += dt;
  state_.time_step = dt;
  ++state_.step;
  if (cohesive_) cohesive_->start_histories(state_, tiles_->near(), dt);
}

double Simulation::kinetic_energy(const std::vector<Vec2>& before) const {
  return sum_over_blocks(state_.node_count(), [&](Index begin, Index end) {
    double sum = 0.0;
    for (Index n = begin; n < end; ++n) {
      if (state_.inverse_mass[at(n)] > 0.0) {
        sum += 0.5 * dot(before[at(n)], state_.velocity[at(n)]) / state_.inverse_mass[at(n)];
      }
    }
    return sum;
  });
}

Energies Simulation::potential_energies() const {
  Energies e;
  e.strain = bulk_.strain_energy(state_) - reference_.strain;
  if (damage_) e.strain += damage_->stored_energy_correction(state_, bulk_);
  if (cohesive_) e.cohesive = cohesive_->stored_energy(state_) - reference_.cohesive;
  if (contact_) e.cohesive += contact_->stored_energy(state_);
  if (fluid_) e.fluid = fluid_->energy(state_) - reference_.fluid;
  e.fracture = state_.dissipation.fracture;
  e.friction = state_.dissipation.friction;
  for (const Cavity& cavity : state_.fluid.cavities) e.external += cavity.work;
  e.external -= state_.dissipation.boundary;
  e.inserted = state_.dissipation.inserted;
  e.path = state_.dissipation.path;
  return e;
}

Energies Simulation::step_and_account(double dt) {
  Energies e;
  advance(dt, &e);
  return with_residual(e);
}

Energies Simulation::with_residual(Energies e) {
  const double stored = e.kinetic + e.strain + e.cohesive + e.fluid;
  const double spent = e.fracture + e.friction + e.viscous;
  scale_ = std::max({scale_, std::abs(e.external), std::abs(e.strain), std::abs(e.fluid), spent});
  e.residual = std::abs(stored + spent - e.external - e.inserted - e.path) / scale_;
  if (!std::isfinite(stored + spent)) stop_not_finite();
  return e;
}

void Simulation::stop_not_finite() const {
  const Mesh& mesh = *scene_.mesh;
  for (Index t = 0; t < mesh.triangle_count(); ++t) {
    for (Index i = 0; i < 3; ++i) {
      const std::size_t n = at(state_.node_of_corner[at(3 * t + i)]);
      const Vec2 u = state_.displacement[n], v = state_.velocity[n];
      if (std::isfinite(u.x) && std::isfinite(u.y) && std::isfinite(v.x) && std::isfinite(v.y)) continue;
      const Vec2 x = state_.reference(3 * t + i);
      throw NumericalError(
          fmt::format("motion is no longer finite in triangle {} at ({:.4g}, {:.4g}) m, step {}, time "
                      "{:.6g} s, step size {:.3g} s (stable: {:.3g} s): take a smaller run.safety",
                      t, x.x, x.y, state_.step, state_.time, state_.time_step, stable_.limit));
    }
  }
  throw NumericalError(
      fmt::format("energy is no longer finite at step {}, time {:.6g} s", state_.step, state_.time));
}

}  // namespace crackle
