// SPDX-License-Identifier: GPL-3.0-or-later
#include "crackle/analysis/g_function.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace crackle {
namespace {

constexpr double pi = std::numbers::pi;

TEST(GFunction, KnownValues) {
  EXPECT_NEAR(g_function(1.0, 1.0, 1.0), 1.40638, 5e-6);
  EXPECT_NEAR(g_function(1.0, 1.0, 0.5), 1.27324, 5e-6);
  EXPECT_NEAR(g_function(900.0, 300.0, 1.0), 3.06231, 5e-6);
  EXPECT_NEAR(g_function(900.0, 300.0, 0.5), 2.87198, 5e-6);
  EXPECT_DOUBLE_EQ(g_at_shut_in(1.0), 4.0 / 3.0);
  EXPECT_DOUBLE_EQ(g_at_shut_in(0.5), 0.5 * pi);
}

// The leak-off of an area that grows as t^alpha while pumped: g is its integral over the exposures.
TEST(GFunction, IsTheIntegralOverExposures) {
  double worst = 0.0;
  for (const double alpha : {1.0, 0.5}) {
    for (const double d : {0.01, 0.3, 2.0, 50.0}) {
      // ∫ sqrt(1 + d - s^{1/alpha}) ds over the area 0 <= s <= 1, s = 1 - y² smooths the end
      double leaked = 0.0;
      constexpr int n = 20000;
      for (int i = 0; i < n; ++i) {
        const double y = (i + 0.5) / n, s = 1.0 - y * y;
        leaked += std::sqrt(1.0 + d - std::pow(s, 1.0 / alpha)) * 2.0 * y / n;
      }
      const double g = 0.25 * pi * g_function(d, 1.0, alpha) + g_at_shut_in(alpha);
      worst = std::max(worst, std::abs(2.0 * leaked / g - 1.0));
    }
  }
  std::printf("G-function against the integral of Carter's law: %.1e\n", worst);
  EXPECT_LT(worst, 1e-6);
}

TEST(GFunction, KeepsItsDigitsAtBothEnds) {
  for (const double alpha : {1.0, 0.5}) {
    // short: the rate at shut-in; long: root of time
    EXPECT_NEAR(g_function(1e-9, 1.0, alpha) / 1e-9, 4.0 / pi * (alpha == 1.0 ? 2.0 : 0.5 * pi), 2e-4);
    const double late = g_function(1e10, 1.0, alpha);
    EXPECT_NEAR((0.25 * pi * late + g_at_shut_in(alpha)) / 2e5, 1.0, 1e-9);
  }
}

}  // namespace
}  // namespace crackle
