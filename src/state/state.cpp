// SPDX-License-Identifier: GPL-3.0-or-later
#include "crackle/state/state.hpp"

#include <algorithm>
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

// Corners of faces a and b at an edge's ends: a0, a1, b0, b1.
std::array<Index, 4> corners_of_edge(const Edge& edge) {
  const Index a = 3 * edge.triangle[0], b = 3 * edge.triangle[1];
  return {a + edge.side[0], a + (edge.side[0] + 1) % 3, b + (edge.side[1] + 1) % 3, b + edge.side[1]};
}

void look_up_nodes(State& state, Index element) {
  const auto corners = corners_of_edge(state.mesh->edges[at(state.cohesive.edge[at(element)])]);
  for (std::size_t k = 0; k < 4; ++k) {
    state.cohesive.nodes[at(element)][k] = state.node_of_corner[at(corners[k])];
  }
}

void append_element(State& state, Index e, std::uint16_t material) {
  CohesiveElements& elements = state.cohesive;
  const auto corner = corners_of_edge(state.mesh->edges[at(e)]);
  const Index element = elements.count();
  elements.edge.push_back(e);
  elements.nodes.emplace_back();
  look_up_nodes(state, element);
  elements.direction.push_back(state.reference(corner[1]) - state.reference(corner[0]));
  elements.inverse_length.push_back(1.0 / norm(elements.direction.back()));
  elements.offset.push_back({});
  elements.material.push_back(material);
  elements.force.push_back({});
  elements.status.push_back(CohesiveStatus::intact);
  elements.history_of.push_back(-1);
  elements.of_edge[at(e)] = element;
  state.element_on_side[at(corner[0])] = 2 * element;
  state.element_on_side[at(corner[3])] = 2 * element + 1;
}

// Share of a corner in the mass of its node, up to a factor that is the same for all: the area of its
// triangle, times the density where that differs.
double mass_share(const State& state, Index corner) {
  const Index c = 3 * (corner / 3);
  const Vec2 x0 = state.reference(c);
  const double area = cross(state.reference(c + 1) - x0, state.reference(c + 2) - x0);
  return state.density.empty() ? area : state.density[at(corner / 3)] * area;
}

double mass_share(const State& state, const Index* corners, Index count) {
  double sum = 0.0;
  for (Index k = 0; k < count; ++k) sum += mass_share(state, corners[k]);
  return sum;
}

// True if two corners of a vertex are tied: their triangles share an edge at it without an element.
bool tied(const State& state, Index corner, Index other) {
  const Mesh& mesh = *state.mesh;
  for (const Index side : {corner % 3, (corner + 2) % 3}) {
    const Index e = mesh.triangle_edges[at(corner / 3)][at(side)];
    const Edge& edge = mesh.edges[at(e)];
    if ((edge.triangle[0] == other / 3 || edge.triangle[1] == other / 3) &&
        state.cohesive.of_edge[at(e)] < 0) {
      return true;
    }
  }
  return false;
}

// Parts one node into its tied fans. Its corners stay in their segment of node_corners, the fan of the
// first of them first: that one keeps the node's number.
void part_node(State& state, Index node, Parting& parting) {
  Index* corners = state.node_corners.data() + state.node_first[at(node)];
  const Index count = state.node_size[at(node)];
  const double share = mass_share(state, corners, count);
  const double inverse_mass = state.inverse_mass[at(node)];
  parting.nodes.push_back(node);
  for (Index begin = 0; begin < count;) {
    Index end = begin + 1;  // corners [begin, end) are one fan, grown until no tied one is left
    for (Index k = begin; k < end; ++k) {
      for (Index other = end; other < count; ++other) {
        if (!tied(state, corners[k], corners[other])) continue;
        std::rotate(corners + end, corners + other, corners + other + 1);
        ++end;
      }
    }
    if (begin == 0 && end == count) return;  // still one
    std::sort(corners + begin, corners + end);
    Index fan = node;
    if (begin > 0) {
      fan = state.node_count();
      state.node_first.push_back(state.node_first[at(node)] + begin);
      state.node_size.push_back(0);
      state.displacement.push_back(state.displacement[at(node)]);
      state.velocity.push_back(state.velocity[at(node)]);
      state.inverse_mass.push_back(0.0);
      parting.nodes.push_back(fan);
    }
    state.node_size[at(fan)] = end - begin;
    state.inverse_mass[at(fan)] = inverse_mass * (share / mass_share(state, corners + begin, end - begin));
    for (Index k = begin; k < end; ++k) state.node_of_corner[at(corners[k])] = fan;
    begin = end;
  }
}

void part_nodes(State& state, Index vertex, std::vector<Parting>& partings) {
  const std::span<const Index> corners = corners_at(state, vertex);
  const std::size_t before = partings.size();
  for (std::size_t k = 0; k < corners.size();) {
    const Index node = state.node_of_corner[at(corners[k])];
    k += at(state.node_size[at(node)]);
    Parting parting{vertex, {}};
    part_node(state, node, parting);
    if (parting.nodes.size() > 1) partings.push_back(std::move(parting));
  }
  if (partings.size() == before) return;
  for (const Index corner : corners) {
    for (const Index side : {corner % 3, (corner + 2) % 3}) {
      const Index element = state.cohesive.of_edge[at(state.mesh->triangle_edges[at(corner / 3)][at(side)])];
      if (element >= 0) look_up_nodes(state, element);
    }
  }
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
  state.element_on_side.assign(3 * triangles, -1);
  state.cohesive.of_edge.assign(mesh->edges.size(), -1);
  state.fluid.cavity_of_edge.assign(mesh->edges.size(), -1);
  state.fluid.cavity_of_vertex.assign(mesh->vertices.size(), -1);
  state.mesh = std::move(mesh);
  return state;
}

}  // namespace

State make_split_state(std::shared_ptr<const Mesh> mesh) { return make_state(std::move(mesh), true); }

State make_tied_state(std::shared_ptr<const Mesh> mesh) { return make_state(std::move(mesh), false); }

namespace {

template <class Density>
void lump_mass(State& state, const Density& density) {
  std::vector<double> mass(state.inverse_mass.size(), 0.0);
  for (std::size_t t = 0; t < state.mesh->triangles.size(); ++t) {
    const Index c = static_cast<Index>(3 * t);
    const Vec2 x0 = state.reference(c);
    const double area = 0.5 * cross(state.reference(c + 1) - x0, state.reference(c + 2) - x0);
    for (Index i = 0; i < 3; ++i) mass[at(state.node_of_corner[at(c + i)])] += density(t) * area / 3.0;
  }
  for (std::size_t n = 0; n < mass.size(); ++n) state.inverse_mass[n] = 1.0 / mass[n];
}

}  // namespace

void set_mass(State& state, double density) {
  lump_mass(state, [&](std::size_t) { return density; });
}

void set_mass(State& state, std::vector<double> density) {
  state.density = std::move(density);
  lump_mass(state, [&](std::size_t t) { return state.density[t]; });
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
  const auto interior =
      static_cast<std::size_t>(std::ranges::count(mesh.edges, EdgeKind::interior, &Edge::kind));
  CohesiveElements& elements = state.cohesive;
  const auto reserve = [&](auto&... arrays) { (arrays.reserve(interior), ...); };
  reserve(elements.edge, elements.nodes, elements.direction, elements.inverse_length, elements.offset,
          elements.material, elements.force, elements.status, elements.history_of);
  for (Index e = 0; e < mesh.edge_count(); ++e) {
    if (mesh.edges[at(e)].kind == EdgeKind::interior) append_element(state, e, 0);
  }
}

std::span<const Index> corners_at(const State& state, Index vertex) {
  // One segment of node_corners still, whatever nodes it has parted into: that of the node it began with.
  const Index first = state.node_first[at(vertex)];
  const Index last = vertex + 1 < state.mesh->vertex_count() ? state.node_first[at(vertex + 1)]
                                                             : static_cast<Index>(state.node_corners.size());
  return {state.node_corners.data() + first, at(last - first)};
}

std::vector<Parting> insert_elements(State& state, std::span<const Index> edges,
                                     std::span<const std::uint16_t> material) {
  std::vector<Index> vertices;
  for (std::size_t k = 0; k < edges.size(); ++k) {
    append_element(state, edges[k], material[k]);
    const auto& ends = state.mesh->edges[at(edges[k])].vertex;
    vertices.insert(vertices.end(), ends.begin(), ends.end());
  }
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  std::vector<Parting> partings;
  for (const Index v : vertices) part_nodes(state, v, partings);
  return partings;
}

double corner_mass(const State& state, Index corner) {
  const std::size_t node = at(state.node_of_corner[at(corner)]);
  if (state.inverse_mass[node] == 0.0) return 0.0;
  const Index* of_node = state.node_corners.data() + state.node_first[node];
  return mass_share(state, corner) / mass_share(state, of_node, state.node_size[node]) /
         state.inverse_mass[node];
}

double corner_kinetic_energy(const State& state, Index corner) {
  const Vec2 v = state.velocity[at(state.node_of_corner[at(corner)])];
  return 0.5 * corner_mass(state, corner) * dot(v, v);
}

std::array<double, 4> face_masses(const State& state, Index element) {
  const auto corners = corners_of_edge(state.mesh->edges[at(state.cohesive.edge[at(element)])]);
  std::array<double, 4> masses{};
  for (std::size_t k = 0; k < 4; ++k) masses[k] = corner_mass(state, corners[k]);
  return masses;
}

double face_kinetic_energy(const State& state, Index element, const std::array<double, 4>& masses) {
  double sum = 0.0;
  for (std::size_t k = 0; k < 4; ++k) {
    const Vec2 v = state.velocity[at(state.cohesive.nodes[at(element)][k])];
    sum += 0.5 * masses[k] * dot(v, v);
  }
  return sum;
}

}  // namespace crackle
