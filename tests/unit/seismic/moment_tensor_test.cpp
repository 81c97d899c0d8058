// SPDX-License-Identifier: GPL-3.0-or-later
//
// Moment tensors of a broken edge of 3 mm in the granite of AbuAisha et al. (2016): E = 35 GPa, nu = 0.27.
// Values worked out apart from the code.
#include "crackle/seismic/moment_tensor.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>

namespace crackle {
namespace {

constexpr double young = 35e9, nu = 0.27;
constexpr Lame granite{young * nu / ((1 + nu) * (1 - 2 * nu)), young / (2 * (1 + nu))};
constexpr Vec2 along_x{2.0, 0.0};  // face a to the left: its outward normal is -y

TEST(MomentTensor, OfAnOpeningEdge) {
  const MomentTensor m = moment_of_jump(granite, along_x, 3e-3, 5.15e-6, 0.0);
  const double m0 = scalar_moment(m);
  std::printf("opening: %.3f %.3f %.3f, M0 %.3f N m, Mw %.4f\n", m.xx, m.yy, m.zz, m0, moment_magnitude(m0));
  EXPECT_NEAR(m.xx, 249.919, 1e-3);
  EXPECT_NEAR(m.yy, 675.706, 1e-3);
  EXPECT_NEAR(m.zz, 249.919, 1e-3);
  EXPECT_EQ(m.xy, 0.0);
  EXPECT_NEAR(m0, 539.2, 0.05);
  EXPECT_NEAR(moment_magnitude(m0), -4.245, 5e-4);
}

TEST(MomentTensor, OfASlidingEdge) {
  const MomentTensor m = moment_of_jump(granite, along_x, 3e-3, 0.0, 10e-6);
  const double m0 = scalar_moment(m);
  std::printf("slip: xy %.3f, M0 %.3f N m, Mw %.4f\n", m.xy, m0, moment_magnitude(m0));
  EXPECT_EQ(m.xx, 0.0);
  EXPECT_EQ(m.zz, 0.0);
  // face b lies below and moves to +x
  EXPECT_NEAR(m.xy, -413.4, 0.05);
  EXPECT_NEAR(m0, 413.4, 0.05);
  EXPECT_NEAR(moment_magnitude(m0), -4.322, 5e-4);
}

TEST(MomentTensor, SwappedFacesChangeNothing) {
  const Vec2 t{0.3, -0.7};
  const MomentTensor m = moment_of_jump(granite, t, 1.0, 2e-6, -3e-6);
  const MomentTensor swapped = moment_of_jump(granite, -t, 1.0, 2e-6, -3e-6);
  EXPECT_EQ(m, swapped);
}

TEST(MomentTensor, SharesOfACrackOfASlipAndOfAnExplosion) {
  const double stiff = granite.lambda + 2.0 * granite.shear_modulus;
  double worst = 0.0;
  for (const double angle : {0.0, 0.4, 1.1, 2.9}) {
    const Vec2 t{std::cos(angle), std::sin(angle)};
    const MomentShares crack = moment_shares(moment_of_jump(granite, t, 0.1, 1e-5, 0.0));
    worst = std::max({worst, std::abs(crack.iso - (stiff - 4.0 / 3.0 * granite.shear_modulus) / stiff),
                      std::abs(crack.clvd - 4.0 / 3.0 * granite.shear_modulus / stiff), std::abs(crack.dc)});
    const MomentShares slip = moment_shares(moment_of_jump(granite, t, 0.1, 0.0, 1e-5));
    worst = std::max({worst, std::abs(slip.iso), std::abs(slip.clvd), std::abs(slip.dc - 1.0)});
    const MomentShares closing = moment_shares(moment_of_jump(granite, t, 0.1, -1e-5, 0.0));
    worst = std::max({worst, std::abs(closing.iso + crack.iso), std::abs(closing.clvd + crack.clvd)});
    const MomentShares both = moment_shares(moment_of_jump(granite, t, 0.1, 1e-5, -2e-5));
    worst = std::max(worst, std::abs(std::abs(both.iso) + std::abs(both.clvd) + both.dc - 1.0));
    const double root = std::sqrt(5.0), mu = granite.shear_modulus;
    worst = std::max(worst, std::abs(both.dc - (root - 1.0) * mu / (granite.lambda + (root + 1.0) * mu)));
  }
  const MomentShares explosion = moment_shares({2.0, 2.0, 2.0, 0.0});
  worst = std::max({worst, std::abs(explosion.iso - 1.0), explosion.dc, explosion.clvd});
  const MomentShares nothing = moment_shares({});
  worst = std::max({worst, nothing.iso, nothing.clvd, nothing.dc});
  std::printf("shares: largest error %.1e\n", worst);
  EXPECT_LT(worst, 1e-12);
}

// sin(tensile angle) = (M1 + M3 - 2 M2) / (M1 - M3), Vavrycuk (2001): the tensor knows how it was made.
TEST(MomentTensor, KeepsTheTensileAngle) {
  double worst = 0.0;
  for (const double degree : {-80.0, -20.0, 0.0, 10.0, 45.0, 75.0}) {
    const double angle = degree * std::numbers::pi / 180.0;
    const MomentTensor m = moment_of_jump(granite, {0.6, 0.8}, 1.0, std::sin(angle), std::cos(angle));
    const double mean = 0.5 * (m.xx + m.yy), radius = std::hypot(0.5 * (m.xx - m.yy), m.xy);
    worst = std::max(worst, std::abs((2.0 * mean - 2.0 * m.zz) / (2.0 * radius) - std::sin(angle)));
  }
  std::printf("tensile angle: largest error of its sine %.1e\n", worst);
  EXPECT_LT(worst, 1e-14);
}

TEST(MomentTensor, TypesOfSources) {
  EXPECT_EQ(source_type(1e-6, 0.0), SourceType::tensile);
  EXPECT_EQ(source_type(1.74, -1.0), SourceType::tensile);
  EXPECT_EQ(source_type(1.72, 1.0), SourceType::mixed);
  EXPECT_EQ(source_type(0.58, -1.0), SourceType::mixed);
  EXPECT_EQ(source_type(0.57, 1.0), SourceType::shear);
  EXPECT_EQ(source_type(-0.57, 1.0), SourceType::shear);
  EXPECT_EQ(source_type(-0.58, 1.0), SourceType::closing);
  EXPECT_STREQ(to_string(SourceType::closing), "closing");
}

TEST(MomentTensor, NoMomentHasAFiniteMagnitude) {
  EXPECT_NEAR(moment_magnitude(0.0), 2.0 / 3.0 * (-6.0 - 9.1), 1e-12);
}

}  // namespace
}  // namespace crackle
