// SPDX-License-Identifier: GPL-3.0-or-later
//
// Mated rough faces of a closing fracture (Willis-Richards et al. 1996; a hyperbola of Bandis et al.
// 1983 with maximum closure V_m = w₀ and initial stiffness k_ni = σ_ref / (9 w₀)):
//   w(σ') = w₀ / (1 + 9 σ'/σ_ref),   t = −(σ_ref / 9) (w₀ / w − 1)  for w < w₀,  0 above
// σ' is the effective compression, t the traction (tension positive). A fresh crack that has never
// been open by w₀ is not pushed open by asperities: w₀ is the smaller of it and the largest opening.
//
// | parameter         | unit | range | meaning                                          |
// |-------------------|------|-------|--------------------------------------------------|
// | residual_aperture | m    | > 0   | w₀: opening without effective stress              |
// | closure_stress    | Pa   | > 0   | σ_ref: effective compression that leaves w₀ / 10  |
#pragma once

#include <algorithm>
#include <cmath>

namespace crackle {

/// A traction [Pa] and its derivative by the opening [Pa/m].
struct TractionSlope {
  double traction = 0.0;
  double slope = 0.0;
};

struct Closure {
  double residual_aperture = 1e-4;
  double closure_stress = 30e6;

  /// Opening [m] under an effective compression [Pa].
  double opening(double compression) const {
    return residual_aperture / (1.0 + 9.0 * std::max(compression, 0.0) / closure_stress);
  }
  /// Traction of faces open by `opening` > 0 that have been open by `max_opening` at most [m].
  TractionSlope traction(double opening, double max_opening) const {
    const double free = std::min(residual_aperture, max_opening);
    if (opening >= free) return {};
    const double scale = closure_stress / 9.0;
    return {-scale * (free / opening - 1.0), scale * free / (opening * opening)};
  }
  /// Energy [J/m2] of asperities pressed together: −∫ t dw from where they touch.
  double energy(double opening, double max_opening) const {
    const double free = std::min(residual_aperture, max_opening);
    if (opening >= free) return 0.0;
    return closure_stress / 9.0 * (free * std::log(free / opening) - (free - opening));
  }
};

/// Tensile strength [Pa] that a mesh of edge length h [m] can resolve at the same fracture energy:
///   f = min(f_t, √(E' G / (m h)))   with m edges in the length E' G / f² (Bažant and Planas 1998, ch. 8)
/// @param modulus E' [Pa] @param fracture_energy G [J/m2] @param edges m
inline double resolved_strength(double tensile_strength, double modulus, double fracture_energy, double edge,
                                double edges) {
  return std::min(tensile_strength, std::sqrt(modulus * fracture_energy / (edges * edge)));
}

}  // namespace crackle
