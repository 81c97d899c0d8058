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
    event.moment = moment_of_jump(medium.rock, direction, event.length, event.opening, event.slip);
    event.moment_magnitude = moment_magnitude(scalar_moment(event.moment) * medium.thickness);
    event.edge = c.edge[at(element)];
    events.push_back(event);
  }
  return events;
}

}  // namespace crackle
