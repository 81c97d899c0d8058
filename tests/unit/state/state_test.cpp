// SPDX-License-Identifier: GPL-3.0-or-later
//
// Nodes, masses and elements of the two kinds of state.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <random>

#include "../../granite.hpp"

namespace crackle {
namespace {

using granite::at;

std::shared_ptr<const Mesh> plate() {
  return std::make_shared<const Mesh>(
      jittered(structured_rectangle({0, 0}, {2, 1}, 8, 5, MeshPattern::cross), 0.2, 3));
}

double total_mass(const State& state) {
  double sum = 0.0;
  for (const double w : state.inverse_mass) sum += 1.0 / w;
  return sum;
}

TEST(State, TiedHasANodeAVertexSplitANodeACorner) {
  const auto mesh = plate();
  const State tied = make_tied_state(mesh), split = make_split_state(mesh);
  EXPECT_EQ(tied.node_count(), mesh->vertex_count());
  EXPECT_EQ(split.node_count(), 3 * mesh->triangle_count());
  for (const State* state : {&tied, &split}) {
    EXPECT_EQ(std::accumulate(state->node_size.begin(), state->node_size.end(), 0),
              3 * mesh->triangle_count());
    for (Index c = 0; c < 3 * mesh->triangle_count(); ++c) {
      EXPECT_EQ(state->node_reference(state->node_of_corner[at(c)]), state->reference(c));
    }
  }
}

TEST(State, MassIsThatOfThePlate) {
  for (State state : {make_tied_state(plate()), make_split_state(plate())}) {
    set_mass(state, 2500.0);
    std::printf("mass error %.1e\n", std::abs(total_mass(state) / 5000.0 - 1.0));
    EXPECT_NEAR(total_mass(state), 5000.0, 1e-9);
  }
}

TEST(State, FixedNodesAreThoseOnTheBoundary) {
  const auto mesh = plate();
  for (State state : {make_tied_state(mesh), make_split_state(mesh)}) {
    set_mass(state, 2500.0);
    fix_nodes(state, EdgeKind::outer);
    for (Index n = 0; n < state.node_count(); ++n) {
      const Vec2 x = state.node_reference(n);
      const bool rim = x.x == 0.0 || x.x == 2.0 || x.y == 0.0 || x.y == 1.0;
      EXPECT_EQ(state.inverse_mass[at(n)] == 0.0, rim) << x.x << ", " << x.y;
    }
  }
}

TEST(State, ElementsJoinCornersAtTheSamePlaces) {
  State state = make_split_state(plate());
  insert_all(state);
  const auto interior = granite::edges_of_kind(*state.mesh, EdgeKind::interior);
  ASSERT_EQ(state.cohesive.edge, interior);
  std::vector<int> seen(interior.size(), 0);
  for (const Index code : state.element_on_side) {
    if (code >= 0) seen[at(code / 2)] += code % 2 == 0 ? 1 : 10;
  }
  EXPECT_TRUE(std::all_of(seen.begin(), seen.end(), [](int n) { return n == 11; })) << "once on either face";
  for (const auto& n : state.cohesive.nodes) {
    EXPECT_EQ(state.node_reference(n[0]), state.node_reference(n[2]));
    EXPECT_EQ(state.node_reference(n[1]), state.node_reference(n[3]));
  }
}

// Elements inserted edge by edge, in a scrambled order, until all are there: mass and momentum stay, the
// corners of every node are those that tied edges still join, and in the end every corner is alone.
TEST(State, InsertedEdgesPartNodesIntoTiedFans) {
  State state = make_tied_state(plate());
  set_mass(state, 2500.0);
  for (Index n = 0; n < state.node_count(); ++n) {
    const Vec2 x = state.node_reference(n);
    state.velocity[at(n)] = {1.0 + x.x * x.y, x.x - 0.3 * x.y};
  }
  const auto momentum = [&] {
    Vec2 sum;
    for (Index n = 0; n < state.node_count(); ++n)
      sum += (1.0 / state.inverse_mass[at(n)]) * state.velocity[at(n)];
    return sum;
  };
  const Vec2 before = momentum();
  std::vector<Index> edges = granite::edges_of_kind(*state.mesh, EdgeKind::interior);
  std::shuffle(edges.begin(), edges.end(), std::mt19937(1));
  for (const Index e : edges) {
    const Index nodes = state.node_count();
    Index fresh = 0;
    for (const Parting& p : insert_elements(state, std::array{e}, std::array<std::uint16_t, 1>{})) {
      fresh += static_cast<Index>(p.nodes.size()) - 1;
      for (const Index n : p.nodes) EXPECT_EQ(state.node_reference(n), state.mesh->vertices[at(p.vertex)]);
    }
    EXPECT_EQ(state.node_count(), nodes + fresh);
  }
  EXPECT_EQ(state.cohesive.count(), static_cast<Index>(edges.size()));
  EXPECT_EQ(state.node_count(), 3 * state.mesh->triangle_count());
  for (const Index size : state.node_size) EXPECT_EQ(size, 1);
  for (Index c = 0; c < 3 * state.mesh->triangle_count(); ++c) {
    EXPECT_EQ(state.node_reference(state.node_of_corner[at(c)]), state.reference(c));
  }
  EXPECT_NEAR(total_mass(state), 5000.0, 1e-9);
  EXPECT_LT(norm(momentum() - before), 1e-12 * norm(before));
  for (Index e = 0; e < state.cohesive.count(); ++e) {
    const auto& n = state.cohesive.nodes[at(e)];
    EXPECT_EQ(state.node_reference(n[0]), state.node_reference(n[2]));
    EXPECT_EQ(state.node_reference(n[1]), state.node_reference(n[3]));
    EXPECT_NE(n[0], n[2]);
    EXPECT_NE(n[1], n[3]);
  }
}

// One edge inside the rock frees nothing; a second one at its end opens the vertex between them.
TEST(State, ALoneEdgeFreesNothing) {
  State state = make_tied_state(plate());
  set_mass(state, 2500.0);
  const Mesh& mesh = *state.mesh;
  const auto interior_vertex = [&](Index v) {
    const Vec2 x = mesh.vertices[at(v)];
    return x.x > 0.0 && x.x < 2.0 && x.y > 0.0 && x.y < 1.0;
  };
  for (const Index e : granite::edges_of_kind(mesh, EdgeKind::interior)) {
    const auto [start, middle] = mesh.edges[at(e)].vertex;
    if (!interior_vertex(start) || !interior_vertex(middle)) continue;
    for (const Index f : granite::edges_of_kind(mesh, EdgeKind::interior)) {
      const auto [a, b] = mesh.edges[at(f)].vertex;
      if (f == e || (a != middle && b != middle) || !interior_vertex(a == middle ? b : a)) continue;
      EXPECT_TRUE(insert_elements(state, std::array{e}, std::array<std::uint16_t, 1>{}).empty());
      const auto partings = insert_elements(state, std::array{f}, std::array<std::uint16_t, 1>{});
      ASSERT_EQ(partings.size(), 1u);
      EXPECT_EQ(partings[0].vertex, middle);
      EXPECT_EQ(partings[0].nodes.size(), 2u);
      return;
    }
  }
  FAIL() << "the plate has no such edges";
}

// What moves alike has the same energy at its faces, whether corners share nodes or not.
TEST(State, EnergyAtTheFacesIsThatOfTheirCorners) {
  State split = make_split_state(plate()), tied = make_tied_state(plate());
  insert_all(split);
  std::vector<Index> edges;
  for (Index e = 0; e < tied.mesh->edge_count(); ++e) {
    if (tied.mesh->edges[at(e)].kind == EdgeKind::interior && e % 7 == 0) edges.push_back(e);
  }
  set_mass(tied, 2500.0);
  insert_elements(tied, edges, std::vector<std::uint16_t>(edges.size()));
  set_mass(split, 2500.0);
  for (State* state : {&split, &tied}) {
    for (Index n = 0; n < state->node_count(); ++n) {
      const Vec2 x = state->node_reference(n);
      state->velocity[at(n)] = {0.3 + x.y, x.x * x.y - 0.1};
    }
  }
  double worst = 0.0;
  for (Index i = 0; i < tied.cohesive.count(); ++i) {
    const double expected = face_kinetic_energy(split, split.cohesive.of_edge[at(tied.cohesive.edge[at(i)])]);
    worst = std::max(worst, std::abs(face_kinetic_energy(tied, i) / expected - 1.0));
  }
  // by hand: two triangles of the first element, at one velocity
  for (Vec2& v : split.velocity) v = {3.0, 4.0};
  const Edge& edge = split.mesh->edges[at(split.cohesive.edge[0])];
  double area = 0.0;
  for (const Index t : edge.triangle) {
    const auto& c = split.mesh->triangles[at(t)];
    const Vec2 x0 = split.mesh->vertices[at(c[0])];
    area += 0.5 * cross(split.mesh->vertices[at(c[1])] - x0, split.mesh->vertices[at(c[2])] - x0);
  }
  worst = std::max(worst,
                   std::abs(face_kinetic_energy(split, 0) / (0.5 * 25.0 * 2500.0 * area * 2.0 / 3.0) - 1.0));
  std::printf("energy at the faces: largest error %.1e over %zu elements\n", worst, edges.size());
  EXPECT_LT(worst, 1e-13);
  for (double& w : split.inverse_mass) w = 0.0;
  EXPECT_EQ(face_kinetic_energy(split, 0), 0.0) << "fixed";
}

}  // namespace
}  // namespace crackle
