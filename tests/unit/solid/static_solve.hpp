// SPDX-License-Identifier: GPL-3.0-or-later
//
// Equilibrium of the free nodes by Newton's method, with conjugate gradients on differences of the
// program's own forces: nothing of its stiffness is assembled here.
#pragma once

#include <cmath>
#include <numeric>
#include <vector>

#include "../../granite.hpp"

namespace crackle {

/// Forces on the nodes [N/m]: rock, elements if there are any, and constant loads per corner.
struct NodalForces {
  const Bulk& bulk;
  Cohesive* cohesive = nullptr;
  std::vector<Vec2> corner_loads;

  std::vector<Vec2> operator()(State& state) const {
    using granite::at;
    std::vector<Vec2> corner(3 * state.mesh->triangles.size());
    bulk.corner_forces(state, 0, state.mesh->triangle_count(), corner.data());
    if (cohesive != nullptr) {
      cohesive->add_tractions(state);
      for (Index e = 0; e < state.cohesive.count(); ++e) {
        const Edge& edge = state.mesh->edges[at(state.cohesive.edge[at(e)])];
        const EndForces& f = state.cohesive.force[at(e)];
        corner[at(3 * edge.triangle[0] + edge.side[0])] += f.end0;
        corner[at(3 * edge.triangle[0] + (edge.side[0] + 1) % 3)] += f.end1;
        corner[at(3 * edge.triangle[1] + (edge.side[1] + 1) % 3)] -= f.end0;
        corner[at(3 * edge.triangle[1] + edge.side[1])] -= f.end1;
      }
    }
    std::vector<Vec2> node(state.displacement.size());
    for (std::size_t c = 0; c < corner.size(); ++c) {
      node[at(state.node_of_corner[c])] += corner_loads.empty() ? corner[c] : corner[c] + corner_loads[c];
    }
    return node;
  }
};

/// Moves the free nodes (inverse mass above 0) to where no force is left. @param step [m] of the
/// differences. @return largest unbalanced force over the largest at the beginning
inline double solve_static(State& state, const NodalForces& forces, double step, int newton_passes = 4) {
  const auto free_part = [&](std::vector<Vec2> f) {
    for (std::size_t n = 0; n < f.size(); ++n) {
      if (state.inverse_mass[n] == 0.0) f[n] = {};
    }
    return f;
  };
  const auto product = [](const std::vector<Vec2>& a, const std::vector<Vec2>& b) {
    return std::transform_reduce(a.begin(), a.end(), b.begin(), 0.0, std::plus<>{}, dot);
  };
  const auto largest = [](const std::vector<Vec2>& a) {
    double most = 0.0;
    for (const Vec2 v : a) most = std::max(most, norm(v));
    return most;
  };
  double first = 0.0, now = 0.0;
  for (int pass = 0; pass <= newton_passes; ++pass) {
    const std::vector<Vec2> force = free_part(forces(state));
    now = largest(force);
    if (pass == 0) first = now;
    if (pass == newton_passes || now <= 1e-14 * first) break;
    const std::vector<Vec2> base = state.displacement;
    std::vector<Vec2> change(force.size()), residual = force, direction = force;
    double square = product(residual, residual);
    const double goal = 1e-22 * square;
    for (std::size_t i = 0; i < 4 * force.size() && square > goal; ++i) {
      const double scale = step / largest(direction);
      std::vector<Vec2> pushed(force.size());
      for (const double sign : {1.0, -1.0}) {
        for (std::size_t n = 0; n < base.size(); ++n)
          state.displacement[n] = base[n] + (sign * scale) * direction[n];
        const std::vector<Vec2> f = free_part(forces(state));
        for (std::size_t n = 0; n < f.size(); ++n) pushed[n] += (-sign / (2.0 * scale)) * f[n];
      }
      const double length = square / product(direction, pushed);
      for (std::size_t n = 0; n < change.size(); ++n) {
        change[n] += length * direction[n];
        residual[n] -= length * pushed[n];
      }
      const double next = product(residual, residual);
      for (std::size_t n = 0; n < change.size(); ++n)
        direction[n] = residual[n] + (next / square) * direction[n];
      square = next;
    }
    for (std::size_t n = 0; n < base.size(); ++n) state.displacement[n] = base[n] + change[n];
  }
  return first > 0.0 ? now / first : 0.0;
}

}  // namespace crackle
