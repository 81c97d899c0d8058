// SPDX-License-Identifier: GPL-3.0-or-later
#include "regimes.hpp"

namespace crackle {
namespace {

TEST(Regimes, TheSameCrackOnAFinerMesh) {
  const regimes::Comparison c = regimes::compare(3e-3);
  EXPECT_LT(std::abs(c.pressure), 0.02);
  EXPECT_LT(std::abs(c.by_equilibrium), 0.015);
  EXPECT_LT(std::abs(c.length), 0.05);
  EXPECT_NEAR(c.energy, 1.0, 0.05);
}

}  // namespace
}  // namespace crackle
