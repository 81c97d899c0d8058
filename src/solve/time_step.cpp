// SPDX-License-Identifier: GPL-3.0-or-later
#include "crackle/solve/time_step.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace crackle {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

// Gershgorin's rows of a node [N/m2, N s/m2], and its mass [kg/m].
struct NodeRows {
  double stiffness = 0.0, viscosity = 0.0, mass = 0.0;
};

NodeRows rows_of(const State& state, const Bulk& bulk, const Cohesive* cohesive, Index node) {
  const Mesh& mesh = *state.mesh;
  NodeRows r;
  for (Index k = 0; k < state.node_size[at(node)]; ++k) {
    const Index corner = state.node_corners[at(state.node_first[at(node)] + k)];
    r.stiffness += bulk.stiffness_rows(corner / 3)[at(corner % 3)];
    if (bulk.viscous()) r.viscosity += bulk.viscosity_rows(corner / 3)[at(corner % 3)];
    r.mass += bulk.density(corner / 3) * bulk.area(corner / 3) / 3.0;
    if (cohesive == nullptr) continue;
    for (const Index side : {corner % 3, (corner + 2) % 3}) {
      const Index element = state.cohesive.of_edge[at(mesh.triangle_edges[at(corner / 3)][at(side)])];
      if (element < 0) continue;
      const CohesiveMaterial material = cohesive->material(state, element);
      r.stiffness += std::max(material.penalty, material.tangential_penalty);
    }
  }
  return r;
}

}  // namespace

double node_step(const State& state, const Bulk& bulk, const Cohesive* cohesive, Index node) {
  const NodeRows r = rows_of(state, bulk, cohesive, node);
  return 2.0 * (std::sqrt(0.25 * r.viscosity * r.viscosity + r.mass * r.stiffness) - 0.5 * r.viscosity) /
         r.stiffness;
}

double mass_of_step(const State& state, const Bulk& bulk, const Cohesive* cohesive, Index node, double step) {
  const NodeRows r = rows_of(state, bulk, cohesive, node);
  return 0.25 * step * step * r.stiffness + 0.5 * step * r.viscosity;
}

double penalty_below(const State& state, const Bulk& bulk, Index e, double step) {
  const Edge& edge = state.mesh->edges[at(e)];
  double penalty = std::numeric_limits<double>::infinity();
  for (std::size_t f = 0; f < 2; ++f) {
    const Index t = edge.triangle[f];
    const double mass = bulk.density(t) * bulk.area(t) / 3.0;
    const auto stiffness = bulk.stiffness_rows(t), viscosity = bulk.viscosity_rows(t);
    for (const Index i : {Index{edge.side[f]}, (Index{edge.side[f]} + 1) % 3}) {
      penalty = std::min(
          penalty, 0.5 * (4.0 * mass / (step * step) - 2.0 * viscosity[at(i)] / step - stiffness[at(i)]));
    }
  }
  return penalty;
}

StableStep stable_step(const State& state, const Bulk& bulk, const Cohesive* cohesive) {
  const Mesh& mesh = *state.mesh;
  StableStep result;
  result.limit = std::numeric_limits<double>::infinity();
  for (Index t = 0; t < mesh.triangle_count(); ++t) {
    const double area = bulk.area(t), density = bulk.density(t);
    const double modulus = 0.5 * bulk.stiffness(t).largest();  // λ + μ
    const double mass = density * area / 3.0;
    double sum = 0.0;
    double joints = 0.0;
    for (Index i = 0; i < 3; ++i) {
      const Vec2 side = state.reference(3 * t + (i + 1) % 3) - state.reference(3 * t + i);
      sum += dot(side, side);
      const Index code = state.element_on_side[at(3 * t + i)];
      if (cohesive == nullptr || code < 0) continue;
      const Edge& edge = mesh.edges[at(state.cohesive.edge[at(code / 2)])];
      const Index neighbour = edge.triangle[code % 2 == 0 ? 1 : 0];
      const double other = bulk.density(neighbour) * bulk.area(neighbour) / 3.0;
      const CohesiveMaterial material = cohesive->material(state, code / 2);
      const double penalty = std::max(material.penalty, material.tangential_penalty);
      joints = std::max(joints, 0.5 * penalty * (1.0 / mass + 1.0 / other));
    }
    const double shape =
        (sum + std::sqrt(std::max(0.0, sum * sum - 48.0 * area * area))) / (8.0 * area * area);
    const double rock = 6.0 * modulus / density * shape;
    const double omega = std::sqrt(rock + 2.0 * joints);
    const double xi = 3.0 * bulk.viscosity(t) / density * shape / (2.0 * omega);
    const double limit = 2.0 / omega * (std::sqrt(1.0 + xi * xi) - xi);
    if (limit < result.limit) result = {limit, limit, 0.0, t, 2.0 / omega, 2.0 / std::sqrt(rock)};
  }
  if (state.node_count() == 3 * mesh.triangle_count()) return result;
  StableStep by_node = result;
  by_node.limit = std::numeric_limits<double>::infinity();
  for (Index n = 0; n < state.node_count(); ++n) {
    if (state.node_size[at(n)] == 0) continue;
    const double limit = node_step(state, bulk, cohesive, n);
    if (limit < by_node.limit) {
      by_node.limit = by_node.proven = limit;
      by_node.triangle = state.node_corners[at(state.node_first[at(n)])] / 3;
    }
  }
  by_node.without_viscosity = std::max(by_node.without_viscosity, by_node.limit);
  by_node.without_elements = std::max(by_node.without_elements, by_node.limit);
  return by_node.limit > result.limit ? by_node : result;
}

std::string StableStep::explain(const Mesh& mesh) const {
  const auto& v = mesh.triangles[at(triangle)];
  const Vec2 c = (1.0 / 3.0) * (mesh.vertices[at(v[0])] + mesh.vertices[at(v[1])] + mesh.vertices[at(v[2])]);
  const char* cause = proven < 0.7 * without_viscosity             ? "its viscous damping"
                      : without_viscosity < 0.7 * without_elements ? "the penalty of its cohesive elements"
                                                                   : "its size and stiffness";
  const std::string bound = fmt::format(
      "limited by {} in triangle {} at ({:.4g}, {:.4g}) m "
      "({:.3g} s without viscosity, {:.3g} s without cohesive elements too)",
      cause, triangle, c.x, c.y, without_viscosity, without_elements);
  if (margin == 0.0) return fmt::format("stable step {:.3g} s, {}", limit, bound);
  return fmt::format(
      "stable step {:.3g} s, from the highest frequency (by Lanczos' method, raised by {:.1f} %, by which it "
      "may be "
      "too low); the proven one is {:.3g} s, {}",
      limit, 100.0 * (1.0 / std::sqrt(1.0 - margin) - 1.0), proven, bound);
}

}  // namespace crackle
