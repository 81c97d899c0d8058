// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>

#include "crackle/core/errors.hpp"
#include "crackle/mesh/mesh.hpp"
#include "mesh_checks.hpp"

namespace crackle {
namespace {

/// Area of a regular polygon of n corners on a circle over the area of the circle.
double polygon_share(int n) { return n / (2.0 * std::numbers::pi) * std::sin(2.0 * std::numbers::pi / n); }

/// Expects the wall to be one closed loop of n equal edges, with its corners on the circle.
void expect_wall(const Mesh& rock, double diameter, int n) {
  std::map<Index, Index> next;  // along the wall, the rock on the left
  for (const Edge& edge : rock.edges) {
    if (edge.kind != EdgeKind::wellbore) continue;
    EXPECT_TRUE(next.emplace(edge.vertex[0], edge.vertex[1]).second);
    const Vec2 p = rock.vertices[edge.vertex[0]], q = rock.vertices[edge.vertex[1]];
    EXPECT_NEAR(norm(p), 0.5 * diameter, 1e-15);
    EXPECT_NEAR(norm(q - p), diameter * std::sin(std::numbers::pi / n), 1e-14);
    EXPECT_LT(cross(p, q), 0.0) << "rock is on the left, so the wall runs clockwise";
  }
  ASSERT_EQ(static_cast<int>(next.size()), n);
  Index v = next.begin()->first;
  for (int k = 0; k < n; ++k) {
    ASSERT_TRUE(next.contains(v));
    v = next.at(v);
    EXPECT_EQ(v == next.begin()->first, k == n - 1);
  }
}

class Excavate : public testing::TestWithParam<const char*> {};

TEST_P(Excavate, LeavesAClosedWall) {
  for (const int segments : {0, 12, 31, 60}) {
    MeshRecipe recipe = test::small_recipe(GetParam());
    recipe.wellbore_segments = segments;
    const Mesh rock = excavate(generate_mesh(recipe));
    test::expect_sound(rock);
    EXPECT_EQ(test::euler_number(rock), 0);
    const int n = segments > 0 ? segments : 31;  // round(pi 0.1 / 0.01)
    expect_wall(rock, 0.1, n);
    const double circle = std::numbers::pi * 0.05 * 0.05;
    EXPECT_NEAR(1.0 - test::area(rock), circle * polygon_share(n), 1e-12);
    EXPECT_GE(measure_quality(rock, nullptr).min_angle_deg, 24.0) << segments << " segments";
  }
}

INSTANTIATE_TEST_SUITE_P(By, Excavate, testing::Values("cgal", "gmsh"),
                         [](const auto& by) { return std::string(by.param); });

TEST(Excavation, PaperWellboreHas105Edges) {
  MeshRecipe recipe = test::small_recipe();
  recipe.size_fine = 0.003;
  expect_wall(excavate(generate_mesh(recipe)), 0.1, 105);
}

TEST(Excavation, AtLeastEightEdges) {
  MeshRecipe recipe = test::small_recipe();
  recipe.size_fine = recipe.size_coarse = 0.05;
  expect_wall(excavate(generate_mesh(recipe)), 0.1, 8);
}

TEST(Excavation, KeepsJointsAndOrder) {
  Mesh mesh = structured_rectangle({-1.5, -1.5}, {1.5, 1.5}, 3, 3, MeshPattern::right);
  mesh.regions[8] = mesh.regions[9] = Region::wellbore_core;  // the cell in the middle
  const Index outside = mesh.triangle_edges[0][2], inside = mesh.triangle_edges[8][2];
  mesh.edges[outside].joint = 7;
  mesh.edges[inside].joint = 8;
  const Mesh rock = excavate(mesh);
  test::expect_sound(rock);
  EXPECT_EQ(rock.triangle_count(), 16);
  int walls = 0, joints = 0;
  for (const Edge& edge : rock.edges) {
    walls += edge.kind == EdgeKind::wellbore ? 1 : 0;
    if (edge.joint < 0) continue;
    ++joints;
    EXPECT_EQ(edge.joint, 7);
    EXPECT_EQ(edge.triangle, mesh.edges[outside].triangle);
  }
  EXPECT_EQ(walls, 4);
  EXPECT_EQ(joints, 1);
  const Mesh again = excavate(rock);  // nothing left to do: the wall stays a wall
  EXPECT_EQ(test::checksum(again), test::checksum(rock));
  for (Index e = 0; e < rock.edge_count(); ++e) EXPECT_EQ(again.edges[e].kind, rock.edges[e].kind);
}

TEST(Excavation, RefusesAMeshOfCoreOnly) {
  Mesh mesh = structured_rectangle({0, 0}, {1, 1}, 1, 1, MeshPattern::right);
  mesh.regions.assign(2, Region::wellbore_core);
  EXPECT_THROW(excavate(mesh), MeshError);
}

}  // namespace
}  // namespace crackle
