// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>

#include "crackle/seismic/slip_events.hpp"

namespace crackle {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

// Of an edge that takes part in an event under way; nullptr: it does not.
const SlipEdge* part_of(const SlipMemory& memory, Index edge) {
  const auto found = std::lower_bound(memory.edges.begin(), memory.edges.end(), edge,
                                      [](const SlipEdge& s, Index e) { return s.edge < e; });
  return found != memory.edges.end() && found->edge == edge ? &*found : nullptr;
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
    if (h.slid != 0.0 || part_of(state.slips, edge) != nullptr) edges.push_back(sliding_edge(state, h));
  }
  std::sort(edges.begin(), edges.end(), [](const auto& a, const auto& b) { return a.edge < b.edge; });
  return edges;
}

std::vector<SlidingEdge> sliding_sides(const State& state, std::span<const SideSlip> slips) {
  const Index first = state.mesh->edge_count();
  std::vector<SlidingEdge> edges;
  for (const SideSlip& s : slips) {
    const SlipEdge* known = part_of(state.slips, first + s.side);
    if (s.slid == 0.0 && known == nullptr) continue;
    const Index next = s.side % 3 == 2 ? s.side - 2 : s.side + 1;
    const auto& corners = state.mesh->triangles[at(s.side / 3)];
    const Vec2 start = state.position(s.side), end = state.position(next);
    SlidingEdge e;
    e.edge = first + s.side;
    e.partner = first + s.target;
    e.vertex = {corners[at(s.side % 3)], corners[at(next % 3)]};
    e.place = 0.5 * (start + end);
    e.direction = end - start;  // its rock lies to the left: face a
    e.length = 0.5 * std::max(s.cosine, 1e-6) * norm(state.reference(next) - state.reference(s.side));
    e.slip_rate = state.time_step > 0.0 ? s.slid / state.time_step : 0.0;
    e.slip = (known != nullptr ? known->slip : 0.0) + s.slid;
    e.traction = s.traction;
    e.friction_work = s.work;
    e.kinetic = corner_kinetic_energy(state, s.side) + corner_kinetic_energy(state, next);
    edges.push_back(e);
  }
  return edges;
}

}  // namespace crackle
