// SPDX-License-Identifier: GPL-3.0-or-later
// What both generators owe to every recipe.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>

#include "crackle/mesh/mesh.hpp"
#include "mesh_checks.hpp"

namespace crackle {
namespace {

using test::small_recipe;

class Generate : public testing::TestWithParam<const char*> {
 protected:
  MeshRecipe recipe_ = small_recipe(GetParam());
};

TEST_P(Generate, MakesASoundMesh) {
  const Mesh mesh = generate_mesh(recipe_);
  test::expect_sound(mesh);
  EXPECT_EQ(test::euler_number(mesh), 1);
  EXPECT_NEAR(test::area(mesh), 1.0, 1e-12);
  for (const Edge& edge : mesh.edges) EXPECT_NE(edge.kind, EdgeKind::wellbore);
}

TEST_P(Generate, MeetsSizesAndAngles) {
  for (const double fine : {0.01, 0.004}) {
    recipe_.size_fine = fine;
    const Mesh mesh = generate_mesh(recipe_);
    const MeshQuality quality = measure_quality(mesh, &recipe_);
    EXPECT_GE(quality.min_angle_deg, 30.0);
    EXPECT_NEAR(quality.mean_size_ratio, 1.0, 0.05);
    EXPECT_LE(quality.max_size_ratio, 1.6);
    EXPECT_GE(quality.min_edge, 0.5 * fine);
    require_quality(mesh, quality, 20.0);

    double sum = 0.0;
    int count = 0;
    for (const Edge& edge : mesh.edges) {
      const Vec2 p = mesh.vertices[edge.vertex[0]], q = mesh.vertices[edge.vertex[1]];
      if (norm(0.5 * (p + q)) > recipe_.fine_radius) continue;
      sum += norm(q - p) / fine;
      ++count;
    }
    EXPECT_NEAR(sum / count, 1.0, 0.1) << "near the well";
    EXPECT_NEAR(estimate_triangles(recipe_) / mesh.triangle_count(), 1.0, 0.1);
  }
}

TEST_P(Generate, SameSeedSameMesh) {
  const Mesh once = generate_mesh(recipe_), again = generate_mesh(recipe_);
  std::printf("%s: %d triangles, checksum %016llx\n", GetParam(), once.triangle_count(),
              static_cast<unsigned long long>(test::checksum(once)));
  EXPECT_EQ(test::checksum(once), test::checksum(again));
  EXPECT_EQ(once.edge_count(), again.edge_count());
}

TEST_P(Generate, AnotherSeedAnotherMesh) {
  const Mesh one = generate_mesh(recipe_);
  recipe_.seed = 2;
  const Mesh two = generate_mesh(recipe_);
  EXPECT_NE(test::checksum(one), test::checksum(two));
  EXPECT_NEAR(one.triangle_count(), two.triangle_count(), 0.05 * one.triangle_count());
  EXPECT_GE(measure_quality(two, nullptr).min_angle_deg, 30.0);
  // Not the same mesh a little shifted: hardly a point of one lies near a point of the other.
  int near = 0;
  for (const Vec2 p : one.vertices) {
    double closest = 1.0;
    for (const Vec2 q : two.vertices) closest = std::min(closest, norm(q - p));
    if (closest < 0.05 * target_size(recipe_, p)) ++near;
  }
  EXPECT_LT(near, one.vertex_count() / 4);
}

TEST_P(Generate, WithoutAWellbore) {
  recipe_.wellbore_diameter = 0.0;
  const Mesh mesh = generate_mesh(recipe_);
  test::expect_sound(mesh);
  for (const Region region : mesh.regions) EXPECT_EQ(region, Region::rock);
  EXPECT_GE(measure_quality(mesh, &recipe_).min_angle_deg, 30.0);
}

TEST_P(Generate, OfOneSizeInAWideDomain) {
  recipe_.width = 2.0;
  recipe_.height = 0.5;
  recipe_.fine_radius = 0.25;
  recipe_.size_fine = recipe_.size_coarse = 0.02;
  const Mesh mesh = generate_mesh(recipe_);
  test::expect_sound(mesh);
  EXPECT_NEAR(test::area(mesh), 1.0, 1e-12);
  const MeshQuality quality = measure_quality(mesh, &recipe_);
  EXPECT_GE(quality.min_angle_deg, 30.0);
  EXPECT_NEAR(quality.mean_size_ratio, 1.0, 0.05);
}

/// Directions of edges must show no preference: on a lattice, cos(6 angle) has a mean far from 0.
TEST_P(Generate, IsNoLattice) {
  recipe_.wellbore_diameter = 0.0;
  recipe_.size_fine = recipe_.size_coarse = 0.02;
  const Mesh mesh = generate_mesh(recipe_);
  double c = 0.0, s = 0.0;
  for (const Edge& edge : mesh.edges) {
    const Vec2 d = mesh.vertices[edge.vertex[1]] - mesh.vertices[edge.vertex[0]];
    c += std::cos(6.0 * std::atan2(d.y, d.x));
    s += std::sin(6.0 * std::atan2(d.y, d.x));
  }
  std::printf("%s: order of edge directions %.3f\n", GetParam(), std::hypot(c, s) / mesh.edge_count());
  EXPECT_LT(std::hypot(c, s) / mesh.edge_count(), 0.2);
}

INSTANTIATE_TEST_SUITE_P(By, Generate, testing::Values("cgal", "gmsh"),
                         [](const auto& by) { return std::string(by.param); });

/// The same mesh on every CPU and with every compiler setting. A change of this number is a change
/// of every published mesh: say so in CHANGELOG.md. (CGAL 5.5.1, as in Debian 12.)
TEST(GenerateSmall, IsTheMeshItWas) {
  EXPECT_EQ(test::checksum(generate_mesh(small_recipe())), 0xf9841f6f606c8ea3u);
}

TEST(GenerateSmall, EdgesMeetTheWallAtEveryAngle) {
  // A fracture starts across the wall: a fair mesh must offer it edges along the wall's normal.
  for (const char* generator : {"cgal", "gmsh"}) {
    const Mesh rock = excavate(generate_mesh(small_recipe(generator)));
    std::vector<bool> on_wall(rock.vertices.size(), false);
    for (const Edge& e : rock.edges) {
      if (e.kind == EdgeKind::wellbore) on_wall[e.vertex[0]] = on_wall[e.vertex[1]] = true;
    }
    int all = 0, straight = 0;
    for (const Edge& e : rock.edges) {
      if (on_wall[e.vertex[0]] == on_wall[e.vertex[1]]) continue;
      const Vec2 along = rock.vertices[e.vertex[1]] - rock.vertices[e.vertex[0]];
      const Vec2 out = rock.vertices[e.vertex[0]] + rock.vertices[e.vertex[1]];
      ++all;
      straight += std::abs(cross(along, out)) < std::sin(0.35) * norm(along) * norm(out);
    }
    std::printf("%s: %d of %d edges within 20 degrees of the wall's normal\n", generator, straight, all);
    EXPECT_GE(straight, all / 10);
  }
}

/// The mesh of the paper's case.
TEST(GeneratePaper, Mesh) {
  MeshRecipe recipe;
  recipe.width = recipe.height = 8.0;
  recipe.wellbore_diameter = 0.1;
  recipe.size_fine = 0.003;
  recipe.fine_radius = 0.3;
  recipe.size_coarse = 0.3;
  const Mesh mesh = generate_mesh(recipe);
  const MeshQuality quality = measure_quality(mesh, &recipe);
  std::printf("%d triangles, smallest angle %.2f degrees, edges %.4g to %.4g of target, shortest %.4g m\n",
              mesh.triangle_count(), quality.min_angle_deg, quality.mean_size_ratio, quality.max_size_ratio,
              quality.min_edge);
  EXPECT_NEAR(mesh.triangle_count(), 101500, 1500);
  EXPECT_GE(quality.min_angle_deg, 31.0);
  EXPECT_GE(quality.min_edge, 0.0015);
  EXPECT_NEAR(quality.mean_size_ratio, 1.0, 0.02);
  EXPECT_LE(quality.max_size_ratio, 1.6);
}

}  // namespace
}  // namespace crackle
