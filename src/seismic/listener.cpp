// SPDX-License-Identifier: GPL-3.0-or-later
#include "crackle/seismic/listener.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace crackle {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

}  // namespace

std::string to_string(FailureMode mode) {
  switch (mode) {
    case FailureMode::tensile:
      return "tensile";
    case FailureMode::shear:
      return "shear";
    case FailureMode::mixed:
      return "mixed";
  }
  return "unknown";
}

std::string to_string(EventKind kind) { return kind == EventKind::breaking ? "breaking" : "slip"; }

double magnitude_of_energy(double energy) { return (std::log10(std::max(energy, 1e-12)) - 4.8) / 1.5; }

FailureMode failure_mode(double sliding_share) {
  if (sliding_share < 0.25) return FailureMode::tensile;
  return sliding_share > 0.75 ? FailureMode::shear : FailureMode::mixed;
}

std::vector<SeismicEvent> listen(const State& state, std::span<const Index> broken,
                                 const SeismicMedium& medium) {
  std::vector<SeismicEvent> events;
  for (const Index element : broken) {
    const CohesiveElements& c = state.cohesive;
    const CohesiveHistory& h = c.histories[at(c.history_of[at(element)])];
    SeismicEvent event;
    event.time = state.time;
    event.duration = state.time - h.yield_time;
    std::array<Vec2, 4> x;  // a0, a1, b0, b1
    for (std::size_t i = 0; i < 4; ++i) {
      const Index n = c.nodes[at(element)][i];
      x[i] = state.node_reference(n) + state.displacement[at(n)];
      event.place += 0.25 * x[i];
    }
    const Vec2 direction = 0.5 * ((x[1] + x[3]) - (x[0] + x[2]));
    event.mode = failure_mode(h.fracture_energy > 0.0 ? h.sliding_work / h.fracture_energy : 0.0);
    event.energy = h.kinetic_rise;
    event.magnitude = magnitude_of_energy(h.kinetic_rise * medium.thickness);
    event.fracture_energy = h.fracture_energy;
    event.friction_energy = h.friction_energy;
    event.length = norm(c.direction[at(element)]);
    event.opening = h.point[2].opening;
    event.slip = h.point[2].slip;
    const Lame& rock = medium.of(state.mesh->edges[at(c.edge[at(element)])].triangle[0]);
    event.moment = moment_of_jump(rock, direction, event.length, event.opening, event.slip);
    event.moment_magnitude = moment_magnitude(scalar_moment(event.moment) * medium.thickness);
    event.edge = c.edge[at(element)];
    events.push_back(event);
  }
  return events;
}

std::vector<SeismicEvent> listen_to_damage(const State& state, std::span<const Index> failed,
                                           const SeismicMedium& medium) {
  std::vector<SeismicEvent> events;
  for (const Index i : failed) {
    const DamagedTriangle& d = state.damage.triangles[at(i)];
    SeismicEvent event;
    event.time = state.time;
    event.duration = state.time - d.yield_time;
    std::array<Vec2, 3> x, reference;
    for (Index k = 0; k < 3; ++k) {
      x[at(k)] = state.position(3 * d.triangle + k);
      reference[at(k)] = state.reference(3 * d.triangle + k);
    }
    event.place = (1.0 / 3.0) * (x[0] + x[1] + x[2]);
    event.mode = failure_mode(d.fracture_energy > 0.0 ? d.sliding_work / d.fracture_energy : 0.0);
    event.energy = d.kinetic_rise;
    event.magnitude = magnitude_of_energy(d.kinetic_rise * medium.thickness);
    event.fracture_energy = d.fracture_energy;
    event.friction_energy = d.friction_energy;
    event.length = 0.5 * cross(reference[1] - reference[0], reference[2] - reference[0]) / d.length;
    event.opening = d.opening;
    event.slip = d.slip;
    const Vec2 along{-d.normal.y, d.normal.x};  // the crack's normal is to its right
    event.moment = moment_of_jump(medium.of(d.triangle), along, event.length, d.opening, d.slip);
    event.moment_magnitude = moment_magnitude(scalar_moment(event.moment) * medium.thickness);
    events.push_back(event);
  }
  return events;
}

}  // namespace crackle
