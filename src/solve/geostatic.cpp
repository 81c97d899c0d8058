// SPDX-License-Identifier: GPL-3.0-or-later
//
// How a simulation comes to its start: equilibrium of the rock as it is excavated, the elastic ramp by static
// solves, and rest where something gave on the way.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <span>

#include "crackle/core/errors.hpp"
#include "crackle/core/parallel.hpp"
#include "crackle/solve/equilibrium.hpp"
#include "crackle/solve/simulation.hpp"
#include "sparse_solver.hpp"

namespace crackle {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

// Forces that the three cohesive elements round a triangle put on its corners; on face a they are
// the element's end forces, on face b the opposite at exchanged ends.
inline void add_element_forces(const Index* element_on_side, const EndForces* force, Vec2* corner) {
  for (int i = 0; i < 3; ++i) {
    const Index code = element_on_side[i];
    if (code < 0) continue;
    const EndForces& f = force[code >> 1];
    const bool b = code & 1;
    const double sign = b ? -1.0 : 1.0;
    const Vec2 here = b ? f.end1 : f.end0;
    const Vec2 next = b ? f.end0 : f.end1;
    Vec2& c0 = corner[i];
    Vec2& c1 = corner[i == 2 ? 0 : i + 1];
    c0.x += sign * here.x;
    c0.y += sign * here.y;
    c1.x += sign * next.x;
    c1.y += sign * next.y;
  }
}

// Loads of the fluid's pressure on the walls of a tied state, which `wet` holds the fluid of.
AddLoads wall_loads(State& wet, std::optional<Fluid>& fluid) {
  return [&](const State& tied, std::span<Vec2> forces) {
    if (!fluid) return;
    wet.displacement = tied.displacement;
    fluid->add_corner_forces(wet, forces);
  };
}

}  // namespace

bool Scene::may_ramp() const {
  const bool whole = (law && insertion.on_demand) || damage.law;
  return fluid && fast_forward && whole && damage.cut.empty() && cracks.empty() && joints.empty() &&
         !absorbing_boundary && !free_boundary && loads.empty();
}

// Wall of the wellbore and pre-cut cracks: where the fluid is at the start.
std::vector<Index> Simulation::wetted_edges(const Scene& scene) {
  std::vector<Index> edges;
  for (Index e = 0; e < scene.mesh->edge_count(); ++e) {
    if (scene.mesh->edges[at(e)].kind == EdgeKind::wellbore) edges.push_back(e);
  }
  std::ranges::copy_if(scene.cracks, std::back_inserter(edges),
                       [&](Index e) { return !std::ranges::binary_search(scene.dry_cracks, e); });
  return edges;
}

// Displacement of every vertex by the excavation and the initial pressure, the rock still whole and
// its outer boundary fixed.
std::vector<Vec2> Simulation::geostatic_displacement() {
  std::vector<char> fixed(scene_.mesh->vertices.size(), 0);
  bool any = false;
  for (const Edge& edge : scene_.mesh->edges) {
    if (edge.kind == EdgeKind::outer) fixed[at(edge.vertex[0])] = fixed[at(edge.vertex[1])] = 1, any = true;
  }
  if (!any) return std::vector<Vec2>(scene_.mesh->vertices.size());
  std::optional<Fluid> fluid;
  State wet = make_tied_state(scene_.mesh);
  if (scene_.fluid) {
    fluid.emplace(wet, *scene_.fluid, Pump{});
    fluid->fill(wet, wetted_edges(scene_), scene_.initial_pressure);
  }
  const StaticSolver solver(scene_.mesh, bulk_, fixed);
  std::vector<Vec2> displacement = solver.displacement(wall_loads(wet, fluid));
  if (scene_.may_ramp()) find_ramp(solver, wet, fluid, displacement);
  return displacement;
}

void Simulation::find_ramp(const StaticSolver& solver, State& wet, std::optional<Fluid>& fluid,
                           const std::vector<Vec2>& first) {
  const auto point = [&](double pressure, std::vector<Vec2> displacement) {
    wet.displacement = displacement;
    fluid->rebuild(wet);
    return Ramp::Point{pressure, fluid->volume(0), std::move(displacement)};
  };
  const auto equilibrium = [&](double pressure, const std::vector<Vec2>& start) {
    wet.fluid.cavities[0].pressure = pressure;
    return solver.displacement(wall_loads(wet, fluid), start);
  };
  const double p0 = scene_.initial_pressure;
  const double p1 = p0 + scene_.cohesive.tensile_strength;
  const Ramp::Point at_rest = point(p0, first);
  const Ramp::Point second = point(p1, equilibrium(p1, first));
  const std::optional<double> onset = onset_pressure(
      wet, bulk_, [&](Index e) -> const CohesiveMaterial& { return materials_.all[materials_.number(e)]; },
      scene_.insertion.threshold, at_rest, second);
  if (!onset || *onset <= p0) return;
  Ramp ramp(at_rest, point(*onset, equilibrium(*onset, second.displacement)), *scene_.fluid);
  // When has the pump injected that much?
  double low = 0.0, high = 1e-6;
  for (int i = 0; i < 100 && scene_.pump.volume(0.0, high) < ramp.capacity(); ++i) high *= 2.0;
  if (scene_.pump.volume(0.0, high) < ramp.capacity()) return;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (scene_.pump.volume(0.0, middle) < ramp.capacity() ? low : high) = middle;
  }
  double round = 0.0;
  for (const Edge& edge : scene_.mesh->edges) {
    if (edge.kind == EdgeKind::wellbore)
      round += norm(scene_.mesh->vertices[at(edge.vertex[1])] - scene_.mesh->vertices[at(edge.vertex[0])]);
  }
  if (low < 2.0 * round / slowest_shear_wave(scene_)) return;
  ramp_ = std::move(ramp);
  ramp_end_ = low;
}

Energies Simulation::ramp_to(double time) {
  // Work of the pump: enthalpy of what it has injected since the last call, in small parts.
  constexpr int parts = 16;
  Cavity& well = state_.fluid.cavities.front();
  double before = well.pressure;
  for (int i = 1; i <= parts; ++i) {
    const double injected = scene_.pump.volume(0.0, state_.time + (time - state_.time) * i / parts);
    const double pressure = ramp_->pressure(injected);
    const double mass = (injected - well.injected) * scene_.fluid->density;
    well.work += mass * 0.5 * (scene_.fluid->enthalpy(before) + scene_.fluid->enthalpy(pressure));
    well.mass += mass;
    well.injected = injected;
    before = pressure;
  }
  const double rate = ramp_->pressure_rate(before, scene_.pump.rate(time));
  for (Index v = 0; v < state_.node_count(); ++v) {
    state_.displacement[at(v)] = ramp_->displacement(v, before);
    state_.velocity[at(v)] = rate * ramp_->compliance(v);
  }
  fluid_->rebuild(state_);
  well.volume = fluid_->volume(0);
  well.pressure = scene_.fluid->pressure(well.mass, well.volume);
  if (!state_.fluid.cells.empty()) state_.fluid.cells.front() = {-1, well.mass, well.pressure, well.volume};
  state_.time = time;
  // The rock is in motion from the first instant: the pump's start gave it that.
  const double kinetic = kinetic_energy(state_.velocity);
  if (time == 0.0) well.work = kinetic;
  Energies e = potential_energies();
  e.kinetic = kinetic;
  return with_residual(e);
}

void Simulation::settle() {
  const Mesh& mesh = *scene_.mesh;
  // Forces at the corners now, rock and fluid: the cohesive elements are set to bear them.
  std::vector<Vec2> forces(3 * mesh.triangles.size());
  for_each_block(mesh.triangle_count(), [&](Index begin, Index end, Index) {
    bulk_.corner_forces(state_, begin, end, forces.data() + 3 * begin);
  });
  if (fluid_) fluid_->add_corner_forces(state_, forces);
  if (cohesive_) {
    const std::vector<double> mobility = state_.inverse_mass;
    fix_nodes(state_, EdgeKind::outer);  // the boundary bears what is left there, be it fixed or absorbing
    if (!scene_.insertion.on_demand) {
      geostatic_slips_ += static_cast<Index>(cohesive_->balance(state_, forces).size());
    }
    unbond_joints();
    state_.inverse_mass = mobility;
    cohesive_->add_tractions(state_);
    wet_joints();
  }
  if (scene_.absorbing_boundary || loads_) bear_geostatic_loads(std::move(forces));
  tiles_.emplace(state_, physics());
  if (!stressed_.empty()) break_overstressed();
  if (geostatic_slips_ > 0 || !scene_.cracks.empty() || !scene_.damage.cut.empty()) relax();
  geostatic_slips_ += rough_insertions_;
  rough_insertions_ = 0;
  stopwatch_ = {};
  if (fluid_ && scene_.flow) fluid_->flow(state_, {*scene_.flow, sparse_solver()});
  state_.dissipation = {};
  // The residual is not measured against less energy than strains of 3e-7 everywhere hold: while the
  // first wave leaves the wellbore everything is smaller than one step of the pump.
  scale_ = 0.0;
  for (Index t = 0; t < mesh.triangle_count(); ++t)
    scale_ += 1e-13 * scene_.rock_of(t).stiffness.largest() * bulk_.area(t);
  reference_ = {};
  reference_.strain = bulk_.strain_energy(state_);
  if (damage_) reference_.strain += damage_->stored_energy_correction(state_, bulk_);
  if (cohesive_) reference_.cohesive = cohesive_->stored_energy(state_);
  if (fluid_) reference_.fluid = fluid_->energy(state_);
}

// The outer boundary that moves bears as constant loads what held it until now.
void Simulation::bear_geostatic_loads(std::vector<Vec2> forces) {
  const Mesh& mesh = *scene_.mesh;
  for (Index t = 0; t < mesh.triangle_count(); ++t) {
    add_element_forces(&state_.element_on_side[at(3 * t)], state_.cohesive.force.data(), &forces[at(3 * t)]);
  }
  if (loads_) return loads_->bear(state_, forces);
  std::vector<char> outer(mesh.vertices.size(), 0);
  for (const Edge& edge : mesh.edges) {
    if (edge.kind == EdgeKind::outer) outer[at(edge.vertex[0])] = outer[at(edge.vertex[1])] = 1;
  }
  for (std::size_t c = 0; c < forces.size(); ++c) {
    forces[c] = outer[at(mesh.triangles[c / 3][c % 3])] ? -forces[c] : Vec2{};
  }
  const auto rock = [&](Index t) {
    return BulkMaterial{scene_.rock_of(t).stiffness, scene_.rock_of(t).density, {}};
  };
  boundary_.emplace(state_, rock, forces);
}

// Masses with which no node is faster or slower than the step: waves, which are what has to die away, cross a
// large triangle in as many steps as a small one.
void Simulation::grade_masses() {
  for (Index n = 0; n < state_.node_count(); ++n) {
    double& inverse = state_.inverse_mass[at(n)];
    if (inverse > 0.0 && state_.node_size[at(n)] > 0)
      inverse = 1.0 / mass_of_step(state_, bulk_, cohesive(), n, stable_.limit);
  }
}

void Simulation::relax() {
  // Round a cut waves have far to go. Only where no node will part, whose parts would have to be graded anew.
  const std::vector<double> inverse_mass = state_.inverse_mass;
  const bool graded = cohesive_ && !scene_.insertion.on_demand && !scene_.cracks.empty();
  if (graded) grade_masses();
  come_to_rest();
  if (graded) state_.inverse_mass = inverse_mass;
}

void Simulation::come_to_rest() {
  // Kinetic damping: whenever the kinetic energy has passed a peak, everything stops and starts again.
  // Well below the stable step: near it, stopping at every peak can lock into a short cycle.
  const double dt = 0.3 * stable_.limit;
  double before = 0.0, peak = 0.0;
  // Strains of 1e-11 everywhere: with less nothing moves, as where a crack is closed by the stress.
  double nothing = 0.0;
  for (Index t = 0; t < scene_.mesh->triangle_count(); ++t)
    nothing += 1e-22 * scene_.rock_of(t).stiffness.largest() * bulk_.area(t);
  const int most = 200000;
  const bool pressed = fluid_ && scene_.initial_pressure != 0.0 &&
                       scene_.cracks.size() + scene_.damage.cut.size() > scene_.dry_cracks.size();
  // A crack has no volume yet to hold fluid by its mass. Pressed at once it would overshoot and might grow:
  // in some runs of a wave along it.
  const int rise = pressed ? 40 * static_cast<int>(scene_.cracks.size() + scene_.damage.cut.size()) : 0;
  for (int i = 0; i < most; ++i) {
    if (i <= rise && pressed) fluid_->hold(scene_.initial_pressure * i / rise);
    state_.time = -2.0 * dt;  // before the pump starts
    advance(dt, nullptr);
    if (cohesive_) geostatic_slips_ += static_cast<Index>(cohesive_->newly_broken().size());
    if (damage_) geostatic_slips_ += static_cast<Index>(damage_->newly_failed().size());
    double kinetic = 0.0;
    for (std::size_t n = 0; n < state_.velocity.size(); ++n) {
      if (state_.inverse_mass[n] > 0.0)
        kinetic += 0.5 * dot(state_.velocity[n], state_.velocity[n]) / state_.inverse_mass[n];
    }
    peak = std::max(peak, kinetic);
    if (kinetic < before || kinetic == 0.0) {
      std::fill(state_.velocity.begin(), state_.velocity.end(), Vec2{});
      if (i > rise && before <= std::max(1e-9 * peak, nothing)) {
        state_.time = 0.0;
        state_.step = 0;
        if (pressed) {
          fluid_->hold({});
          fluid_->refill(state_, scene_.initial_pressure);
        }
        return;
      }
      kinetic = 0.0;
    }
    before = kinetic;
  }
  throw NumericalError(
      fmt::format("the geostatic stage does not come to rest within {} relaxation steps: {} cohesive "
                  "elements were beyond their strength after the excavation; is the rock too weak for "
                  "this stress?",
                  most, geostatic_slips_));
}

double Simulation::imbalance() {
  const Mesh& mesh = *scene_.mesh;
  std::vector<Vec2> forces(3 * mesh.triangles.size());
  for_each_block(mesh.triangle_count(), [&](Index begin, Index end, Index) {
    bulk_.corner_forces(state_, begin, end, forces.data() + 3 * begin);
  });
  for (const DamagedTriangle& d : state_.damage.triangles)
    std::ranges::copy(d.force, forces.begin() + 3 * d.triangle);
  double largest = 0.0;
  for (const Vec2 f : forces) largest = std::max(largest, norm(f));
  if (cohesive_) cohesive_->add_tractions(state_);
  if (fluid_) fluid_->add_corner_forces(state_, forces);
  std::vector<Vec2> sum(at(state_.node_count()));
  if (boundary_) boundary_->add_loads(sum);
  for (Index t = 0; t < mesh.triangle_count(); ++t) {
    add_element_forces(&state_.element_on_side[at(3 * t)], state_.cohesive.force.data(), &forces[at(3 * t)]);
    for (Index i = 0; i < 3; ++i) sum[at(state_.node_of_corner[at(3 * t + i)])] += forces[at(3 * t + i)];
  }
  if (loads_) loads_->balance(state_, sum);
  double unbalanced = 0.0;
  for (std::size_t n = 0; n < sum.size(); ++n) {
    if (state_.inverse_mass[n] > 0.0) unbalanced = std::max(unbalanced, norm(sum[n]));
  }
  return largest > 0.0 ? unbalanced / largest : 0.0;
}

}  // namespace crackle
