// SPDX-License-Identifier: GPL-3.0-or-later
#include "crackle/fluid/fracture_flow.hpp"

#include <gtest/gtest.h>

namespace crackle {
namespace {

TEST(FractureFlow, TurbulentFrictionIsThatOfBlasius) {
  FractureFluid water;
  water.viscosity = 1e-3;
  water.reference_density = 1000.0;
  const double aperture = 1e-3, gradient = 1e6;  // [m], [Pa/m]
  const double q = water.flow(water.conductivity(aperture).value * gradient).value;
  const double speed = q / aperture, reynolds = 1000.0 * speed * 2.0 * aperture / 1e-3;
  ASSERT_GT(reynolds, 2300.0);
  // Darcy and Weisbach: dp/dx = f ρ v² / (2 D), D = 2 w, f = 0.316 Re^-1/4
  const double friction = 0.316 * std::pow(reynolds, -0.25);
  EXPECT_NEAR(friction * 1000.0 * speed * speed / (4.0 * aperture) / gradient, 1.0, 1e-12);
}

TEST(FractureFlow, SlowFlowIsLaminarAndTheChangeIsSmooth) {
  FractureFluid water;
  water.reference_density = 1000.0;
  EXPECT_EQ(water.flow(1e-4).value, 1e-4);
  EXPECT_EQ(FractureFluid{}.flow(1.0).value, 1.0) << "without a density";
  // F = 1 at Re = (96/0.316)^(4/3), where Blasius' friction is the laminar one
  const double change = 1e-3 * std::pow(96.0 / 0.316, 4.0 / 3.0) / 2000.0;
  EXPECT_EQ(water.flow(0.999999 * change).value, 0.999999 * change);
  EXPECT_NEAR(water.flow(1.000001 * change).value / change, 1.0, 1e-5);
}

TEST(FractureFlow, SlopeIsThatOfTheFlow) {
  FractureFluid water;
  water.reference_density = 1000.0;
  for (const double q : {-0.05, -1e-3, 0.01, 0.3}) {
    const double h = 1e-6 * std::abs(q);
    EXPECT_NEAR((water.flow(q + h).value - water.flow(q - h).value) / (2.0 * h), water.flow(q).slope, 1e-6);
  }
}

}  // namespace
}  // namespace crackle
