// SPDX-License-Identifier: GPL-3.0-or-later
//
// Plane-strain stiffness of the intact rock:
//   S = C : E,  with S the second Piola-Kirchhoff stress and E the Green strain, so that a rigid
//   rotation of any size makes no stress.
//
// | parameter     | unit | range       |
// |---------------|------|-------------|
// | young_modulus | Pa   | > 0         |
// | poisson_ratio | -    | (-1, 0.5)   |
//
// Bedded rock is transversely isotropic: alike in all directions within the bedding (h), other across
// it (v). From the inverse of its three-dimensional compliance, with n = E_h/E_v, Δ = 1 − ν_h − 2 n ν_vh²:
//   C_hh = E_h (1 − n ν_vh²)/((1+ν_h) Δ),  C_hv = E_h ν_vh/Δ,  C_vv = E_v (1 − ν_h)/Δ,  C_66 = G_vh
// (Jaeger, Cook, Zimmerman, Fundamentals of Rock Mechanics, 2007, ch. 5), turned by the bedding angle.
//
// | parameter             | unit | range                     |                                          |
// |-----------------------|------|---------------------------|------------------------------------------|
// | young_modulus         | Pa   | > 0                       | E_h, along the bedding                   |
// | young_modulus_normal  | Pa   | > 0                       | E_v, across it                           |
// | poisson_ratio         | -    | (-1, 1), Δ > 0            | ν_h, from one direction along to another |
// | poisson_ratio_normal  | -    | Δ > 0                     | ν_vh = −ε_h/ε_v under σ_v                |
// | shear_modulus_normal  | Pa   | > 0                       | G_vh, across the bedding                 |
// | bedding_angle         | rad  | any                       | from x to the bedding, anticlockwise     |
//
// Limits: small strains (rock breaks at 1e-4); linear triangles lock as the Poisson ratio nears 0.5.
#pragma once

#include "crackle/core/vec2.hpp"

namespace crackle {

/// Symmetric stiffness matrix [Pa] over (xx, yy, xy) with tensor (not engineering) shear strain
/// entering as 2 e_xy: S_xx = c11 E_xx + c12 E_yy + 2 c16 E_xy, and so on.
struct PlaneStiffness {
  double c11 = 0.0, c12 = 0.0, c22 = 0.0, c16 = 0.0, c26 = 0.0, c66 = 0.0;

  constexpr Sym2 stress(Sym2 e) const {
    return {c11 * e.xx + c12 * e.yy + 2.0 * c16 * e.xy, c12 * e.xx + c22 * e.yy + 2.0 * c26 * e.xy,
            c16 * e.xx + c26 * e.yy + 2.0 * c66 * e.xy};
  }
  /// Strain under a stress: the inverse of stress().
  Sym2 strain(Sym2 stress) const;
  /// Largest eigenvalue of the stiffness over unit strains [Pa]; the time step depends on it.
  double largest() const;
};

/// Isotropic plane strain: λ = Eν/((1+ν)(1−2ν)), μ = E/(2(1+ν)).
PlaneStiffness isotropic_plane_strain(double young_modulus, double poisson_ratio);

struct TransverseIsotropy {
  double young_modulus = 0.0;         ///< along the bedding [Pa]
  double young_modulus_normal = 0.0;  ///< across it [Pa]
  double poisson_ratio = 0.0;
  double poisson_ratio_normal = 0.0;
  double shear_modulus_normal = 0.0;  ///< [Pa]
  double bedding_angle = 0.0;         ///< [rad]
};

/// @throws CaseError where straining would release energy (Δ ≤ 0)
PlaneStiffness transversely_isotropic_plane_strain(const TransverseIsotropy& rock);

/// Stiffness of a material whose axes are turned by an angle [rad].
PlaneStiffness turned(const PlaneStiffness& stiffness, double angle);

/// Stiffness that a compliance [1/Pa] in series, the same for all components of plane stress and strain,
/// makes the one given: the inverse of C⁻¹ − compliance. Cohesive elements on all edges have such a
/// compliance (κ/p_f, artificial_compliance()): triangles made stiffer by it are, with them, as stiff as the
/// rock.
/// @throws CaseError if the compliance is as large as that of the rock itself
PlaneStiffness compensated(const PlaneStiffness& stiffness, double compliance);

/// Speeds of bulk and shear waves [m/s] that run along a unit vector (quasi-P and quasi-S in bedded rock).
struct WaveSpeeds {
  double p = 0.0, s = 0.0;
};
WaveSpeeds wave_speeds(const PlaneStiffness& stiffness, double density, Vec2 direction);

/// The fastest of all directions.
WaveSpeeds wave_speeds(const PlaneStiffness& stiffness, double density);

}  // namespace crackle
