// SPDX-License-Identifier: GPL-3.0-or-later
#include "crackle/analysis/fall_off.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "records.hpp"

namespace crackle_test {
namespace {

using crackle::FallOff;

FallOff fall_off_of(const crackle::PressureRecord& record, double window = 0.0) {
  return crackle::make_fall_off(record, crackle::find_injection(record), {300.0, 1.0, window});
}

CarterTest never_closing() {
  CarterTest test;
  test.closure = 0.0;
  test.leak_off_coefficient = 5e-7;
  return test;
}

// Carter's fall-off is a line over G: its derivative by G is exact in any window, for both ways to sample.
TEST(FallOff, DerivativeOfCartersLine) {
  const CarterTest test = never_closing();
  double worst = 0.0;
  for (const auto& times : {sampling(1.0, 0.01, 1e5), sampling(5.0, 0.0, 1e5)}) {
    const FallOff f = fall_off_of(record_of(test, times), 0.4);
    for (std::size_t i = 1; i + 1 < f.size(); ++i)
      worst = std::max(worst, std::abs(f.by_g.value[i] / test.fall_per_g() - 1.0));
  }
  std::printf("dp/dG of a line over G, window of 0.4 decades: %.1e\n", worst);
  EXPECT_LT(worst, 1e-6);
}

TEST(FallOff, NoiseIsMeasured) {
  const auto quiet = record_of(never_closing(), sampling(1.0, 0.01, 1e5));
  const auto noise = [](const crackle::PressureRecord& r) { return fall_off_of(r).noise; };
  std::printf("noise found: %.2g Pa of 0, %.4g of 1000, %.4g of 5000\n", noise(quiet),
              noise(with_noise(quiet, 1e3, 1)), noise(with_noise(quiet, 5e3, 2)));
  EXPECT_LT(noise(quiet), 5.0);
  EXPECT_NEAR(noise(with_noise(quiet, 1e3, 1)), 1e3, 150.0);
  EXPECT_NEAR(noise(with_noise(quiet, 5e3, 2)), 5e3, 750.0);
}

TEST(FallOff, StepsOfTheGaugeAreNoise) {
  std::vector<double> time, pressure;
  for (int i = 0; i < 1000; ++i) {
    time.push_back(i);
    pressure.push_back(690.0 * std::round((40e6 - 50.0 * i) / 690.0));
  }
  EXPECT_NEAR(crackle::noise_of(time, pressure), 690.0 / std::sqrt(12.0), 1e-6);
}

TEST(FallOff, WindowGrowsWithNoise) {
  const auto quiet = record_of(CarterTest{}, sampling(1.0, 0.01, 1e5));
  EXPECT_DOUBLE_EQ(fall_off_of(quiet).window, 0.15);
  EXPECT_LE(fall_off_of(quiet).noise_share, 0.05);
  const FallOff noisy = fall_off_of(with_noise(quiet, 3e4, 1));
  EXPECT_GT(noisy.window, 0.15);
}

// The stated error of the slopes is the one that repeated noise makes.
TEST(FallOff, ErrorOfTheDerivativeIsTheOneStated) {
  const auto quiet = record_of(never_closing(), sampling(1.0, 0.01, 1e5));
  double squares = 0.0, count = 0.0;
  for (std::uint32_t seed = 1; seed <= 40; ++seed) {
    const FallOff f = fall_off_of(with_noise(quiet, 2e3, seed), 0.2);
    for (std::size_t i = 1; i + 1 < f.size(); ++i) {
      const double z = (f.by_g.value[i] - never_closing().fall_per_g()) / f.by_g.error[i];
      squares += z * z;
      count += 1.0;
    }
  }
  std::printf("error of dp/dG over the one stated: %.3f\n", std::sqrt(squares / count));
  EXPECT_NEAR(std::sqrt(squares / count), 1.0, 0.1);
}

}  // namespace
}  // namespace crackle_test
