// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>

#include "crackle/seismic/slip_events.hpp"

namespace crackle {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

bool takes_part(const SlipMemory& memory, Index edge) {
  const auto found = std::lower_bound(memory.edges.begin(), memory.edges.end(), edge,
                                      [](const SlipEdge& s, Index e) { return s.edge < e; });
  return found != memory.edges.end() && found->edge == edge;
}

/// Mean of the points' values over the edge, by Simpson's rule.
template <class Value>
double mean(const CohesiveHistory& h, const Value& value) {
  return (value(h.point[0]) + value(h.point[1]) + 4.0 * value(h.point[2])) / 6.0;
}

SlidingEdge sliding_edge(const State& state, const CohesiveHistory& h) {
  const std::array<Index, 4>& nodes = state.cohesive.nodes[at(h.element)];
  std::array<Vec2, 4> x;  // a0, a1, b0, b1
  for (std::size_t i = 0; i < 4; ++i) {
    x[i] = state.node_reference(nodes[i]) + state.displacement[at(nodes[i])];
  }
  SlidingEdge e;
  e.edge = state.cohesive.edge[at(h.element)];
  e.vertex = state.mesh->edges[at(e.edge)].vertex;
  e.place = 0.25 * (x[0] + x[1] + x[2] + x[3]);
  e.direction = 0.5 * ((x[1] + x[3]) - (x[0] + x[2]));
  e.length = norm(state.cohesive.direction[at(h.element)]);
  e.slip_rate = state.time_step > 0.0 ? h.slid / state.time_step : 0.0;
  e.slip = mean(h, [](const CohesivePoint& p) { return p.plastic_slip; });
  e.opening = mean(h, [](const CohesivePoint& p) { return p.opening; });
  e.traction = mean(h, [](const CohesivePoint& p) { return p.shear + p.friction; });
  e.friction_work = h.rubbed;
  e.kinetic = face_kinetic_energy(state, h.element);
  return e;
}

}  // namespace

std::vector<SlidingEdge> sliding_edges(const State& state) {
  std::vector<SlidingEdge> edges;
  for (const CohesiveHistory& h : state.cohesive.histories) {
    if (state.cohesive.status[at(h.element)] != CohesiveStatus::broken) continue;
    const Index edge = state.cohesive.edge[at(h.element)];
    if (state.mesh->edges[at(edge)].joint < 0) continue;
    if (h.slid != 0.0 || takes_part(state.slips, edge)) edges.push_back(sliding_edge(state, h));
  }
  std::sort(edges.begin(), edges.end(), [](const auto& a, const auto& b) { return a.edge < b.edge; });
  return edges;
}

}  // namespace crackle
