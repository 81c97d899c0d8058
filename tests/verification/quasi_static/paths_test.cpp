// SPDX-License-Identifier: GPL-3.0-or-later
//
// Paths that nobody lays down: free growth, kinks, two unequal wings, a joint on the way; toughness vertex,
// so that lengths and pressures are known.
#include "paths.hpp"

#include <gtest/gtest.h>

#include <ctime>

#include "../../acceptance.hpp"

namespace crackle {
namespace {

using namespace paths;

// The well is not in the middle of the notch: both tips still carry the same stress intensity.
TEST(Paths, UnequalWings) {
  QuasiStaticScene s = wide(10.0, 0.25, {-18.3e6, -9.44e6, 0.0});
  s.wings = {free_wing(s, {-2.0, 0.0}, {3.0, 0.0}), free_wing(s, {-2.0, 0.0}, {-3.0, 0.0})};
  QuasiStatic stage(s);
  wing::Errors pressure, length;
  QuasiStaticRow last;
  stage.run(20.0, [&](const QuasiStaticRow& row) {
    last = row;
    if (row.time < 8.0) return;
    const Vertex exact = vertex_of(row.fracture_volume);
    pressure.add(row.step, row.fracture_pressure - pore - 9.44e6, exact.pressure);
    length.add(row.step, 0.5 * row.elastic_length, exact.half_length);
  });
  double low = 0.0, high = 0.0, off = 0.0;
  const std::vector<FractureCell> cells = stage.cells();
  for (std::size_t c = 0; c < cells.size(); ++c) {
    if (cells[c].damage[0] < 0.5) continue;
    const Vec2 p = middle(stage, stage.path().edges()[c]);
    low = std::min(low, p.x);
    high = std::max(high, p.x);
    off = std::max(off, std::abs(p.y));
  }
  std::printf("unequal wings: x from %.2f to %.2f m, off the line by %.2f m; energy residual %.1e\n", low,
              high, off, last.energies.residual);
  accept(19, "free path, unequal wings of 5 and 1 m: pressure, length against the toughness vertex", "3, 5 %",
         text("%+.2f, %+.2f %%", pressure.mean(), length.mean()),
         std::abs(pressure.mean()) <= 3.0 && std::abs(length.mean()) <= 5.0);
  EXPECT_EQ(off, 0.0);
  EXPECT_LT(std::abs(pressure.mean()), 3.0);
  EXPECT_LT(std::abs(length.mean()), 5.0);
  EXPECT_LT(std::abs(last.mass_defect), 1e-8 * last.injected);
  EXPECT_NEAR(high + low, 0.0, 1.0) << "about the middle of the notch";
}

// A mesh without any line to follow, under twice the stress along as across: edges at 30 degrees to the path
// would be pressed together if they stood for themselves.
TEST(Paths, RandomMesh) {
  MeshRecipe recipe;
  recipe.width = recipe.height = 160.0;
  recipe.size_fine = 0.25;
  recipe.fine_radius = 8.0;
  recipe.size_coarse = 16.0;
  recipe.joints = {{{-1.0, 0.0}, {1.0, 0.0}}};
  recipe.joint_sets = {"notch"};
  QuasiStaticScene s = scene_on(std::make_shared<const Mesh>(generate_mesh(recipe)), {-18.3e6, -9.44e6, 0.0});
  s.held.assign(s.mesh->vertices.size(), 0);
  for (const Edge& e : s.mesh->edges) {
    if (e.triangle[1] < 0) s.held[at(e.vertex[0])] = s.held[at(e.vertex[1])] = 3;
  }
  Vec2 well{1.0, 0.0};
  for (const Vec2 v : s.mesh->vertices) {
    if (v.y == 0.0 && std::abs(v.x) < std::abs(well.x)) well = v;
  }
  s.wings = {free_wing(s, well, {1.0, 0.0}), free_wing(s, well, {-1.0, 0.0})};
  QuasiStatic stage(s);
  wing::Errors pressure, length;
  QuasiStaticRow last;
  double off = 0.0;
  stage.run(20.0, [&](const QuasiStaticRow& row) {
    last = row;
    if (row.time < 8.0) return;
    const Vertex exact = vertex_of(row.fracture_volume);
    pressure.add(row.step, row.fracture_pressure - pore - 9.44e6, exact.pressure);
    length.add(row.step, 0.5 * row.elastic_length, exact.half_length);
  });
  for (const PathEdge& e : stage.path().edges()) off = std::max(off, std::abs(middle(stage, e).y));
  std::printf("random mesh: off the line by %.2f m; energy residual %.1e\n", off, last.energies.residual);
  accept(23, "free path on a mesh without lines, stress 18.3 along, 9.44 MPa across: pressure, length",
         "3, 5 %", text("%+.2f, %+.2f %%", pressure.mean(), length.mean()),
         std::abs(pressure.mean()) <= 3.0 && std::abs(length.mean()) <= 5.0);
  EXPECT_LT(off, 0.5) << "two edges";
  EXPECT_LT(std::abs(pressure.mean()), 3.0);
  EXPECT_LT(std::abs(length.mean()), 5.0);
  EXPECT_LT(std::abs(last.mass_defect), 1e-8 * last.injected);
}

// A notch at 45 degrees turns across the least compression.
TEST(Paths, Kink) {
  QuasiStaticScene s = square(20.0, 0.5, {-10.5e6, -9.44e6, 0.0});
  s.wings = {free_wing(s, {0.0, 0.0}, {1.0, 1.0}), free_wing(s, {0.0, 0.0}, {-1.0, -1.0})};
  QuasiStatic stage(s);
  QuasiStaticRow last;
  double residual = 0.0;
  stage.run(10.0, [&](const QuasiStaticRow& row) {
    last = row;
    residual = std::max(residual, row.energies.residual);
  });
  const std::vector<FractureCell> cells = stage.cells();
  Vec2 left{0, 0}, right{0, 0};
  for (std::size_t c = 0; c < cells.size(); ++c) {
    if (cells[c].damage[0] < 0.5) continue;
    const Vec2 p = middle(stage, stage.path().edges()[c]);
    if (p.x < left.x) left = p;
    if (p.x > right.x) right = p;
  }
  const double turn = 180.0 / M_PI * std::atan2(right.y - 1.0, right.x - 1.0);
  const Vertex exact = vertex_of(last.fracture_volume);
  const double p = 100.0 * ((last.fracture_pressure - pore - 9.44e6) / exact.pressure - 1.0);
  std::printf(
      "kink: tips at (%.2f, %.2f) and (%.2f, %.2f); straight fracture of that volume: half-length %.2f m; "
      "energy residual %.1e at most\n",
      left.x, left.y, right.x, right.y, exact.half_length, residual);
  accept(
      20,
      "notch at 45 degrees, free path: direction from the notch's end; pressure against a straight fracture",
      "0 to 15 degrees; printed", text("%.1f degrees; %+.1f %%", turn, p), turn >= 0.0 && turn <= 15.0);
  EXPECT_GE(turn, 0.0);
  EXPECT_LE(turn, 15.0);
  EXPECT_GT(right.x - left.x, 6.0);
  EXPECT_NEAR(left.x + right.x, 0.0, 1.01);
  EXPECT_GT(last.energies.friction, 0.0);
  EXPECT_LT(residual, 1e-3) << "with the slip of closed faces";
  EXPECT_LT(std::abs(last.mass_defect), 1e-8 * last.injected);
}

struct Met {
  double beyond = 0.0, slip = 0.0, pressure = 0.0, in_joint = 0.0;
};
// A joint across the way at x = 2 m, 8 m long.
Met meet_joint(double along, double friction) {
  QuasiStaticScene s = square(16.0, 0.5, {along, -9.44e6, 0.0});
  for (const Index edge : edges_along(*s.mesh, {2.0, -4.0}, {2.0, 4.0})) s.joints.push_back({edge, 1, false});
  std::ranges::sort(s.joints, {}, &JointEdge::edge);
  s.joint_materials = {s.cohesive};
  s.joint_materials[0].tan_residual = friction;
  s.wings = {free_wing(s, {0.0, 0.0}, {1.0, 0.0}), free_wing(s, {0.0, 0.0}, {-1.0, 0.0})};
  QuasiStatic stage(s);
  QuasiStaticRow last;
  stage.run(12.0, [&](const QuasiStaticRow& row) { last = row; });
  Met met;
  const std::vector<FractureCell> cells = stage.cells();
  for (std::size_t c = 0; c < cells.size(); ++c) {
    const PathEdge& e = stage.path().edges()[c];
    if (e.parent == -2) {
      met.slip = std::max(met.slip, std::abs(stage.state().cells[c].points[0].plastic_slip));
      met.in_joint = std::max(met.in_joint, cells[c].pressure - pore);
    } else if (cells[c].damage[0] >= 0.5) {
      met.beyond = std::max(met.beyond, middle(stage, e).x - 2.0);
    }
  }
  met.pressure = last.fracture_pressure - pore - 9.44e6;
  std::printf(
      "joint, friction %.2f, %.1f MPa along: fracture %.2f m beyond, slip %.1f um, net pressure %.3f MPa, in "
      "the joint %.2f MPa above pore\n",
      friction, along * 1e-6, met.beyond, 1e6 * met.slip, 1e-6 * met.pressure, 1e-6 * met.in_joint);
  EXPECT_LT(std::abs(last.mass_defect), 1e-8 * last.injected);
  return met;
}

TEST(Paths, MeetsAJoint) {
  const Met crosses = meet_joint(-18.3e6, 0.9), stops = meet_joint(-9.6e6, 0.02);
  accept(21, "joint across the way: length beyond it, rough under high stress along; smooth under low",
         "crosses; stops", text("%.2f m; %.2f m", crosses.beyond, stops.beyond),
         crosses.beyond > 0.5 && stops.beyond < 0.5);
  EXPECT_GT(crosses.beyond, 0.5);
  EXPECT_LT(stops.beyond, 0.5);
  EXPECT_GT(stops.slip, crosses.slip);
  EXPECT_GT(crosses.in_joint, 0.0);
}

}  // namespace
}  // namespace crackle
