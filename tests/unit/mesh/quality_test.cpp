// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "crackle/mesh/mesh.hpp"
#include "mesh_checks.hpp"

namespace crackle {
namespace {

using testing::HasSubstr;

TEST(Quality, OfATriangleOfKnownAngles) {
  Mesh mesh;  // 30, 60 and 90 degrees
  mesh.vertices = {{0, 0}, {std::sqrt(3.0), 0}, {0, 1}};
  mesh.triangles = {{0, 1, 2}};
  build_edges(mesh);
  const MeshQuality quality = measure_quality(mesh, nullptr);
  EXPECT_NEAR(quality.min_angle_deg, 30.0, 1e-12);
  EXPECT_EQ(quality.min_angle_triangle, 0);
  EXPECT_NEAR(quality.min_edge, 1.0, 1e-15);
  EXPECT_NEAR(quality.max_edge, 2.0, 1e-15);
  EXPECT_EQ(quality.mean_size_ratio, 0.0);
}

TEST(Quality, ComparesWithTheRecipe) {
  MeshRecipe recipe;
  recipe.width = recipe.height = 10.0;
  recipe.size_fine = recipe.size_coarse = 2.0;
  const Mesh mesh = structured_rectangle({-5, -5}, {5, 5}, 10, 10, MeshPattern::right);
  const MeshQuality quality = measure_quality(mesh, &recipe);
  // 110 edges of length 1 each way and 100 diagonals
  EXPECT_NEAR(quality.mean_size_ratio, 0.5 * (220 + 100 * std::numbers::sqrt2) / 320, 1e-12);
  EXPECT_NEAR(quality.max_size_ratio, 0.5 * std::numbers::sqrt2, 1e-12);
}

TEST(Quality, TheGateNamesTheCulprit) {
  const Mesh mesh = structured_rectangle({-5, -5}, {5, 5}, 10, 10, MeshPattern::right);
  const MeshQuality quality = measure_quality(mesh, nullptr);
  require_quality(mesh, quality, 44.0);
  const std::string sharp = test::mesh_error([&] { require_quality(mesh, quality, 46.0); });
  EXPECT_THAT(sharp, HasSubstr("triangle " + std::to_string(quality.min_angle_triangle)));
  EXPECT_THAT(sharp, HasSubstr("45 degrees"));

  MeshRecipe recipe;
  recipe.width = recipe.height = 10.0;
  recipe.size_fine = recipe.size_coarse = 0.4;
  const MeshQuality coarse = measure_quality(mesh, &recipe);
  EXPECT_THAT(test::mesh_error([&] { require_quality(mesh, coarse, 20.0); }),
              HasSubstr("3.54 times its target"));
}

}  // namespace
}  // namespace crackle
