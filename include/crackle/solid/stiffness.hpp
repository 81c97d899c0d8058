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
  /// Largest eigenvalue of the stiffness over unit strains [Pa]; the time step depends on it.
  double largest() const;
};

/// Isotropic plane strain: λ = Eν/((1+ν)(1−2ν)), μ = E/(2(1+ν)).
PlaneStiffness isotropic_plane_strain(double young_modulus, double poisson_ratio);

/// Bulk and shear wave speeds [m/s] of a material, the faster for an anisotropic one.
struct WaveSpeeds {
  double p = 0.0, s = 0.0;
};
WaveSpeeds wave_speeds(const PlaneStiffness& stiffness, double density);

}  // namespace crackle
