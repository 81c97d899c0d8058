// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>

#include <limits>

#include "crackle/mesh/mesh.hpp"
#include "mesh_checks.hpp"

namespace crackle {
namespace {

using testing::HasSubstr;

TEST(Recipe, SizeGrowsLinearlyToTheBoundary) {
  const MeshRecipe recipe = test::small_recipe();
  EXPECT_DOUBLE_EQ(target_size(recipe, {0, 0}), 0.01);
  EXPECT_DOUBLE_EQ(target_size(recipe, {0.06, 0.08}), 0.01);
  EXPECT_DOUBLE_EQ(target_size(recipe, {0, -0.3}), 0.03);
  EXPECT_DOUBLE_EQ(target_size(recipe, {0.5, 0}), 0.05);
  EXPECT_DOUBLE_EQ(target_size(recipe, {0.5, 0.5}), 0.05);
}

TEST(Recipe, EstimateCountsTrianglesOfOneSize) {
  MeshRecipe recipe = test::small_recipe();
  recipe.size_fine = recipe.size_coarse = 0.01;
  recipe.width = 3.0;
  EXPECT_NEAR(estimate_triangles(recipe) / 69282.0, 1.03, 0.01);  // 3 m2 / (sqrt(3)/4 (1 cm)^2)
}

/// Every way to spoil the recipe, and a word that the message has to have.
TEST(Recipe, RefusesNonsense) {
  struct Spoilt {
    const char* word;
    void (*spoil)(MeshRecipe&);
  };
  const std::vector<Spoilt> all{
      {"generator \"triangle\"", [](MeshRecipe& r) { r.generator = "triangle"; }},
      {"width", [](MeshRecipe& r) { r.width = 0.0; }},
      {"height", [](MeshRecipe& r) { r.height = -1.0; }},
      {"width", [](MeshRecipe& r) { r.width = std::numeric_limits<double>::quiet_NaN(); }},
      {"size_fine", [](MeshRecipe& r) { r.size_fine = 0.0; }},
      {"size_fine", [](MeshRecipe& r) { r.size_fine = 0.1; }},
      {"half the domain", [](MeshRecipe& r) { r.size_fine = r.size_coarse = 0.6; }},
      {"size_coarse", [](MeshRecipe& r) { r.size_coarse = std::numeric_limits<double>::infinity(); }},
      {"fine_radius", [](MeshRecipe& r) { r.fine_radius = -0.1; }},
      {"grows", [](MeshRecipe& r) { r.fine_radius = 0.45; }},
      {"diameter", [](MeshRecipe& r) { r.wellbore_diameter = -0.1; }},
      {"does not fit", [](MeshRecipe& r) { r.wellbore_diameter = 1.0; }},
      {"polygon", [](MeshRecipe& r) { r.wellbore_segments = 2; }},
      {"no length",
       [](MeshRecipe& r) {
         r.joints = {{{0.2, 0.2}, {0.2, 0.2}}};
       }},
      {"no place",
       [](MeshRecipe& r) {
         r.joints = {{{0.2, 0.2}, {0.2, std::numeric_limits<double>::quiet_NaN()}}};
       }},
      {"of set 3, but there are 2 sets",
       [](MeshRecipe& r) {
         r.joints = {{{0.2, 0.2}, {0.3, 0.2}, 3}};
         r.joint_sets = {"a", "b"};
       }},
      {"million", [](MeshRecipe& r) { r.size_fine = r.size_coarse = 1e-4; }},
  };
  for (const Spoilt& spoilt : all) {
    MeshRecipe recipe = test::small_recipe();
    spoilt.spoil(recipe);
    EXPECT_THAT(test::mesh_error([&] { generate_mesh(recipe); }), HasSubstr(spoilt.word));
  }
}

}  // namespace
}  // namespace crackle
