// SPDX-License-Identifier: GPL-3.0-or-later
#include "crackle/fluid/fluid.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numeric>

#include "crackle/core/errors.hpp"
#include "loops.hpp"

namespace crackle {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

// Solves V* + Δt² s p = (m/ρ₀) exp(−(p − p₀)/K) for p by Newton's method.
double solve_pressure(const CompressibleFluid& f, double volume, double softness, double mass, double guess) {
  double p = guess;
  for (int i = 0; i < 50; ++i) {
    const double fluid_volume = mass / f.density * std::exp(-(p - f.reference_pressure) / f.bulk_modulus);
    const double miss = volume + softness * p - fluid_volume;
    const double step = miss / (softness + fluid_volume / f.bulk_modulus);
    p -= step;
    if (std::abs(step) <= 1e-13 * (std::abs(p) + 1e-3 * f.bulk_modulus)) break;
  }
  return p;
}

double reference_area(const State& state, Index triangle) {
  const Vec2 a = state.reference(3 * triangle);
  return 0.5 * cross(state.reference(3 * triangle + 1) - a, state.reference(3 * triangle + 2) - a);
}

// A cavity is at one of its vertices.
bool touches(const State& state, const DamagedTriangle& d) {
  return std::ranges::any_of(state.mesh->triangles[at(d.triangle)],
                             [&](Index v) { return state.fluid.cavity_of_vertex[at(v)] >= 0; });
}

}  // namespace

Fluid::Fluid(const State& state, const CompressibleFluid& fluid, Pump pump)
    : fluid_(fluid), pump_(std::move(pump)) {
  const Mesh& mesh = *state.mesh;
  edges_of_vertex_first_.assign(mesh.vertices.size() + 1, 0);
  for (const Edge& e : mesh.edges) {
    for (const Index v : e.vertex) ++edges_of_vertex_first_[at(v) + 1];
  }
  std::partial_sum(edges_of_vertex_first_.begin(), edges_of_vertex_first_.end(),
                   edges_of_vertex_first_.begin());
  edges_of_vertex_.resize(2 * mesh.edges.size());
  std::vector<Index> next(edges_of_vertex_first_.begin(), edges_of_vertex_first_.end() - 1);
  for (std::size_t e = 0; e < mesh.edges.size(); ++e) {
    for (const Index v : mesh.edges[e].vertex) edges_of_vertex_[at(next[at(v)]++)] = static_cast<Index>(e);
  }
  rebuild(state);
}

void Fluid::rebuild(const State& state) {
  loops_ = wetted_loops(state, leaks_);
  rock_.assign(state.fluid.cavities.size(), 0.0);
  for (const DamagedTriangle& d : state.damage.triangles) {
    if (d.cavity < 0) continue;
    loops_.push_back({d.cavity, {3 * d.triangle + 2, 3 * d.triangle + 1, 3 * d.triangle}});
    rock_[at(d.cavity)] += reference_area(state, d.triangle);
  }
  std::map<Index, Index> slot_of_node;
  wet_.clear();
  slots_.assign(loops_.size(), {});
  for (std::size_t l = 0; l < loops_.size(); ++l) {
    for (const Index corner : loops_[l].corners) {
      const Index node = state.node_of_corner[at(corner)];
      const auto [it, fresh] = slot_of_node.try_emplace(node, static_cast<Index>(wet_.size()));
      if (fresh) wet_.push_back({node, loops_[l].cavity, {}});
      slots_[l].push_back(it->second);
    }
  }
  measure(state);
  if (flow_) flow_->rebuild(state);
}

void Fluid::measure(const State& state) {
  volume_.assign(state.fluid.cavities.size(), 0.0);
  for (std::size_t c = 0; c < rock_.size(); ++c) volume_[c] -= rock_[c];
  compliance_.assign(state.fluid.cavities.size(), 0.0);
  for (Wet& w : wet_) w.gradient = {};
  for (std::size_t l = 0; l < loops_.size(); ++l) {
    // The rock lies to the left of the loop, the fluid to its right: V = −½ Σ x_k × x_{k+1}. About
    // the loop's first point, so that a far origin costs no digits.
    const auto& corners = loops_[l].corners;
    const Vec2 origin = state.reference(corners.front());
    double area = 0.0;
    Vec2 before = state.position(corners.back()) - origin;
    Vec2 here = state.position(corners.front()) - origin;
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const Vec2 after = state.position(corners[k + 1 < corners.size() ? k + 1 : 0]) - origin;
      area -= 0.5 * cross(here, after);
      wet_[at(slots_[l][k])].gradient += Vec2{0.5 * (before.y - after.y), 0.5 * (after.x - before.x)};
      before = here;
      here = after;
    }
    volume_[at(loops_[l].cavity)] += area;
  }
  for (const Wet& w : wet_) {
    compliance_[at(w.cavity)] += dot(w.gradient, w.gradient) * state.inverse_mass[at(w.node)];
  }
}

void Fluid::flow(State& state, FlowChoice choice) {
  flow_.emplace(fluid_, std::move(choice));
  const bool begun = !state.fluid.cells.empty();
  flow_->take_up(state);
  if (!begun) flow_->fill(state);
}

double Fluid::pressure(const State& state, Index edge) const {
  if (flow_) return flow_->pressure(state, edge);
  return state.fluid.cavities[at(state.fluid.cavity_of_edge[at(edge)])].pressure;
}

Index Fluid::fill(State& state, std::span<const Index> edges, double pressure) {
  const Index cavity = static_cast<Index>(state.fluid.cavities.size());
  state.fluid.cavities.emplace_back();
  for (const Index e : edges) {
    state.fluid.cavity_of_edge[at(e)] = cavity;
    for (const Index v : state.mesh->edges[at(e)].vertex) state.fluid.cavity_of_vertex[at(v)] = cavity;
  }
  rebuild(state);
  state.fluid.cavities.back().volume = volume_[at(cavity)];
  state.fluid.cavities.back().pressure = pressure;
  state.fluid.cavities.back().mass = fluid_.mass(volume_[at(cavity)], pressure);
  return cavity;
}

void Fluid::refill(State& state, double pressure) {
  rebuild(state);
  for (std::size_t c = 0; c < state.fluid.cavities.size(); ++c) {
    state.fluid.cavities[c].volume = volume_[c];
    state.fluid.cavities[c].pressure = pressure;
    state.fluid.cavities[c].mass = fluid_.mass(volume_[c], pressure);
  }
}

// A closed edge of a joint where the fluid enters joints as they open.
bool Fluid::waits(const State& state, Index edge) const {
  if (!joints_as_they_open_ || state.mesh->edges[at(edge)].joint < 0) return false;
  const CohesiveElements& c = state.cohesive;
  const Index element = c.of_edge[at(edge)];
  if (c.status[at(element)] == CohesiveStatus::released) return false;
  return c.histories[at(c.history_of[at(element)])].point[2].opening <= 0.0;
}

std::vector<Index> Fluid::opened_joints(const State& state) const {
  std::vector<Index> opened;
  for (std::size_t e = 0; e < state.mesh->edges.size(); ++e) {
    const Edge& edge = state.mesh->edges[e];
    const Index element = state.cohesive.of_edge[e];
    if (edge.joint < 0 || element < 0 || state.fluid.cavity_of_edge[e] >= 0) continue;
    if (state.cohesive.status[at(element)] < CohesiveStatus::broken) continue;
    const bool reached = state.fluid.cavity_of_vertex[at(edge.vertex[0])] >= 0 ||
                         state.fluid.cavity_of_vertex[at(edge.vertex[1])] >= 0;
    if (reached && !waits(state, static_cast<Index>(e))) opened.push_back(element);
  }
  return opened;
}

std::vector<Index> Fluid::damaged_ahead(const State& state) const {
  std::vector<Index> ahead;
  for (const CohesiveHistory& h : state.cohesive.histories) {
    const Index e = state.cohesive.edge[at(h.element)];
    if (state.fluid.cavity_of_edge[at(e)] >= 0 || waits(state, e)) continue;
    const CohesivePoint& middle = h.point[2];
    if (middle.damage == 0.0 || middle.opening <= 0.0) continue;
    const auto& v = state.mesh->edges[at(e)].vertex;
    if (state.fluid.cavity_of_vertex[at(v[0])] >= 0 || state.fluid.cavity_of_vertex[at(v[1])] >= 0)
      ahead.push_back(h.element);
  }
  return ahead;
}

std::vector<Index> Fluid::damaged_triangles_ahead(const State& state) const {
  std::vector<Index> ahead;
  const auto& damaged = state.damage.triangles;
  for (std::size_t i = 0; i < damaged.size(); ++i) {
    const DamagedTriangle& d = damaged[i];
    if (d.cavity < 0 && d.opening > 0.0 && touches(state, d)) ahead.push_back(static_cast<Index>(i));
  }
  return ahead;
}

void Fluid::connect(State& state, std::span<const Index> broken) {
  const FluidState& f = state.fluid;
  const Mesh& mesh = *state.mesh;
  Reached reached;
  for (const Index element : broken) {
    const Index e = state.cohesive.edge[at(element)];
    const auto& v = mesh.edges[at(e)].vertex;
    if (f.cavity_of_edge[at(e)] < 0 && !waits(state, e) &&
        (f.cavity_of_vertex[at(v[0])] >= 0 || f.cavity_of_vertex[at(v[1])] >= 0)) {
      reached.edges.push_back(e);
    }
  }
  wet(state, std::move(reached));
}

void Fluid::connect_triangles(State& state, std::span<const Index> damaged) {
  Reached reached;
  for (const Index i : damaged) {
    const DamagedTriangle& d = state.damage.triangles[at(i)];
    if (d.cavity < 0 && touches(state, d)) reached.triangles.push_back(i);
  }
  wet(state, std::move(reached));
}

void Fluid::wet(State& state, Reached reached) {
  if (reached.edges.empty() && reached.triangles.empty()) return;
  const Mesh& mesh = *state.mesh;
  const Spread before = flow_ ? Spread{} : before_spread(state);
  for (std::size_t e = 0, t = 0; e < reached.edges.size() || t < reached.triangles.size();) {
    if (e < reached.edges.size()) {
      const Index edge = reached.edges[e++];
      if (state.fluid.cavity_of_edge[at(edge)] >= 0) continue;
      const Index cavity = reach(state, mesh.edges[at(edge)].vertex, reached);
      state.fluid.cavity_of_edge[at(edge)] = cavity;
      continue;
    }
    DamagedTriangle& d = state.damage.triangles[at(reached.triangles[t++])];
    if (d.cavity >= 0) continue;
    const auto& vertices = mesh.triangles[at(d.triangle)];
    d.cavity = reach(state, vertices, reached);
    for (const Index v : vertices) {
      for (Index k = edges_of_vertex_first_[at(v)]; k < edges_of_vertex_first_[at(v) + 1]; ++k) {
        if (mesh.edges[at(edges_of_vertex_[at(k)])].kind == EdgeKind::outer) leaks_ = true;
      }
    }
  }
  if (flow_) {  // empty cells, which the flow will fill
    flow_->take_up(state);
    loops_ = wetted_loops(state, leaks_);
    return;
  }
  spread(state, before);
}

// The fluid comes to these vertices, at one of which it was: on from the others into what is broken there and
// waits for it. @return the cavity that it is of
Index Fluid::reach(State& state, std::span<const Index> vertices, Reached& reached) const {
  FluidState& f = state.fluid;
  const Mesh& mesh = *state.mesh;
  Index cavity = -1;
  for (const Index v : vertices) {
    const Index c = f.cavity_of_vertex[at(v)];
    if (c >= 0) cavity = cavity < 0 ? c : std::min(cavity, c);
  }
  for (const Index v : vertices) {
    const Index other = f.cavity_of_vertex[at(v)];
    f.cavity_of_vertex[at(v)] = cavity;
    if (other >= 0 && other != cavity) enter(state, cavity, other);
    if (other >= 0) continue;  // nothing waited there
    for (Index k = edges_of_vertex_first_[at(v)]; k < edges_of_vertex_first_[at(v) + 1]; ++k) {
      const Index next = edges_of_vertex_[at(k)];
      const Index element = state.cohesive.of_edge[at(next)];
      if (f.cavity_of_edge[at(next)] < 0 && element >= 0 &&
          state.cohesive.status[at(element)] >= CohesiveStatus::broken && !waits(state, next)) {
        reached.edges.push_back(next);
      }
      for (const Index t : mesh.edges[at(next)].triangle) {
        const bool rock = t >= 0 && !state.damage.of_triangle.empty();
        const Index damaged = rock ? state.damage.of_triangle[at(t)] : -1;
        if (damaged >= 0 && state.damage.triangles[at(damaged)].failed) reached.triangles.push_back(damaged);
      }
    }
  }
  return cavity;
}

// A cavity takes up another that it has come to.
void Fluid::enter(State& state, Index cavity, Index other) const {
  FluidState& f = state.fluid;
  f.cavities[at(cavity)].mass += f.cavities[at(other)].mass;
  f.cavities[at(cavity)].injected += f.cavities[at(other)].injected;
  f.cavities[at(cavity)].work += f.cavities[at(other)].work;
  f.cavities[at(other)] = {};
  std::replace(f.cavity_of_edge.begin(), f.cavity_of_edge.end(), other, cavity);
  std::replace(f.cavity_of_vertex.begin(), f.cavity_of_vertex.end(), other, cavity);
  for (DamagedTriangle& d : state.damage.triangles) {
    if (d.cavity == other) d.cavity = cavity;
  }
}

Fluid::Spread Fluid::before_spread(const State& state) {
  measure(state);
  return {measured_energy(state), measured_power(state)};
}

void Fluid::spread(State& state, const Spread& before) {
  FluidState& f = state.fluid;
  rebuild(state);
  // Fluid that expands into a void which it had not reached does no work on the rock: that energy is
  // lost in the rush, as viscous dissipation; but for what the sudden load does in half a step.
  const double lost = before.energy - measured_energy(state);
  const double work = 0.5 * state.time_step * (measured_power(state) - before.power);
  state.dissipation.viscous += std::max(0.0, lost - work);
  // Closed faces overlap by what their penalty gives way: where they become part of the cavity it shrinks.
  state.dissipation.inserted += std::max(0.0, work - lost);
  for (std::size_t c = 0; c < f.cavities.size(); ++c) {
    if (f.cavities[c].mass <= 0.0 || volume_[c] <= 0.0) continue;
    f.cavities[c].volume = volume_[c];
    f.cavities[c].pressure = fluid_.pressure(f.cavities[c].mass, volume_[c]);
  }
}

double Fluid::measured_energy(const State& state) const {
  double sum = 0.0;
  for (std::size_t c = 0; c < state.fluid.cavities.size(); ++c) {
    const double mass = state.fluid.cavities[c].mass;
    if (mass > 0.0 && volume_[c] > 0.0)
      sum += fluid_.energy(mass, volume_[c], fluid_.pressure(mass, volume_[c]));
  }
  return sum;
}

double Fluid::measured_power(const State& state) const {
  double sum = 0.0;
  for (const Wet& w : wet_) {
    const double mass = state.fluid.cavities[at(w.cavity)].mass;
    if (mass > 0.0 && volume_[at(w.cavity)] > 0.0 && state.inverse_mass[at(w.node)] > 0.0) {
      sum += fluid_.pressure(mass, volume_[at(w.cavity)]) * dot(w.gradient, state.velocity[at(w.node)]);
    }
  }
  return sum;
}

void Fluid::advance(State& state, double dt) {
  if (wet_.empty()) return;
  if (flow_) return flow_->advance(state, dt, pump_.volume(state.time, state.time + dt));
  FluidState& f = state.fluid;
  measure(state);
  const double injected = pump_.volume(state.time, state.time + dt);
  push_.assign(f.cavities.size(), 0.0);
  for (std::size_t c = 0; c < f.cavities.size(); ++c) {
    Cavity& cavity = f.cavities[c];
    if (held_) {
      push_[c] = *held_;
      continue;
    }
    if (compliance_[c] == 0.0 && volume_[c] == 0.0) continue;  // merged into another
    const double mass_in = c == 0 ? injected * fluid_.density : 0.0;
    const double before = cavity.pressure;
    if (cavity.mass == 0.0 && mass_in == 0.0) continue;  // a closed crack, empty as yet
    cavity.mass += mass_in;
    if (!(cavity.mass > 0.0)) {
      throw NumericalError(
          fmt::format("cavity {} holds no fluid (mass {:.3g} kg/m) at step {}, time {:.6g} s: "
                      "has the pump drawn more than there was?",
                      c, cavity.mass, state.step, state.time));
    }
    // Where the fluid is soft against the step the pressure at the step's beginning may push: the
    // integrator then conserves energy with it. Where it is not, the one at its end has to.
    const double softness = dt * dt * compliance_[c];
    const double stiff = softness * fluid_.bulk_modulus / std::max(volume_[c], 1e-300);  // (ω_f Δt)²
    const double implicit = std::clamp((stiff - 0.1) / 0.2, 0.0, 1.0);
    const double explicit_volume = volume_[c] + softness * (1.0 - implicit) * before;
    cavity.pressure = solve_pressure(fluid_, explicit_volume, softness * implicit, cavity.mass, before);
    push_[c] = (1.0 - implicit) * before + implicit * cavity.pressure;
    cavity.volume = volume_[c] + softness * push_[c];
    cavity.injected += mass_in / fluid_.density;
    cavity.work += mass_in * 0.5 * (fluid_.enthalpy(before) + fluid_.enthalpy(cavity.pressure));
    if (!(cavity.volume > 0.0)) {
      throw NumericalError(
          fmt::format("cavity {} has no volume left ({:.3g} m2) at step {}, time {:.6g} s: "
                      "its walls have closed on one another",
                      c, cavity.volume, state.step, state.time));
    }
  }
  for (const Wet& w : wet_) {
    const Vec2 kick = (dt * push_[at(w.cavity)] * state.inverse_mass[at(w.node)]) * w.gradient;
    state.velocity[at(w.node)] += kick;
    state.displacement[at(w.node)] += dt * kick;
  }
}

double Fluid::energy(const State& state) const {
  if (flow_) return flow_->energy(state);
  double sum = 0.0;
  for (const Cavity& c : state.fluid.cavities) sum += fluid_.energy(c.mass, c.volume, c.pressure);
  return sum;
}

double Fluid::wetted_length(const State& state) const {
  double sum = 0.0;
  for (Index i = 0; i < state.cohesive.count(); ++i) {
    if (state.fluid.cavity_of_edge[at(state.cohesive.edge[at(i)])] >= 0)
      sum += norm(state.cohesive.direction[at(i)]);
  }
  for (const DamagedTriangle& d : state.damage.triangles) {
    if (d.cavity >= 0) sum += reference_area(state, d.triangle) / d.length;
  }
  return sum;
}

std::vector<Fluid::CornerLoad> Fluid::corner_loads(const State& state) const {
  std::vector<CornerLoad> loads;
  if (flow_) flow_->for_each_load(state, [&](Index corner, Vec2 f) { loads.push_back({corner, f}); });
  for (std::size_t l = 0; l < (flow_ ? 0 : loops_.size()); ++l) {
    const Loop& loop = loops_[l];
    const double p = state.fluid.cavities[at(loop.cavity)].pressure;
    const auto& c = loop.corners;
    for (std::size_t k = 0; k < c.size(); ++k) {
      const Vec2 before = state.position(c[k > 0 ? k - 1 : c.size() - 1]);
      const Vec2 after = state.position(c[k + 1 < c.size() ? k + 1 : 0]);
      loads.push_back({c[k], {0.5 * p * (before.y - after.y), 0.5 * p * (after.x - before.x)}});
    }
  }
  std::stable_sort(loads.begin(), loads.end(),
                   [](const auto& a, const auto& b) { return a.corner < b.corner; });
  return loads;
}

void Fluid::add_corner_forces(const State& state, std::span<Vec2> forces) const {
  for (const CornerLoad& load : corner_loads(state)) forces[at(load.corner)] += load.force;
}

}  // namespace crackle
