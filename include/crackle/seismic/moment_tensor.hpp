// SPDX-License-Identifier: GPL-3.0-or-later
//
// Moment tensor of a displacement jump u across a face of area A and normal n in isotropic rock
// (Aki & Richards 2002, Eq. 3.21):
//   M_ij = A [λ u_k n_k δ_ij + μ (u_i n_j + u_j n_i)]
// In plane strain u and n lie in the plane, so that M_xz = M_yz = 0 and M_zz = A λ u·n.
//
// Scalar moment and magnitude (Silver & Jordan 1982; Hanks & Kanamori 1979, as IASPEI 2013 writes it):
//   M0 = √(Σ M_ij² / 2)    Mw = 2/3 (log10 M0 − 9.1),  M0 in N m
//
// Parts by the eigenvalues M1 ≥ M2 ≥ M3 (Vavryčuk 2015, J. Seismol. 19, 231-252):
//   M_iso = (M1 + M2 + M3)/3    M_clvd = 2/3 (M1 + M3 − 2 M2)
//   M_dc = ½ (M1 − M3 − |M1 + M3 − 2 M2|)    M = |M_iso| + |M_clvd| + M_dc
// as shares of M. A tensile crack has iso = (λ + 2μ/3)/(λ + 2μ), clvd = (4μ/3)/(λ + 2μ), dc = 0.
//
// Moments are per metre of thickness, as every extensive quantity of a 2D model. Limits: of bedded rock the
// run takes λ = c12 and μ = c66 of its plane-strain stiffness, as if it were isotropic.
#pragma once

#include "crackle/core/vec2.hpp"

namespace crackle {

/// Lamé's constants of isotropic rock [Pa].
struct Lame {
  double lambda = 0.0;
  double shear_modulus = 0.0;  ///< μ
};

/// The components of a moment tensor that plane strain leaves, per metre of thickness [N m/m].
struct MomentTensor {
  double xx = 0.0, yy = 0.0, zz = 0.0, xy = 0.0;

  constexpr MomentTensor& operator+=(const MomentTensor& b) {
    xx += b.xx, yy += b.yy, zz += b.zz, xy += b.xy;
    return *this;
  }
  friend constexpr bool operator==(const MomentTensor&, const MomentTensor&) = default;
};

/// Moment of a jump [m] of face b against face a, over a length [m] along an edge.
/// @param direction along the edge with face a to its left; any length but zero
/// @param opening, slip of b against a: along the outward normal of a, and along the direction
MomentTensor moment_of_jump(const Lame& rock, Vec2 direction, double length, double opening, double slip);

/// M0 per metre of thickness [N m/m].
double scalar_moment(const MomentTensor& m);

/// Mw of a scalar moment [N m]. Moments below 1e-6 N m count as that.
double moment_magnitude(double moment);

/// Shares of a moment tensor: |iso| + |clvd| + dc = 1; all zero for a tensor of zeros.
struct MomentShares {
  double iso = 0.0;   ///< > 0: the source grows in volume
  double clvd = 0.0;  ///< > 0: tensile
  double dc = 0.0;    ///< double couple, >= 0
};
MomentShares moment_shares(const MomentTensor& m);

/// How a source moves: by its tensile angle, atan(opening / |slip|).
enum class SourceType { tensile, shear, mixed, closing };
const char* to_string(SourceType type);
/// Tensile from 60° up, shear within 30°, closing below -30°, mixed between.
/// @param opening, slip in the same unit [m], or both times an area
SourceType source_type(double opening, double slip);

}  // namespace crackle
