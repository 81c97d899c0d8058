// SPDX-License-Identifier: GPL-3.0-or-later
#include "crackle/solve/boundary.hpp"

namespace crackle {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

}  // namespace

AbsorbingBoundary::AbsorbingBoundary(const State& state, const PlaneStiffness& stiffness, double density,
                                     std::span<const Vec2> loads) {
  const WaveSpeeds c = wave_speeds(stiffness, density);
  for (const Edge& edge : state.mesh->edges) {
    if (edge.kind != EdgeKind::outer) continue;
    const Index first = 3 * edge.triangle[0] + edge.side[0];
    const Index second = 3 * edge.triangle[0] + (edge.side[0] + 1) % 3;
    const Vec2 along = state.reference(second) - state.reference(first);
    const double half = 0.5 * norm(along);
    const Vec2 normal = (0.5 / half) * right_normal(along);
    for (const Index corner : {first, second}) {
      entries_.push_back(
          {state.node_of_corner[at(corner)], normal, density * c.p * half, density * c.s * half});
    }
  }
  for (std::size_t k = 0; k < loads.size(); ++k) {
    if (loads[k] != Vec2{}) loads_.push_back({state.node_of_corner[k], loads[k]});
  }
}

void AbsorbingBoundary::apply(State& state, double dt) const {
  for (const Load& load : loads_) {
    const Vec2 kick = (dt * state.inverse_mass[at(load.node)]) * load.force;
    state.velocity[at(load.node)] += kick;
    state.displacement[at(load.node)] += dt * kick;
    state.dissipation.boundary -= dt * dot(load.force, state.velocity[at(load.node)]);
  }
  for (const Entry& e : entries_) {
    Vec2& v = state.velocity[at(e.node)];
    const double w = dt * state.inverse_mass[at(e.node)];
    const double vn = dot(v, e.normal);
    const Vec2 vt = v - vn * e.normal;
    const double fn = vn / (1.0 + w * e.normal_dashpot);
    const Vec2 ft = (1.0 / (1.0 + w * e.tangent_dashpot)) * vt;
    state.dissipation.boundary +=
        dt * (e.normal_dashpot * fn * 0.5 * (vn + fn) + e.tangent_dashpot * 0.5 * dot(ft, vt + ft));
    const Vec2 damped = fn * e.normal + ft;
    state.displacement[at(e.node)] += dt * (damped - v);
    v = damped;
  }
}

void AbsorbingBoundary::add_loads(std::span<Vec2> node_forces) const {
  for (const Load& load : loads_) node_forces[at(load.node)] += load.force;
}

}  // namespace crackle
