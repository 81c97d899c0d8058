// SPDX-License-Identifier: GPL-3.0-or-later
//
// Highest frequency of the rock with its cohesive elements by the method of Lanczos (1950): largest
// eigenvalue of K x = ω² M x from a few products with K, nothing assembled. It comes from below, within
// 1e-3 after 40 products on meshes of this kind, where the bounds of time_step.hpp may lie a factor of
// two above. Every element counts as intact or closed; fluid and general contact are not in it.
//   Δt ≤ (2/ω) (√(1+ξ²) − ξ),  ξ = κ/(2ω),  κ the largest eigenvalue of C x = κ M x (viscosity)
// How far below it may be is bounded too (Kuczynski and Wozniakowski 1992, Theorem 3.2): after k products
// from a random start the largest of n eigenvalues, none negative, is missed by more than a share e with a
// probability of at most 1.648 √n exp(−√e (2k − 1)); `margin` is the e of 1e-9, whatever the eigenvalues are.
#pragma once

#include "crackle/cohesive/cohesive.hpp"
#include "crackle/solid/bulk.hpp"
#include "crackle/solve/time_step.hpp"

namespace crackle {

struct HighestFrequency {
  double frequency = 0.0;     ///< ω [1/s]
  double residual = 0.0;      ///< |K x − ω² M x| over ω²: an eigenvalue is that near to ω² [-]
  double viscous_rate = 0.0;  ///< κ [1/s]
  double margin = 0.0;  ///< by which ω² and κ may be too low, as a share of them [-]; 1: nothing is known

  /// Stable step [s]; infinity if nothing can move.
  double stable_step() const;
  /// The same with ω² and κ raised by the margin: not too long. 0 where nothing is known.
  double safe_step() const;
};

/// @param cohesive nullptr: no cohesive elements
/// @param products with the stiffness; the start vector is always the same
HighestFrequency highest_frequency(const State& state, const Bulk& bulk, const Cohesive* cohesive,
                                   int products = 40);

/// The larger of a proven step and, with 80 products, the safe one of the highest frequency.
StableStep sharpened(const StableStep& proven, const State& state, const Bulk& bulk,
                     const Cohesive* cohesive);

}  // namespace crackle
