// SPDX-License-Identifier: GPL-3.0-or-later
#include "crackle/solve/boundary.hpp"

#include <map>

namespace crackle {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

}  // namespace

AbsorbingBoundary::AbsorbingBoundary(const State& state, const std::function<BulkMaterial(Index)>& rock,
                                     std::span<const Vec2> loads) {
  std::map<Index, BoundaryNode> nodes;
  for (const Edge& edge : state.mesh->edges) {
    if (edge.kind != EdgeKind::outer) continue;
    const Index first = 3 * edge.triangle[0] + edge.side[0];
    const Index second = 3 * edge.triangle[0] + (edge.side[0] + 1) % 3;
    const Vec2 along = state.reference(second) - state.reference(first);
    const double half = 0.5 * norm(along);
    const Vec2 n = (0.5 / half) * right_normal(along);
    const BulkMaterial material = rock(edge.triangle[0]);
    const double density = material.density;
    const WaveSpeeds c = wave_speeds(material.stiffness, density, n);
    // ρ [c_p n nᵀ + c_s (1 − n nᵀ)] L/2
    const double p = density * c.p * half, q = density * c.s * half;
    const Sym2 dashpot{q + (p - q) * n.x * n.x, q + (p - q) * n.y * n.y, (p - q) * n.x * n.y};
    for (const Index corner : {first, second}) {
      BoundaryNode& node = nodes[state.node_of_corner[at(corner)]];
      node.dashpot = node.dashpot + dashpot;
    }
  }
  for (std::size_t k = 0; k < loads.size(); ++k) {
    if (loads[k] != Vec2{}) nodes[state.node_of_corner[k]].load += loads[k];
  }
  for (auto& [index, node] : nodes) {
    node.node = index;
    nodes_.push_back(node);
  }
}

void AbsorbingBoundary::begin(const State& state) {
  for (BoundaryNode& n : nodes_) n.velocity_before = state.velocity[at(n.node)];
}

double AbsorbingBoundary::apply(State& state, double dt) const {
  double half = 0.0;
  for (const BoundaryNode& n : nodes_) {
    // v' = v + w f − ½ w C (v⁻ + v'),  w = Δt / m; v has the rock's kick already, v⁻ not
    const double w = dt * state.inverse_mass[at(n.node)];
    Vec2& v = state.velocity[at(n.node)];
    const Vec2 free = v + w * n.load - (0.5 * w) * (n.dashpot * n.velocity_before);
    const double xx = 1.0 + 0.5 * w * n.dashpot.xx, yy = 1.0 + 0.5 * w * n.dashpot.yy,
                 xy = 0.5 * w * n.dashpot.xy;
    const double determinant = xx * yy - xy * xy;
    const Vec2 damped{(yy * free.x - xy * free.y) / determinant, (xx * free.y - xy * free.x) / determinant};
    state.displacement[at(n.node)] += dt * (damped - v);
    v = damped;
    // Work of a force over a step is force times the mean of the velocities before and after.
    const Vec2 mean = 0.5 * (n.velocity_before + damped);
    const Vec2 taken = n.dashpot * mean - n.load;
    state.dissipation.boundary += dt * dot(taken, mean);
    half += 0.5 * dt * dot(taken, n.velocity_before);
  }
  return half;
}

void AbsorbingBoundary::add_loads(std::span<Vec2> node_forces) const {
  for (const BoundaryNode& n : nodes_) node_forces[at(n.node)] += n.load;
}

}  // namespace crackle
