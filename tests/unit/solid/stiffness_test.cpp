// SPDX-License-Identifier: GPL-3.0-or-later
//
// Stiffness of bedded rock (validation.md A5), turned axes, and constants that make up for a compliance.
#include "crackle/solid/stiffness.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <numbers>

#include "crackle/core/errors.hpp"
#include "static_solve.hpp"

namespace crackle {
namespace {

constexpr TransverseIsotropy shale{40e9, 20e9, 0.2, 0.25, 9e9, 0.0};

double largest_difference(const PlaneStiffness& a, const PlaneStiffness& b) {
  return std::max({std::abs(a.c11 - b.c11), std::abs(a.c12 - b.c12), std::abs(a.c22 - b.c22),
                   std::abs(a.c16 - b.c16), std::abs(a.c26 - b.c26), std::abs(a.c66 - b.c66)});
}

// The inverse of the three-dimensional compliance over (xx, yy, zz), y across the bedding.
TEST(Stiffness, OfBeddedRockIsThatOfItsThreeDimensionalCompliance) {
  Eigen::Matrix3d compliance;
  const double h = 1.0 / shale.young_modulus, v = 1.0 / shale.young_modulus_normal;
  compliance << h, -shale.poisson_ratio_normal * v, -shale.poisson_ratio * h,  //
      -shale.poisson_ratio_normal * v, v, -shale.poisson_ratio_normal * v,     //
      -shale.poisson_ratio * h, -shale.poisson_ratio_normal * v, h;
  const Eigen::Matrix3d c = compliance.inverse();
  const PlaneStiffness got = transversely_isotropic_plane_strain(shale);
  const double error = largest_difference(
      got, {.c11 = c(0, 0), .c12 = c(0, 1), .c22 = c(1, 1), .c66 = shale.shear_modulus_normal});
  std::printf("bedded rock: c11 %.6f, c12 %.6f, c22 %.6f GPa; off the inverse compliance by %.1e\n",
              1e-9 * got.c11, 1e-9 * got.c12, 1e-9 * got.c22, error / got.c11);
  EXPECT_LT(error, 1e-13 * got.c11);
  EXPECT_NEAR(got.c11, 53.030303e9, 1e3);
  EXPECT_NEAR(got.c12, 18.181818e9, 1e3);
  EXPECT_NEAR(got.c22, 29.090909e9, 1e3);
  EXPECT_NEAR(got.c12 / got.c22, 0.625, 1e-12);
}

TEST(Stiffness, OfBeddedRockWithEqualModuliIsIsotropic) {
  const double e = 35e9, nu = 0.27;
  const PlaneStiffness got = transversely_isotropic_plane_strain({e, e, nu, nu, e / (2 + 2 * nu), 0.7});
  EXPECT_LT(largest_difference(got, isotropic_plane_strain(e, nu)), 1e-13 * got.c11);
}

TEST(Stiffness, ThatWouldReleaseEnergyIsRefused) {
  EXPECT_THROW(transversely_isotropic_plane_strain({40e9, 10e9, 0.3, 0.35, 9e9, 0.0}), CaseError);
}

// A rectangle of turned bedding under a uniform strain, against the stress in the bedding's own axes.
TEST(Stiffness, PatchOfTurnedBedding) {
  for (const double angle : {0.0, 0.5, -1.2, 2.0}) {
    TransverseIsotropy rock = shale;
    rock.bedding_angle = angle;
    const auto mesh = std::make_shared<const Mesh>(
        jittered(structured_rectangle({-1, -1}, {1, 1}, 5, 5, MeshPattern::cross), 0.25, 3));
    const Bulk bulk(*mesh, transversely_isotropic_plane_strain(rock), granite::density, {}, {});
    State state = make_tied_state(mesh);
    set_mass(state, granite::density);
    fix_nodes(state, EdgeKind::outer);
    const Sym2 strain{1e-9, -3e-9, 2e-9};  // small: Green's strain is it to 1e-9
    const auto linear = [&](Vec2 x) {
      return Vec2{strain.xx * x.x + strain.xy * x.y, strain.xy * x.x + strain.yy * x.y};
    };
    for (Index n = 0; n < state.node_count(); ++n) {
      if (state.inverse_mass[granite::at(n)] == 0.0)
        state.displacement[granite::at(n)] = linear(state.node_reference(n));
    }
    const double left = solve_static(state, {bulk, nullptr, {}}, 1e-6);
    // by hand: strain along (t) and across (n) the bedding, stress there, and back
    const Vec2 t{std::cos(angle), std::sin(angle)}, n{-t.y, t.x};
    const double e_t = dot(t, strain * t), e_n = dot(n, strain * n), e_tn = dot(t, strain * n);
    const double s_t = 53.0303030303e9 * e_t + 18.1818181818e9 * e_n,
                 s_n = 18.1818181818e9 * e_t + 29.0909090909e9 * e_n, s_tn = 18e9 * e_tn;
    const Sym2 expected{s_t * t.x * t.x + s_n * n.x * n.x + 2 * s_tn * t.x * n.x,
                        s_t * t.y * t.y + s_n * n.y * n.y + 2 * s_tn * t.y * n.y,
                        s_t * t.x * t.y + s_n * n.x * n.y + s_tn * (t.x * n.y + t.y * n.x)};
    double worst = 0.0;
    for (Index k = 0; k < mesh->triangle_count(); ++k) {
      worst = std::max(worst, granite::larger_part(granite::difference(bulk.stress(state, k), expected)));
    }
    std::printf("bedding at %+.1f rad: stress error %.1e, unbalanced %.0e\n", angle,
                worst / granite::larger_part(expected), left);
    EXPECT_LT(worst, 1e-7 * granite::larger_part(expected));
  }
}

TEST(Stiffness, WaveSpeedsTurnWithTheBedding) {
  const PlaneStiffness level = transversely_isotropic_plane_strain(shale);
  for (const double angle : {0.3, 1.1, 2.5}) {
    const WaveSpeeds a = wave_speeds(level, 2500, {1, 0});
    const WaveSpeeds b = wave_speeds(turned(level, angle), 2500, {std::cos(angle), std::sin(angle)});
    EXPECT_NEAR(b.p / a.p, 1.0, 1e-14);
    EXPECT_NEAR(b.s / a.s, 1.0, 1e-14);
    EXPECT_NEAR(wave_speeds(turned(level, angle), 2500).p / a.p, 1.0, 2e-4);  // by whole degrees
  }
}

TEST(Stiffness, CompensatedForACompliance) {
  // Isotropic: (λ+μ)* = 1/(1/(λ+μ) − 2κ/p_f), μ* = 1/(1/μ − 2κ/p_f) (methods.md 2.3).
  const PlaneStiffness rock = granite::stiffness();
  const double compliance = 1.8 / 200e9;
  const PlaneStiffness stiffer = compensated(rock, compliance);
  const double bulk = 0.5 * (rock.c11 + rock.c12), mu = rock.c66;
  EXPECT_NEAR(0.5 * (stiffer.c11 + stiffer.c12) * (1 / bulk - 2 * compliance), 1.0, 1e-14);
  EXPECT_NEAR(stiffer.c66 * (1 / mu - 2 * compliance), 1.0, 1e-14);
  // Bedded and turned: in series with that compliance, strains are those of the rock.
  const PlaneStiffness bedded = turned(transversely_isotropic_plane_strain(shale), 0.6);
  const PlaneStiffness c = compensated(bedded, compliance);
  const Sym2 strain{2e-4, -1e-4, 3e-4}, stress = bedded.stress(strain);
  const Sym2 triangles = strain + (-compliance) * stress;
  EXPECT_LT(granite::larger_part(granite::difference(c.stress(triangles), stress)),
            1e-13 * granite::larger_part(stress));
  EXPECT_THROW(compensated(rock, 1.0 / rock.c11), CaseError);
}

}  // namespace
}  // namespace crackle
