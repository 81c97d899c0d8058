// SPDX-License-Identifier: GPL-3.0-or-later
// Joints in the mesh: each shape in which they can meet.
#include <gmock/gmock.h>

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

/// Expects edges of each joint to lie on its line and to cover it: nothing had to be moved.
void expect_joints(const Mesh& mesh, const std::vector<Joint>& joints) {
  auto length = joint_lengths(mesh);
  for (std::size_t j = 0; j < joints.size(); ++j) {
    EXPECT_NEAR(length[static_cast<Index>(j)], norm(joints[j].to - joints[j].from), 1e-12) << j;
  }
  for (const Edge& edge : mesh.edges) {
    if (edge.joint < 0) continue;
    const Joint& c = joints.at(edge.joint);
    const Vec2 along = (1.0 / norm(c.to - c.from)) * (c.to - c.from);
    for (const Index v : edge.vertex) EXPECT_NEAR(cross(along, mesh.vertices[v] - c.from), 0.0, 1e-12);
  }
}

/// Number of joint edges at the vertex next to a place, and how far that is from it [m].
std::pair<int, double> joint_edges_at(const Mesh& mesh, Vec2 place) {
  Index nearest = 0;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    if (norm(mesh.vertices[v] - place) < norm(mesh.vertices[nearest] - place)) nearest = v;
  }
  int count = 0;
  for (const Edge& edge : mesh.edges) {
    count += edge.joint >= 0 && (edge.vertex[0] == nearest || edge.vertex[1] == nearest) ? 1 : 0;
  }
  return {count, norm(mesh.vertices[nearest] - place)};
}

class Joints : public testing::TestWithParam<const char*> {
 protected:
  Mesh generate() {
    Mesh mesh = generate_mesh(recipe_, &report_);
    test::expect_sound(mesh);
    EXPECT_EQ(test::euler_number(mesh), 1);
    return mesh;
  }
  MeshRecipe recipe_ = test::small_recipe(GetParam());
  NetworkReport report_;
};

TEST_P(Joints, AJointIsAChainOfEdgesOfTargetLength) {
  recipe_.joints = {{{0.12, 0.1}, {0.4, 0.25}}};
  const Mesh mesh = generate();
  expect_joints(mesh, recipe_.joints);
  EXPECT_GE(measure_quality(mesh, &recipe_).min_angle_deg, 30.0);
  for (const Edge& edge : mesh.edges) {
    if (edge.joint < 0) continue;
    const Vec2 p = mesh.vertices[edge.vertex[0]], q = mesh.vertices[edge.vertex[1]];
    EXPECT_NEAR(norm(q - p) / target_size(recipe_, 0.5 * (p + q)), 1.0, 0.15);
  }
}

TEST_P(Joints, XAreSplitWhereTheyMeet) {
  recipe_.joints = {{{0.1, 0.1}, {0.4, 0.4}}, {{0.1, 0.4}, {0.4, 0.1}}, {{0.1, 0.36}, {0.45, 0.27}}};
  const Mesh mesh = generate();
  expect_joints(mesh, recipe_.joints);
  EXPECT_EQ(joint_edges_at(mesh, {0.25, 0.25}).first, 4);
  EXPECT_LT(joint_edges_at(mesh, {0.25, 0.25}).second, 1e-12);
  EXPECT_EQ(report_.shown, 3);
  EXPECT_EQ(report_.junctions, 3);
  EXPECT_EQ(report_.snapped, 0);
}

TEST_P(Joints, T) {
  recipe_.joints = {{{0.1, 0.2}, {0.4, 0.2}}, {{0.25, 0.2}, {0.25, 0.4}}};
  const Mesh mesh = generate();
  expect_joints(mesh, recipe_.joints);
  EXPECT_EQ(joint_edges_at(mesh, {0.25, 0.2}).first, 3);
}

/// Ends 1 mm before and 1 mm past the other joint, where edges are some 25 mm.
TEST_P(Joints, TThatNearlyTouchesOrJustCrosses) {
  for (const double end : {0.201, 0.199}) {
    recipe_.joints = {{{0.1, 0.2}, {0.4, 0.2}}, {{0.25, end}, {0.25, 0.4}}};
    const Mesh mesh = generate();
    EXPECT_EQ(joint_edges_at(mesh, {0.25, 0.2}).first, 3);
    EXPECT_LT(joint_edges_at(mesh, {0.25, 0.2}).second, 1e-12);
    EXPECT_NEAR(joint_lengths(mesh)[0], 0.3, 1e-12) << "the joint that is touched stays straight";
    EXPECT_NEAR(joint_lengths(mesh)[1], 0.2, 1e-12);
    EXPECT_EQ(report_.snapped, 1);
    EXPECT_NEAR(report_.largest_move, end < 0.2 ? 0.0 : 1e-3, 1e-9);
    EXPECT_GE(measure_quality(mesh, nullptr).min_angle_deg, 25.0);
  }
}

TEST_P(Joints, L) {
  recipe_.joints = {{{0.1, 0.2}, {0.4, 0.2}}, {{0.4, 0.2}, {0.4, 0.4}}};
  expect_joints(generate(), recipe_.joints);
  recipe_.joints[1].from = {0.401, 0.201};  // nearly
  const Mesh mesh = generate();
  EXPECT_EQ(joint_edges_at(mesh, {0.4, 0.2}).first, 2);
  EXPECT_GE(measure_quality(mesh, nullptr).min_angle_deg, 25.0);
}

TEST_P(Joints, FarApartStaysApart) {
  recipe_.joints = {{{0.1, 0.2}, {0.4, 0.2}}, {{0.1, 0.23}, {0.4, 0.23}}};
  expect_joints(generate(), recipe_.joints);
  EXPECT_EQ(report_.snapped, 0);
}

TEST_P(Joints, ParallelNearlyTouching) {
  recipe_.joints = {{{0.1, 0.2}, {0.4, 0.2}}, {{0.1, 0.202}, {0.4, 0.202}}};
  const Mesh mesh = generate();
  std::map<Index, double> length = joint_lengths(mesh);
  EXPECT_NEAR(length[0], 0.3, 1e-12);
  EXPECT_EQ(length[1], 0.0);
  EXPECT_EQ(report_.shown, 1);
  EXPECT_EQ(report_.merged, 1);
}

TEST_P(Joints, ASharpAngleRunsAsOneUntilApart) {
  recipe_.joints = {{{0.1, 0.2}, {0.4, 0.2}}, {{0.1, 0.2}, {0.4, 0.23}}};
  const Mesh mesh = generate();
  const double smallest = measure_quality(mesh, nullptr).min_angle_deg;
  std::printf("%s: two joints at 5.7 degrees: in the mesh at %.1f; smallest angle of triangles %.1f\n",
              GetParam(), report_.smallest_angle_deg, smallest);
  EXPECT_EQ(report_.sharp, 1);
  EXPECT_NEAR(report_.sharpest_deg, 5.7106, 1e-3);
  EXPECT_GE(report_.smallest_angle_deg, 15.0);
  EXPECT_GE(smallest, 15.0);
  EXPECT_GT(joint_lengths(mesh)[1], 0.1);
}

TEST_P(Joints, CrossingAtASharpAngle) {
  recipe_.joints = {{{0.1, 0.2}, {0.4, 0.2}}, {{0.1, 0.19}, {0.4, 0.21}}, {{0.2, 0.1}, {0.24, 0.3}}};
  const Mesh mesh = generate();
  EXPECT_EQ(report_.sharp, 2);
  EXPECT_GE(measure_quality(mesh, nullptr).min_angle_deg, 15.0);
}

TEST_P(Joints, OneTooShortIsLeftOutAndSaid) {
  recipe_.joints = {{{0.3, 0.2}, {0.303, 0.2}}, {{0.1, 0.3}, {0.3, 0.3}}};
  auto length = joint_lengths(generate());
  EXPECT_EQ(length[0], 0.0);
  EXPECT_NEAR(length[1], 0.2, 1e-12);
  EXPECT_EQ(report_.too_short, 1);
  EXPECT_EQ(report_.shown, 1);
}

TEST_P(Joints, ThroughTheWellboreAndToTheBoundary) {
  recipe_.joints = {{{-0.5, -0.1}, {0.5, 0.17}}};
  const Mesh mesh = generate();
  const Mesh rock = excavate(mesh);
  EXPECT_EQ(test::euler_number(rock), 0);
  EXPECT_EQ(joint_lengths(mesh)[0], joint_lengths(rock)[0]) << "none of it in the core";
  EXPECT_NEAR(joint_lengths(rock)[0], norm({1.0, 0.27}) - 0.0735, 0.005);  // less the chord
}

TEST_P(Joints, BeyondTheBoundaryIsCutOff) {
  recipe_.joints = {{{-3.0, 0.2}, {2.0, 0.2}}, {{0.7, 0.0}, {0.7, 0.1}}, {{-0.01, 0.0}, {0.01, 0.0}}};
  const Mesh mesh = generate();
  EXPECT_NEAR(joint_lengths(mesh)[0], 1.0, 1e-12);
  EXPECT_EQ(report_.shown, 1);
  EXPECT_EQ(report_.outside, 2);
  EXPECT_EQ(joint_edges_at(mesh, {0.5, 0.2}).first, 1);
}

TEST_P(Joints, AlongTheBoundaryAndTheWall) {
  recipe_.joints = {{{0.1, 0.49}, {0.4, 0.49}}, {{0.0511, -0.1}, {0.0511, 0.1}}};
  const Mesh mesh = generate();
  EXPECT_EQ(report_.joints, 2);
  EXPECT_GE(measure_quality(mesh, nullptr).min_angle_deg, 15.0);
}

TEST_P(Joints, OverlappingGoToTheLowerNumber) {
  recipe_.joints = {{{0.2, 0.3}, {0.4, 0.3}}, {{0.1, 0.3}, {0.3, 0.3}}};
  auto length = joint_lengths(generate());
  EXPECT_NEAR(length[0], 0.2, 1e-12);
  EXPECT_NEAR(length[1], 0.1, 1e-12);
}

TEST_P(Joints, EdgesKnowTheirSet) {
  recipe_.joint_sets = {"bedding", "fault"};
  recipe_.joints = {{{0.1, 0.3}, {0.3, 0.3}, 1}, {{0.1, -0.3}, {0.3, -0.3}, 0}};
  const Mesh mesh = excavate(generate());
  EXPECT_EQ(mesh.set_of_joint, (std::vector<Index>{1, 0}));
  EXPECT_THAT(mesh.joint_sets, testing::ElementsAre("bedding", "fault"));
  for (const Edge& edge : mesh.edges) {
    if (edge.joint < 0) continue;
    EXPECT_EQ(mesh.set_of_joint[edge.joint], mesh.vertices[edge.vertex[0]].y > 0 ? 1 : 0);
  }
}

/// The ring of edges along the wall's normal, on which fractures start, does not mind joints.
TEST_P(Joints, TheWallKeepsItsCornersAndItsRing) {
  if (std::string(GetParam()) == "gmsh") return;  // has no ring of its own
  const auto rays = [](const Mesh& mesh) {
    std::vector<Vec2> corners;
    int count = 0;
    for (const Edge& edge : mesh.edges) {
      const Vec2 p = mesh.vertices[edge.vertex[0]], q = mesh.vertices[edge.vertex[1]];
      if (edge.kind == EdgeKind::wellbore) corners.push_back(p);
      const bool from_wall = std::abs(norm(p) - 0.05) < 1e-9, to_wall = std::abs(norm(q) - 0.05) < 1e-9;
      if (from_wall == to_wall) continue;
      const Vec2 out = from_wall ? q - p : p - q, normal = from_wall ? p : q;
      count += std::abs(cross(out, normal)) < 0.26 * norm(out) * norm(normal) ? 1 : 0;  // 15 degrees
    }
    std::sort(corners.begin(), corners.end(),
              [](Vec2 p, Vec2 q) { return p.x != q.x ? p.x < q.x : p.y < q.y; });
    return std::pair(corners, count);
  };
  recipe_.size_fine = 0.003;
  const auto [corners, before] = rays(excavate(generate()));
  recipe_.joints = {{{0.054, -0.05}, {0.054, 0.05}},   // passes at 4 mm
                    {{-0.058, -0.01}, {-0.2, -0.02}},  // ends 8 mm off
                    {{-0.0505, 0.03}, {-0.15, 0.1}},   // ends just off
                    {{0.01, 0.01}, {0.1, 0.21}},       // out of the wellbore
                    {{-0.03, -0.2}, {-0.035, 0.2}}};   // through it
  const auto [with, after] = rays(excavate(generate()));
  std::printf("%zu corners, %d edges within 15 degrees of the normal; with joints %zu, %d\n", corners.size(),
              before, with.size(), after);
  EXPECT_EQ(corners, with);
  EXPECT_GE(after, before - 8);
}

INSTANTIATE_TEST_SUITE_P(By, Joints, testing::Values("cgal", "gmsh"),
                         [](const auto& by) { return std::string(by.param); });

}  // namespace
}  // namespace crackle
