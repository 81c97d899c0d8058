// SPDX-License-Identifier: GPL-3.0-or-later
#include "crackle/solve/time_step.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace crackle {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

}  // namespace

StableStep stable_step(const State& state, const Bulk& bulk, const Cohesive* cohesive) {
  const Mesh& mesh = *state.mesh;
  StableStep result;
  result.limit = std::numeric_limits<double>::infinity();
  const double modulus = 0.5 * bulk.stiffness().largest();  // λ + μ
  const Index none = 2 * state.cohesive.count();
  for (Index t = 0; t < mesh.triangle_count(); ++t) {
    const double area = bulk.area(t);
    const double mass = bulk.density() * area / 3.0;
    double sum = 0.0;
    double joints = 0.0;
    for (Index i = 0; i < 3; ++i) {
      const Vec2 side = state.reference(3 * t + (i + 1) % 3) - state.reference(3 * t + i);
      sum += dot(side, side);
      const Index code = state.element_on_side[at(3 * t + i)];
      if (cohesive == nullptr || code >= none) continue;
      const Edge& edge = mesh.edges[at(state.cohesive.edge[at(code / 2)])];
      const double other = bulk.density() * bulk.area(edge.triangle[code % 2 == 0 ? 1 : 0]) / 3.0;
      const double penalty = std::max(cohesive->material().penalty, cohesive->material().tangential_penalty);
      joints = std::max(joints, 0.5 * penalty * (1.0 / mass + 1.0 / other));
    }
    const double shape =
        (sum + std::sqrt(std::max(0.0, sum * sum - 48.0 * area * area))) / (8.0 * area * area);
    const double rock = 6.0 * modulus / bulk.density() * shape;
    const double omega = std::sqrt(rock + 2.0 * joints);
    const double xi = 3.0 * bulk.viscosity(t) / bulk.density() * shape / (2.0 * omega);
    const double limit = 2.0 / omega * (std::sqrt(1.0 + xi * xi) - xi);
    if (limit < result.limit) result = {limit, t, 2.0 / omega, 2.0 / std::sqrt(rock)};
  }
  return result;
}

std::string StableStep::explain(const Mesh& mesh) const {
  const auto& v = mesh.triangles[at(triangle)];
  const Vec2 c = (1.0 / 3.0) * (mesh.vertices[at(v[0])] + mesh.vertices[at(v[1])] + mesh.vertices[at(v[2])]);
  const char* cause = limit < 0.7 * without_viscosity              ? "its viscous damping"
                      : without_viscosity < 0.7 * without_elements ? "the penalty of its cohesive elements"
                                                                   : "its size and stiffness";
  return fmt::format(
      "stable step {:.3g} s, limited by {} in triangle {} at ({:.4g}, {:.4g}) m "
      "({:.3g} s without viscosity, {:.3g} s without cohesive elements too)",
      limit, cause, triangle, c.x, c.y, without_viscosity, without_elements);
}

}  // namespace crackle
