// SPDX-License-Identifier: GPL-3.0-or-later
//
// Highest frequency of the rock with its cohesive elements by the method of Lanczos (1950): largest
// eigenvalue of K x = ω² M x from a few products with K, nothing assembled. It comes from below, within
// 1e-3 after 40 products on meshes of this kind, where the bounds of time_step.hpp may lie a factor of
// two above. Every element counts as intact or closed; fluid and general contact are not in it.
//   Δt ≤ (2/ω) (√(1+ξ²) − ξ),  ξ = κ/(2ω),  κ the largest eigenvalue of C x = κ M x (viscosity)
#pragma once

#include "crackle/cohesive/cohesive.hpp"
#include "crackle/solid/bulk.hpp"

namespace crackle {

struct HighestFrequency {
  double frequency = 0.0;     ///< ω [1/s]
  double residual = 0.0;      ///< |K x − ω² M x| over ω²: an eigenvalue is that near to ω² [-]
  double viscous_rate = 0.0;  ///< κ [1/s]

  /// Stable step [s]; infinity if nothing can move.
  double stable_step() const;
};

/// @param cohesive nullptr: no cohesive elements
/// @param products with the stiffness; the start vector is always the same
HighestFrequency highest_frequency(const State& state, const Bulk& bulk, const Cohesive* cohesive,
                                   int products = 40);

}  // namespace crackle
