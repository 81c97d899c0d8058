// SPDX-License-Identifier: GPL-3.0-or-later
//
// b-values of made-up catalogs whose b is known.
#include "crackle/seismic/b_value.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>
#include <random>
#include <vector>

namespace crackle {
namespace {

/// Magnitudes above a least one that follow log10 N = a - b M.
std::vector<double> gutenberg_richter(int count, double b, double least, unsigned seed) {
  std::mt19937_64 random(seed);
  std::vector<double> magnitudes;
  for (int i = 0; i < count; ++i) {
    const double share = (static_cast<double>(random() >> 11) + 0.5) * 0x1p-53;
    magnitudes.push_back(least - std::log10(share) / b);
  }
  return magnitudes;
}

TEST(BValue, OfContinuousMagnitudes) {
  const BValue found = b_value(gutenberg_richter(5000, 1.2, -5.0, 1), -5.0, 0.0);
  std::printf("b = %.4f +- %.4f (Aki), +- %.4f (Shi & Bolt), true 1.2\n", found.b, found.sigma_aki,
              found.sigma_shi_bolt);
  EXPECT_EQ(found.events, 5000);
  EXPECT_LT(std::abs(found.b - 1.2), 3.0 * found.sigma_aki);
  EXPECT_NEAR(found.sigma_aki, 1.2 / std::sqrt(5000.0), 5e-4);  // 0.017
  EXPECT_NEAR(found.sigma_shi_bolt, found.sigma_aki, 0.1 * found.sigma_aki);
}

// The uncertainty is what it says: over many catalogs, the scatter of b.
TEST(BValue, UncertaintyIsTheScatter) {
  constexpr int catalogs = 400, events = 300;
  double sum = 0.0, squares = 0.0, aki = 0.0, shi_bolt = 0.0;
  for (unsigned seed = 0; seed < catalogs; ++seed) {
    const BValue found = b_value(gutenberg_richter(events, 0.9, -5.0, seed), -5.0, 0.0);
    sum += found.b, squares += found.b * found.b;
    aki += found.sigma_aki / catalogs, shi_bolt += found.sigma_shi_bolt / catalogs;
  }
  const double mean = sum / catalogs, scatter = std::sqrt(squares / catalogs - mean * mean);
  std::printf("b: mean %.4f, scatter %.4f; said %.4f (Aki), %.4f (Shi & Bolt)\n", mean, scatter, aki,
              shi_bolt);
  EXPECT_NEAR(mean, 0.9, 0.01);
  EXPECT_NEAR(aki, scatter, 0.1 * scatter);
  EXPECT_NEAR(shi_bolt, scatter, 0.1 * scatter);
}

TEST(BValue, OfRoundedMagnitudesNeedsTheBin) {
  std::vector<double> magnitudes = gutenberg_richter(5000, 1.2, -5.05, 1);
  for (double& m : magnitudes) m = std::round(m * 10.0) / 10.0;
  const BValue found = b_value(magnitudes, -5.0, 0.1), wrong = b_value(magnitudes, -5.0, 0.0);
  std::printf("rounded to 0.1: b = %.4f with the bin, %.4f without\n", found.b, wrong.b);
  EXPECT_EQ(found.events, 5000);
  EXPECT_LT(std::abs(found.b - 1.2), 3.0 * found.sigma_aki);
  EXPECT_GT(wrong.b, 1.2 + 3.0 * wrong.sigma_aki) << "the bin matters";
}

TEST(BValue, CompletenessByMaximumCurvature) {
  // all above -4.8, and a third of them below
  std::vector<double> magnitudes = gutenberg_richter(3000, 1.0, -4.85, 2);
  for (int i = 0; i < 900; ++i) magnitudes.push_back(-4.85 - 0.0011 * i);
  const double mc = maximum_curvature(magnitudes, 0.1);
  EXPECT_NEAR(mc, -4.8, 1e-12);
  const BValue found = b_value(magnitudes, mc, 0.1);
  EXPECT_EQ(found.events, 3000 + 1) << "one lies on the bound";
  EXPECT_EQ(b_value(magnitudes, mc, 0.0).completeness, mc);
  EXPECT_TRUE(std::isnan(maximum_curvature({}, 0.1)));
}

TEST(BValue, NeedsTwoDifferentMagnitudes) {
  EXPECT_TRUE(std::isnan(b_value({}, -5.0, 0.0).b));
  const double one[] = {-4.0}, same[] = {-4.0, -4.0, -4.0}, two[] = {-4.0, -4.5};
  EXPECT_TRUE(std::isnan(b_value(one, -5.0, 0.0).b));
  EXPECT_TRUE(std::isnan(b_value(same, -5.0, 0.0).sigma_shi_bolt));
  EXPECT_NEAR(b_value(two, -5.0, 0.0).b, std::numbers::log10e / 0.75, 1e-12);
}

}  // namespace
}  // namespace crackle
