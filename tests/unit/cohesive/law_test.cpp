// SPDX-License-Identifier: GPL-3.0-or-later
//
// Cohesive laws at one point: energies to break in mode I, mode II and mixed mode, unloading,
// friction. Target numbers: integrals of the published formulas.
#include "crackle/cohesive/law.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "../../result.hpp"

namespace crackle {
namespace {

// AbuAisha et al. (2016), Table 1.
CohesiveMaterial granite(Calibration calibration) {
  const double tan_phi = std::tan(38.0 * std::numbers::pi / 180.0);
  return {3e6, 24e6, tan_phi, tan_phi, 5.0, 80.0, 120e9, 120e9, calibration};
}

// Work to separate a point along a straight path (opening, slip) = path x (cos, sin) of angle, with
// a constant opening (compression) added, until it is broken.
struct Work {
  double normal = 0.0, shear = 0.0, friction = 0.0;
  bool broken = false;
};
Work separate(const CohesiveLaw& law, const CohesiveMaterial& m, double length, double angle, double opening,
              double reach, int steps) {
  CohesivePoint p;
  law.move(m, length, opening, 0.0, p);
  Work w;
  for (int i = 1; i <= steps; ++i) {
    const CohesivePoint old = p;
    const double d = reach * i / steps;
    law.move(m, length, opening + d * std::cos(angle), d * std::sin(angle), p);
    w.normal += 0.5 * (p.normal + old.normal) * (p.opening - old.opening);
    w.shear += 0.5 * (p.shear + old.shear) * (p.slip - old.slip);
    w.friction += 0.5 * (p.friction + old.friction) * (p.slip - old.slip);
    w.broken = p.damage >= 1.0;
  }
  return w;
}

class EveryLaw : public testing::TestWithParam<std::string> {
 protected:
  std::shared_ptr<const CohesiveLaw> law = find_law(GetParam());
};
INSTANTIATE_TEST_SUITE_P(Law, EveryLaw, testing::Values("evans_marathe", "linear", "benzeggagh_kenane"));

TEST_P(EveryLaw, IsRegistered) { ASSERT_NE(law, nullptr); }

TEST_P(EveryLaw, SofteningFallsFromOneToZeroWithTheStatedIntegral) {
  EXPECT_NEAR(law->softening(0.0), 1.0, 1e-14);
  EXPECT_NEAR(law->softening(1.0), 0.0, 1e-14);
  const int n = 20000;
  double sum = 0.0;
  for (int i = 0; i < n; ++i) {
    EXPECT_LE(law->softening((i + 1.0) / n), law->softening(static_cast<double>(i) / n) + 1e-15);
    sum += law->softening((i + 0.5) / n) / n;
  }
  EXPECT_NEAR(sum, law->softening_integral(), 1e-8);
}

TEST_P(EveryLaw, ExactCalibrationDissipatesTheFractureEnergies) {
  const auto m = granite(Calibration::exact);
  const Work one = separate(*law, m, 3e-3, 0.0, 0.0, 3e-5, 200000);
  const Work two = separate(*law, m, 3e-3, std::numbers::pi / 2, 0.0, 8e-5, 400000);
  std::printf("%s: G_I %.6f of 5 (error %.1e), G_II %.6f of 80 (error %.1e)\n", law->name().c_str(),
              one.normal, one.normal / 5.0 - 1.0, two.shear, two.shear / 80.0 - 1.0);
  EXPECT_TRUE(one.broken && two.broken);
  EXPECT_NEAR(one.normal, 5.0, 5e-3);
  EXPECT_NEAR(two.shear, 80.0, 8e-2);
}

TEST_P(EveryLaw, DissipatesModeTwoEnergyAboveFrictionUnderCompression) {
  const auto m = granite(Calibration::exact);
  const double opening = -5e6 * 3e-3 / m.penalty;  // 5 MPa
  const double reach = 1e-4;
  const Work w = separate(*law, m, 3e-3, std::numbers::pi / 2, opening, reach, 400000);
  const double above = w.shear + w.friction - 5e6 * m.tan_residual * reach;
  std::printf("%s: %.4f of 80 J/m2 above friction\n", law->name().c_str(), above);
  EXPECT_TRUE(w.broken);
  EXPECT_NEAR(above, 80.0, 8e-2);
}

TEST(BenzeggaghKenane, MixedModeEnergyRisesByTheExponent) {
  const Check check("B3 mixed mode, benzeggagh_kenane: energy of five rays");
  const auto law = find_law("benzeggagh_kenane");
  double worst = 0.0;
  for (const double exponent : {2.0, 4.0}) {
    for (int degrees = 0; degrees <= 60; degrees += 15) {
      auto m = granite(Calibration::exact);
      m.mixed_mode_exponent = exponent;
      const double across = std::cos(degrees * std::numbers::pi / 180.0),
                   along = std::sqrt(1.0 - across * across);
      const double energy = m.fracture_energy_mode1 + (m.fracture_energy_mode2 - m.fracture_energy_mode1) *
                                                          std::pow(along * along, exponent);
      CohesivePoint p;
      double work = 0.0;
      for (int i = 1; p.damage < 1.0; ++i) {
        const CohesivePoint old = p;
        law->move(m, 3e-3, 1e-10 * i * across, 1e-10 * i * along, p);
        work += 0.5 * (p.normal + old.normal) * (p.opening - old.opening) +
                0.5 * (p.shear + old.shear) * (p.slip - old.slip);
        ASSERT_LT(i, 10000000);
      }
      std::printf("exponent %g, %2d degrees: %.4f J/m2, by the formula %.4f\n", exponent, degrees, work,
                  energy);
      worst = std::max(worst, std::abs(work / energy - 1.0));
    }
  }
  check.result(worst);
  EXPECT_LT(worst, 1e-3);
}

TEST(EvansMarathe, YGeoCalibrationDissipatesWhatYGeoDoes) {
  const auto law = find_law("evans_marathe");
  const Work w = separate(*law, granite(Calibration::y_geo), 3e-3, 0.0, 0.0, 1e-5, 200000);
  std::printf("y_geo, 3 mm edge: %.5f J/m2 (published parts: 0.300 + 5.7946)\n", w.normal);
  EXPECT_NEAR(w.normal, 6.0946, 6e-3);
}

TEST(EvansMarathe, MixedModeSofteningFollowsTheEllipse) {
  const Check check("B3 mixed mode against the ellipse");
  double worst = 0.0;
  const auto law = find_law("evans_marathe");
  const auto m = granite(Calibration::y_geo);
  const double length = 3e-3, k = m.penalty / length;
  const double o_p = 2.0 * m.tensile_strength / k, s_p = 2.0 * m.cohesion / k;
  const double o_t = law->softening_opening(m, length), s_t = law->softening_slip(m, length, 0.0);
  const double g1 = law->softening_integral() * m.tensile_strength * o_t;
  const double g2 = law->softening_integral() * m.cohesion * s_t;
  for (int degrees = 0; degrees <= 90; degrees += 15) {
    // Radial in damage: (o − o_p, s − s_p) = D (o_t cos ψ, s_t sin ψ).
    const double psi = degrees * std::numbers::pi / 180.0;
    CohesivePoint p;
    law->move(m, length, o_p, s_p, p);
    double normal = 0.0, shear = 0.0;
    const int n = 20000;
    for (int i = 1; i <= n; ++i) {
      const CohesivePoint old = p;
      const double d = 1.0001 * i / n;
      law->move(m, length, o_p + d * o_t * std::cos(psi), s_p + d * s_t * std::sin(psi), p);
      normal += 0.5 * (p.normal + old.normal) * (p.opening - old.opening);
      shear += 0.5 * (p.shear + old.shear) * (p.slip - old.slip);
    }
    const double ellipse = std::hypot(normal / g1, shear / g2);
    std::printf("psi %2d deg: ellipse %.5f (error %.1e)\n", degrees, ellipse, ellipse - 1.0);
    EXPECT_GE(p.damage, 1.0);
    worst = std::max(worst, std::abs(ellipse - 1.0));
    EXPECT_NEAR(ellipse, 1.0, 0.02);
  }
  check.result(worst);
}

TEST_P(EveryLaw, StrengthFollowsMohrCoulomb) {
  const auto m = granite(Calibration::exact);
  const double expected[] = {24e6, 25.563e6, 27.906e6, 31.813e6};
  const double compression[] = {0.0, 2e6, 5e6, 10e6};
  for (int i = 0; i < 4; ++i) {
    CohesivePoint p;
    double peak = 0.0;
    for (double s = 0.0; s < 5e-6; s += 1e-9) {
      law->move(m, 3e-3, -compression[i] * 3e-3 / m.penalty, s, p);
      peak = std::max(peak, p.shear + p.friction);
    }
    EXPECT_NEAR(peak, expected[i], 2e-3 * expected[i]);
  }
}

TEST_P(EveryLaw, ResidualFrictionStaysAndTurnsWithTheSlip) {
  const auto m = granite(Calibration::exact);
  const double opening = -5e6 * 3e-3 / m.penalty;
  CohesivePoint p;
  for (double s = 0.0; s <= 2e-4; s += 1e-8) law->move(m, 3e-3, opening, s, p);
  EXPECT_GE(p.damage, 1.0);
  EXPECT_NEAR(p.shear + p.friction, 5e6 * m.tan_residual, 1.0);
  for (double s = 2e-4; s >= 1.9e-4; s -= 1e-8) law->move(m, 3e-3, opening, s, p);
  EXPECT_NEAR(p.shear + p.friction, -5e6 * m.tan_residual, 1.0);
}

TEST_P(EveryLaw, UnloadingAndReloadingDoesNotHeal) {
  const auto m = granite(Calibration::exact);
  CohesivePoint p;
  const double half = 0.5 * law->softening_opening(m, 3e-3);
  for (int i = 0; i <= 1000; ++i) law->move(m, 3e-3, half * i / 1000, 0.0, p);
  const double before = p.normal, damage = p.damage;
  ASSERT_GT(damage, 0.3);
  for (int i = 1000; i >= 0; --i) law->move(m, 3e-3, half * i / 1000, 0.0, p);
  EXPECT_NEAR(p.normal, 0.0, 1e-6 * m.tensile_strength);
  EXPECT_NEAR(p.stored, 0.0, 1e-9);
  for (int i = 0; i <= 1000; ++i) law->move(m, 3e-3, half * i / 1000, 0.0, p);
  EXPECT_NEAR(p.normal, before, 1e-9 * before);
  EXPECT_EQ(p.damage, damage);
}

TEST_P(EveryLaw, ElasticInverseIsExact) {
  const auto m = granite(Calibration::exact);
  for (const double normal : {-8e6, -1e5, 0.0, 1e6, 2.9e6}) {
    for (const double shear : {-2e7, -1e6, 0.0, 3e6, 2.3e7}) {
      CohesivePoint p;
      law->move(m, 5e-3, law->elastic_opening(m, 5e-3, normal), law->elastic_slip(m, 5e-3, normal, shear), p);
      EXPECT_NEAR(p.normal, normal, 1e-4);
      EXPECT_NEAR(p.shear + p.friction, shear, 1e-3);
    }
  }
}

TEST(ArtificialCompliance, MatchesTheTableOfEquilateralMeshes) {
  const double e = 35e9, nu = 0.27, plane = e / (1 - nu * nu);
  EXPECT_NEAR(artificial_modulus_ratio(plane, e / 2 / (1 + nu), 3.43 * e, 2.0 * std::sqrt(3.0)).young, 0.6474,
              5e-4);
}

}  // namespace
}  // namespace crackle
