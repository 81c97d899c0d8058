// SPDX-License-Identifier: GPL-3.0-or-later
#include "crackle/state/state.hpp"

#include <numeric>

namespace crackle {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

// Groups corners by the node each belongs to.
void group_corners(State& state, Index nodes) {
  const std::size_t corners = state.node_of_corner.size();
  state.node_size.assign(at(nodes), 0);
  for (const Index n : state.node_of_corner) ++state.node_size[at(n)];
  state.node_first.assign(at(nodes), 0);
  std::exclusive_scan(state.node_size.begin(), state.node_size.end(), state.node_first.begin(), Index{0});
  state.node_corners.resize(corners);
  std::vector<Index> next = state.node_first;
  for (std::size_t c = 0; c < corners; ++c) {
    state.node_corners[at(next[at(state.node_of_corner[c])]++)] = static_cast<Index>(c);
  }
  state.displacement.assign(at(nodes), {});
  state.velocity.assign(at(nodes), {});
  state.inverse_mass.assign(at(nodes), 0.0);
}

State make_state(std::shared_ptr<const Mesh> mesh, bool split) {
  State state;
  const std::size_t triangles = mesh->triangles.size();
  state.node_of_corner.resize(3 * triangles);
  for (std::size_t t = 0; t < triangles; ++t) {
    for (std::size_t i = 0; i < 3; ++i) {
      state.node_of_corner[3 * t + i] = split ? static_cast<Index>(3 * t + i) : mesh->triangles[t][i];
    }
  }
  group_corners(state, split ? static_cast<Index>(3 * triangles) : mesh->vertex_count());
  state.element_on_side.assign(3 * triangles, 0);  // 2 x 0 elements: the zero force
  state.cohesive.force.assign(1, {});
  state.fluid.cavity_of_edge.assign(mesh->edges.size(), -1);
  state.fluid.cavity_of_vertex.assign(mesh->vertices.size(), -1);
  state.mesh = std::move(mesh);
  return state;
}

}  // namespace

State make_split_state(std::shared_ptr<const Mesh> mesh) { return make_state(std::move(mesh), true); }

State make_tied_state(std::shared_ptr<const Mesh> mesh) { return make_state(std::move(mesh), false); }

void set_mass(State& state, double density) {
  std::vector<double> mass(state.inverse_mass.size(), 0.0);
  for (std::size_t t = 0; t < state.mesh->triangles.size(); ++t) {
    const Index c = static_cast<Index>(3 * t);
    const Vec2 x0 = state.reference(c);
    const double area = 0.5 * cross(state.reference(c + 1) - x0, state.reference(c + 2) - x0);
    for (Index i = 0; i < 3; ++i) mass[at(state.node_of_corner[at(c + i)])] += density * area / 3.0;
  }
  for (std::size_t n = 0; n < mass.size(); ++n) state.inverse_mass[n] = 1.0 / mass[n];
}

void fix_nodes(State& state, EdgeKind kind) {
  std::vector<char> on_boundary(state.mesh->vertices.size(), 0);
  for (const Edge& edge : state.mesh->edges) {
    if (edge.kind == kind) on_boundary[at(edge.vertex[0])] = on_boundary[at(edge.vertex[1])] = 1;
  }
  for (std::size_t c = 0; c < state.node_of_corner.size(); ++c) {
    if (on_boundary[at(state.mesh->triangles[c / 3][c % 3])]) {
      state.inverse_mass[at(state.node_of_corner[c])] = 0.0;
    }
  }
}

void insert_all(State& state) {
  const Mesh& mesh = *state.mesh;
  CohesiveElements& elements = state.cohesive;
  for (std::size_t e = 0; e < mesh.edges.size(); ++e) {
    const Edge& edge = mesh.edges[e];
    if (edge.kind != EdgeKind::interior) continue;
    const Index a = 3 * edge.triangle[0];
    const Index b = 3 * edge.triangle[1];
    const Index a0 = a + edge.side[0], a1 = a + (edge.side[0] + 1) % 3;
    const Index b1 = b + edge.side[1], b0 = b + (edge.side[1] + 1) % 3;
    const Index element = elements.count();
    elements.edge.push_back(static_cast<Index>(e));
    elements.nodes.push_back({state.node_of_corner[at(a0)], state.node_of_corner[at(a1)],
                              state.node_of_corner[at(b0)], state.node_of_corner[at(b1)]});
    elements.direction.push_back(state.reference(a1) - state.reference(a0));
    elements.inverse_length.push_back(1.0 / norm(elements.direction.back()));
    state.element_on_side[at(a0)] = 2 * element;
    state.element_on_side[at(b1)] = 2 * element + 1;
  }
  const std::size_t n = elements.edge.size();
  elements.offset.assign(n, {});
  elements.force.assign(n + 1, {});
  elements.status.assign(n, CohesiveStatus::intact);
  elements.history_of.assign(n, -1);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Edge& edge = mesh.edges[at(mesh.triangle_edges[t][i])];
      if (edge.kind != EdgeKind::interior) state.element_on_side[3 * t + i] = static_cast<Index>(2 * n);
    }
  }
}

}  // namespace crackle
