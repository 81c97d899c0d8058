// SPDX-License-Identifier: GPL-3.0-or-later
// Statistics of random joint sets against their distributions. Bounds are five standard errors of the
// estimate: the seeds are fixed, so a test either passes always or never.
#include <gmock/gmock.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <numeric>

#include "crackle/mesh/joints.hpp"
#include "mesh_checks.hpp"

namespace crackle {
namespace {

using testing::HasSubstr;

constexpr int count = 20000;

/// A set of 20 000 joints on 1 m2.
JointSet many() {
  JointSet set;
  set.density = count;
  set.length.mean = 0.03;
  set.region = {{0.0, 0.0}, {1.0, 1.0}};
  return set;
}

std::vector<double> lengths(const JointSet& set) {
  std::vector<double> all;
  for (const Joint& joint : generate_joints(set)) all.push_back(norm(joint.to - joint.from));
  return all;
}

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double deviation(const std::vector<double>& values) {
  const double m = mean(values);
  double sum = 0.0;
  for (const double value : values) sum += (value - m) * (value - m);
  return std::sqrt(sum / static_cast<double>(values.size() - 1));
}

/// Largest distance of the sample's distribution function from F (Kolmogorov-Smirnov).
template <class Cdf>
double farthest(std::vector<double> values, const Cdf& cdf) {
  std::sort(values.begin(), values.end());
  double most = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double f = cdf(values[i]), n = static_cast<double>(values.size());
    most = std::max({most, f - static_cast<double>(i) / n, static_cast<double>(i + 1) / n - f});
  }
  return most;
}

/// Passed by all but 1 sample of the distribution in 10 000.
const double ks_bound = 2.23 / std::sqrt(count);

double gauss(double z) { return 0.5 * std::erfc(-z / std::numbers::sqrt2); }

TEST(Network, NormalLengths) {
  JointSet set = many();
  set.length = {JointLengths::Law::normal, 0.031, 0.006, 0.0, 0.0};
  const std::vector<double> all = lengths(set);
  const double far = farthest(all, [](double l) { return gauss((l - 0.031) / 0.006); });
  std::printf("normal: mean %.6f, deviation %.6f, KS %.4f (bound %.4f)\n", mean(all), deviation(all), far,
              ks_bound);
  EXPECT_NEAR(mean(all), 0.031, 5 * 0.006 / std::sqrt(count));
  EXPECT_LT(far, ks_bound);
}

TEST(Network, NormalLengthsAreTruncatedByDrawingAgain) {
  JointSet set = many();
  set.length = {JointLengths::Law::normal, 0.031, 0.02, 0.0, 0.01, 0.06};
  const std::vector<double> all = lengths(set);
  const double low = gauss((0.01 - 0.031) / 0.02), high = gauss((0.06 - 0.031) / 0.02);
  const double far =
      farthest(all, [&](double l) { return (gauss((l - 0.031) / 0.02) - low) / (high - low); });
  std::printf("truncated normal: KS %.4f (bound %.4f)\n", far, ks_bound);
  EXPECT_EQ(all.size(), static_cast<std::size_t>(count));
  EXPECT_LT(far, ks_bound);
}

TEST(Network, LognormalLengthsHaveTheMeanAndDeviationGiven) {
  JointSet set = many();
  set.length = {JointLengths::Law::lognormal, 0.05, 0.03, 0.0, 0.0};
  const double variance = std::log(1.0 + 0.36), shift = std::log(0.05) - 0.5 * variance;
  const std::vector<double> all = lengths(set);
  const double far =
      farthest(all, [&](double l) { return gauss((std::log(l) - shift) / std::sqrt(variance)); });
  std::printf("lognormal: mean %.6f, deviation %.6f, KS %.4f (bound %.4f)\n", mean(all), deviation(all), far,
              ks_bound);
  EXPECT_NEAR(mean(all), 0.05, 5 * 0.03 / std::sqrt(count));
  EXPECT_LT(far, ks_bound);
}

TEST(Network, PowerLawLengths) {
  for (const double exponent : {2.5, 1.0, 0.0}) {
    JointSet set = many();
    set.length = {JointLengths::Law::power_law, 0.0, 0.0, exponent, 0.01, 1.0};
    const auto cdf = [&](double l) {
      const double rise = 1.0 - exponent;
      if (rise == 0.0) return std::log(l / 0.01) / std::log(100.0);
      return (std::pow(l, rise) - std::pow(0.01, rise)) / (1.0 - std::pow(0.01, rise));
    };
    const double far = farthest(lengths(set), cdf);
    std::printf("power law, exponent %.1f: KS %.4f (bound %.4f)\n", exponent, far, ks_bound);
    EXPECT_LT(far, ks_bound);
  }
}

TEST(Network, ConstantLengthAndAngle) {
  JointSet set = many();
  set.direction = {JointDirections::Law::constant, std::numbers::pi / 6.0, 0.0};
  for (const Joint& joint : generate_joints(set)) {
    EXPECT_NEAR(joint.to.x - joint.from.x, 0.03 * std::sqrt(0.75), 1e-15);
    EXPECT_NEAR(joint.to.y - joint.from.y, 0.015, 1e-15);
  }
}

TEST(Network, UniformAngles) {
  std::vector<double> angles;
  for (const Joint& joint : generate_joints(many())) {
    const double angle = std::atan2(joint.to.y - joint.from.y, joint.to.x - joint.from.x);
    angles.push_back(angle < 0.0 ? angle + std::numbers::pi : angle);
  }
  const double far = farthest(angles, [](double angle) { return angle / std::numbers::pi; });
  std::printf("uniform angles: KS %.4f (bound %.4f)\n", far, ks_bound);
  EXPECT_LT(far, ks_bound);
}

TEST(Network, VonMisesAnglesAgainstTheirMoments) {
  for (const double concentration : {0.5, 4.0, 50.0}) {
    JointSet set = many();
    set.direction = {JointDirections::Law::von_mises, 0.4, concentration};
    double cosine = 0.0, sine = 0.0;
    for (const Joint& joint : generate_joints(set)) {
      const double doubled = 2.0 * (std::atan2(joint.to.y - joint.from.y, joint.to.x - joint.from.x) - 0.4);
      cosine += std::cos(doubled) / count;
      sine += std::sin(doubled) / count;
    }
    const double expected = std::cyl_bessel_i(1, concentration) / std::cyl_bessel_i(0, concentration);
    std::printf("von Mises %.1f: mean cosine %.5f (%.5f), mean sine %.5f\n", concentration, cosine, expected,
                sine);
    EXPECT_NEAR(cosine, expected, 5 * std::sqrt(0.5 / count));
    EXPECT_NEAR(sine, 0.0, 5 * std::sqrt(0.5 / count));
  }
}

TEST(Network, MiddlesAreUniformInARectangle) {
  JointSet set = many();
  set.region = {{-2.0, 1.0}, {-1.0, 2.0}};
  std::vector<double> x, y;
  for (const Joint& joint : generate_joints(set)) {
    const Vec2 middle = 0.5 * (joint.from + joint.to);
    x.push_back(middle.x);
    y.push_back(middle.y);
  }
  EXPECT_LT(farthest(x, [](double at) { return at + 2.0; }), ks_bound);
  EXPECT_LT(farthest(y, [](double at) { return at - 1.0; }), ks_bound);
}

TEST(Network, MiddlesAreUniformInACircle) {
  JointSet set = many();
  set.region.radius = 2.0;
  set.density = count / (4.0 * std::numbers::pi);
  std::vector<double> square;
  for (const Joint& joint : generate_joints(set)) {
    const Vec2 middle = 0.5 * (joint.from + joint.to);
    square.push_back(dot(middle, middle));
  }
  EXPECT_EQ(square.size(), static_cast<std::size_t>(count));
  EXPECT_LT(farthest(square, [](double at) { return 0.25 * at; }), ks_bound);
}

TEST(Network, JointsStayClearOfTheWellboreAndKeepTheirDensityElsewhere) {
  JointSet set = many();
  set.region.radius = 0.5;
  set.clear_radius = 0.1;
  double nearest = 1.0;
  int beyond = 0;
  for (const Joint& joint : generate_joints(set)) {
    for (int i = 0; i <= 10; ++i) {
      nearest = std::min(nearest, norm(joint.from + 0.1 * i * (joint.to - joint.from)));
    }
    beyond += norm(0.5 * (joint.from + joint.to)) > 0.1 + 0.5 * 0.03 ? 1 : 0;
  }
  const double expected = count * std::numbers::pi * (0.25 - 0.115 * 0.115);
  std::printf("clear circle of 0.1 m: nearest %.5f m, %d joints beyond, %.0f expected\n", nearest, beyond,
              expected);
  EXPECT_GE(nearest, 0.1);
  EXPECT_NEAR(beyond, expected, 5 * std::sqrt(expected));
}

/// Written down once: another CPU, compiler or C library has to give the same bits.
TEST(Network, TheSameSeedGivesTheSameBits) {
  JointSet set = many();
  std::uint64_t sum = 14695981039346656037u;
  const auto add = [&](const JointSet& s) {
    for (const Joint& joint : generate_joints(s)) {
      for (const double x : {joint.from.x, joint.from.y, joint.to.x, joint.to.y}) {
        sum = (sum ^ std::bit_cast<std::uint64_t>(x)) * 1099511628211u;
      }
    }
  };
  set.density = 1000;
  set.direction = {JointDirections::Law::von_mises, 1.0, 3.0};
  set.length = {JointLengths::Law::normal, 0.03, 0.01, 0.0, 0.0};
  add(set);
  set.length = {JointLengths::Law::lognormal, 0.03, 0.01, 0.0, 0.0};
  add(set);
  set.direction.law = JointDirections::Law::uniform;
  set.length = {JointLengths::Law::power_law, 0.0, 0.0, 2.5, 0.01, 1.0};
  add(set);
  std::printf("checksum %016llx\n", static_cast<unsigned long long>(sum));
  EXPECT_EQ(sum, 0xde9ca9902a2df435u);
}

TEST(Network, AnotherSeedGivesOtherJoints) {
  JointSet set = many();
  const Vec2 first = generate_joints(set).front().from;
  set.seed = 2;
  EXPECT_NE(generate_joints(set).front().from, first);
}

TEST(Network, RefusesWhatCannotBeDrawn) {
  JointSet set = many();
  set.density = 2e6;
  EXPECT_THAT(test::mesh_error([&] { generate_joints(set); }), HasSubstr("more than a million"));
  set = many();
  set.length = {JointLengths::Law::normal, 0.03, 0.001, 0.0, 0.1, 0.2};
  EXPECT_THAT(test::mesh_error([&] { generate_joints(set); }), HasSubstr("hardly any joint"));
}

}  // namespace
}  // namespace crackle
