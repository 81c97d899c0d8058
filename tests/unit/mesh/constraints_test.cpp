// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cstdio>
#include <map>

#include "crackle/mesh/mesh.hpp"
#include "mesh_checks.hpp"

namespace crackle {
namespace {

/// Length of mesh edges that belong to each joint [m].
std::map<Index, double> joint_lengths(const Mesh& mesh) {
  std::map<Index, double> length;
  for (const Edge& edge : mesh.edges) {
    if (edge.joint >= 0)
      length[edge.joint] += norm(mesh.vertices[edge.vertex[1]] - mesh.vertices[edge.vertex[0]]);
  }
  return length;
}

/// Expects edges of each joint to lie on its segment and to cover it.
void expect_joints(const Mesh& mesh, const std::vector<Constraint>& constraints) {
  auto length = joint_lengths(mesh);
  for (const Constraint& c : constraints) EXPECT_NEAR(length[c.joint], norm(c.to - c.from), 1e-12) << c.joint;
  for (const Edge& edge : mesh.edges) {
    if (edge.joint < 0) continue;
    const Constraint& c = constraints.at(edge.joint);
    const Vec2 along = (1.0 / norm(c.to - c.from)) * (c.to - c.from);
    for (const Index v : edge.vertex) EXPECT_NEAR(cross(along, mesh.vertices[v] - c.from), 0.0, 1e-12);
  }
}

class Constraints : public testing::TestWithParam<const char*> {
 protected:
  MeshRecipe recipe_ = test::small_recipe(GetParam());
};

TEST_P(Constraints, AJointIsAChainOfEdgesOfTargetLength) {
  recipe_.constraints = {{{0.12, 0.1}, {0.4, 0.25}, 0}};
  const Mesh mesh = generate_mesh(recipe_);
  test::expect_sound(mesh);
  expect_joints(mesh, recipe_.constraints);
  EXPECT_GE(measure_quality(mesh, &recipe_).min_angle_deg, 30.0);
  for (const Edge& edge : mesh.edges) {
    if (edge.joint < 0) continue;
    const Vec2 p = mesh.vertices[edge.vertex[0]], q = mesh.vertices[edge.vertex[1]];
    EXPECT_NEAR(norm(q - p) / target_size(recipe_, 0.5 * (p + q)), 1.0, 0.15);
  }
}

TEST_P(Constraints, CrossingJointsAreSplitWhereTheyMeet) {
  recipe_.constraints = {
      {{0.1, 0.1}, {0.4, 0.4}, 0}, {{0.1, 0.4}, {0.4, 0.1}, 1}, {{0.1, 0.3}, {0.45, 0.21}, 2}};
  const Mesh mesh = generate_mesh(recipe_);
  test::expect_sound(mesh);
  EXPECT_EQ(test::euler_number(mesh), 1);
  expect_joints(mesh, recipe_.constraints);
  bool crossing = false;
  for (const Vec2 p : mesh.vertices) crossing = crossing || norm(p - Vec2{0.25, 0.25}) < 1e-12;
  EXPECT_TRUE(crossing);
}

TEST_P(Constraints, ThroughTheWellboreAndToTheBoundary) {
  recipe_.constraints = {{{-0.5, -0.1}, {0.5, 0.17}, 0}};
  const Mesh mesh = generate_mesh(recipe_);
  test::expect_sound(mesh);
  expect_joints(mesh, recipe_.constraints);
  const Mesh rock = excavate(mesh);
  EXPECT_EQ(test::euler_number(rock), 0);
  const double drilled = joint_lengths(mesh)[0] - joint_lengths(rock)[0];
  EXPECT_NEAR(drilled, 0.0735, 0.002);  // the chord
}

TEST_P(Constraints, OverlappingJointsGoToTheLowerNumber) {
  recipe_.constraints = {{{0.1, 0.3}, {0.3, 0.3}, 1}, {{0.2, 0.3}, {0.4, 0.3}, 0}};
  auto length = joint_lengths(generate_mesh(recipe_));
  EXPECT_NEAR(length[0], 0.2, 1e-12);
  EXPECT_NEAR(length[1], 0.1, 1e-12);
}

TEST_P(Constraints, AConstraintWithoutAJointIsIntactRock) {
  recipe_.constraints = {{{0.1, 0.3}, {0.3, 0.3}, -1}};
  EXPECT_TRUE(joint_lengths(generate_mesh(recipe_)).empty());
}

/// A network as a later version will make it: many joints, sharp crossings.
TEST_P(Constraints, ANetworkOfCrossingJoints) {
  for (Index joint = 0; joint < 60; ++joint) {  // a fixed scatter of directions and places
    const double a = 0.7548776662 * joint, b = 0.5698402910 * joint, c = 0.4301597090 * joint;
    const Vec2 middle{0.7 * (a - static_cast<int>(a)) - 0.35, 0.7 * (b - static_cast<int>(b)) - 0.35};
    const Vec2 half{0.1 * (c - static_cast<int>(c)) - 0.05, 0.1};
    recipe_.constraints.push_back({middle - half, middle + half, joint});
  }
  const Mesh mesh = generate_mesh(recipe_);
  test::expect_sound(mesh);
  EXPECT_EQ(test::euler_number(mesh), 1);
  expect_joints(mesh, recipe_.constraints);
  std::printf("%s: %d triangles, smallest angle %.2f degrees\n", GetParam(), mesh.triangle_count(),
              measure_quality(mesh, nullptr).min_angle_deg);
}

INSTANTIATE_TEST_SUITE_P(By, Constraints, testing::Values("cgal", "gmsh"),
                         [](const auto& by) { return std::string(by.param); });

}  // namespace
}  // namespace crackle
