// SPDX-License-Identifier: GPL-3.0-or-later
#include "crackle/solve/estimates.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace crackle {
namespace {

constexpr double pascal = 1.0;
const PlaneStiffness granite = isotropic_plane_strain(35e9, 0.27);

TEST(Estimates, PlaneStrainModulus) {
  EXPECT_NEAR(plane_strain_modulus(granite), 35e9 / (1.0 - 0.27 * 0.27), 10.0 * pascal);
}

// validation.md B4: paper granite, Chen's block.
TEST(Estimates, CohesiveZoneAndToughness) {
  EXPECT_NEAR(cohesive_zone(plane_strain_modulus(granite), 5.0, 3e6), 18.53e-3, 0.01e-3);
  EXPECT_NEAR(cohesive_zone(plane_strain_modulus(granite), 80.0, 24e6), 4.63e-3, 0.01e-3);
  EXPECT_NEAR(toughness(plane_strain_modulus(granite), 5.0), 0.43447e6, 10.0);
}

// validation.md A2: wall stress of the paper's anisotropic scene at 11.47 MPa.
TEST(Estimates, WallHoopStress) {
  const PrincipalStress hoop = wall_hoop_stress({-7.05e6, -4.9e6, 0.0}, 11.47e6);
  EXPECT_NEAR(hoop.largest, 3.820e6, 1.0);
  EXPECT_NEAR(hoop.smallest, -4.780e6, 1.0);
}

TEST(Estimates, HubbertWillis) {
  EXPECT_NEAR(hubbert_willis_pressure({-7.05e6, -4.9e6, 0.0}, 3e6), 10.65e6, 1.0);
  EXPECT_NEAR(hubbert_willis_pressure({-4.85e6, -4.85e6, 0.0}, 3e6), 12.70e6, 1.0);
  // the same stress in axes turned by 45 degrees
  EXPECT_NEAR(hubbert_willis_pressure({-5.975e6, -5.975e6, 1.075e6}, 3e6), 10.65e6, 1.0);
}

// validation.md D1: p = K_f [ln(1 + Q t / V0) - ln(1 + p / G)] in rock without stress.
TEST(Estimates, FilledHole) {
  const double area = std::numbers::pi * 0.05 * 0.05;
  const FilledHole hole{area, granite.c66, 0.0, {2.2e9, 1000.0, 0.0}, 0.0};
  const double injected = 0.065 * 0.5e-3;
  const double p = hole.pressure(injected);
  EXPECT_NEAR(p, 2.2e9 * (std::log1p(injected / area) - std::log1p(p / granite.c66)), 1.0);
  EXPECT_NEAR(hole.injected(p), injected, 1e-12 * injected);
  EXPECT_NEAR(hole.pressure(0.0), 0.0, 1e-9);
}

// In stressed rock the hole has its first area again at p = -(mean stress).
TEST(Estimates, FilledHoleUnderStress) {
  const double area = 0.01;
  const FilledHole hole{area, granite.c66, -5e6, {1e9, 1000.0, 0.0}, 0.0};
  const double relaxed = area * (1.0 - 5e6 / granite.c66);
  EXPECT_NEAR(hole.injected(5e6), area * std::exp(5e6 / 1e9) - relaxed, 1e-15);
}

TEST(Estimates, TimeOfVolume) {
  const Pump pump({{1.0, 2.0, 0.5}, {3.0, 4.0, 1.0}});
  EXPECT_NEAR(time_of_volume(pump, 0.25, 10.0), 1.5, 1e-12);
  EXPECT_NEAR(time_of_volume(pump, 1.0, 10.0), 3.5, 1e-12);
  EXPECT_EQ(time_of_volume(pump, 1.6, 10.0), std::numeric_limits<double>::infinity());
}

// methods.md 5: the paper's pump for 1 ms.
TEST(Estimates, FractureRegime) {
  const double modulus = plane_strain_modulus(granite), k = toughness(modulus, 5.0);
  EXPECT_NEAR(dimensionless_toughness(modulus, k, 1e-3, 0.065), 0.097, 0.0005);
  EXPECT_NEAR(dimensionless_toughness(modulus, k, 1e-3, 1e-6), 1.55, 0.01);
  EXPECT_NEAR(toughness_half_length(modulus, k, 0.065e-3), 1.36, 0.01);
}

TEST(Estimates, MeasureOfStructuredMeshes) {
  // validation.md B0: sum L2/A is 2 sqrt 3 at least, 4 for right triangles; a little less, edges on
  // the boundary carry no cohesive element.
  const MeshMeasure right =
      measure_mesh(structured_rectangle({-1, -0.5}, {1, 0.5}, 200, 100, MeshPattern::right));
  EXPECT_NEAR(right.sum_length2_over_area, 4.0, 0.04);
  EXPECT_NEAR(right.half_width, 0.5, 1e-12);
  EXPECT_NEAR(right.edge, 0.01, 1e-9);
  EXPECT_NEAR(right.longest_edge, std::sqrt(2.0) * 0.01, 1e-12);
  EXPECT_EQ(right.wellbore_edges, 0);
}

TEST(Estimates, MeasureOfWellbore) {
  MeshRecipe recipe;
  recipe.width = recipe.height = 1.0;
  recipe.wellbore_diameter = 0.1;
  recipe.wellbore_segments = 24;
  recipe.size_fine = 0.013;
  recipe.fine_radius = 0.1;
  recipe.size_coarse = 0.1;
  const MeshMeasure m = measure_mesh(excavate(generate_mesh(recipe)));
  EXPECT_EQ(m.wellbore_edges, 24);
  EXPECT_NEAR(m.wellbore_area, 12.0 * 0.05 * 0.05 * std::sin(2.0 * std::numbers::pi / 24.0), 1e-8);
  EXPECT_NEAR(m.edge, 0.013, 0.002) << "of the fine part only";
}

}  // namespace
}  // namespace crackle
