// SPDX-License-Identifier: GPL-3.0-or-later
#include "regimes.hpp"

namespace crackle {
namespace {

// K_m = 7.3: pressure is uniform, as the explicit cavity takes it. On this mesh the explicit crack breaks an
// edge at a time against 3 % more than Griffith's pressure, at any rate of the pump (-2.5, -2.7, -3.2 % of
// pressure between the regimes at the rate, a half and a quarter of it); for 3 mm see regimes_long_test.cpp.
TEST(Regimes, TheSameCrackByStepsAndByEquilibrium) {
  const regimes::Comparison c = regimes::compare(6e-3);
  EXPECT_LT(std::abs(c.pressure), 0.03);
  EXPECT_LT(std::abs(c.by_equilibrium), 0.015);
  EXPECT_LT(std::abs(c.length), 0.05);
  EXPECT_NEAR(c.energy, 1.0, 0.05);
}

}  // namespace
}  // namespace crackle
