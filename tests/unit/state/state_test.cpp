// SPDX-License-Identifier: GPL-3.0-or-later
//
// Nodes, masses and elements of the two kinds of state.
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

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
    if (code < 2 * state.cohesive.count()) seen[at(code / 2)] += code % 2 == 0 ? 1 : 10;
  }
  EXPECT_TRUE(std::all_of(seen.begin(), seen.end(), [](int n) { return n == 11; })) << "once on either face";
  for (const auto& n : state.cohesive.nodes) {
    EXPECT_EQ(state.node_reference(n[0]), state.node_reference(n[2]));
    EXPECT_EQ(state.node_reference(n[1]), state.node_reference(n[3]));
  }
}

}  // namespace
}  // namespace crackle
