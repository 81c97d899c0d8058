// SPDX-License-Identifier: GPL-3.0-or-later
//
// Magnitudes and their number: log10 N(≥ M) = a − b M (Gutenberg & Richter 1944).
//
//   b = log10 e / (mean M − (Mc − ΔM/2))         Aki (1965), bin correction by Utsu (1966)
//   σ_Aki = b / √N
//   σ_SB = 2.30 b² √( Σ (M − mean M)² / (N (N − 1)) )       Shi & Bolt (1982)
//   Mc: middle of the bin that holds most events             maximum curvature, Wiemer & Wyss (2000)
//
// | symbol | parameter    | unit | meaning                                             |
// |--------|--------------|------|-----------------------------------------------------|
// | Mc     | completeness | -    | middle of the lowest bin in which all events are    |
// | ΔM     | bin          | -    | width of the bins; 0: magnitudes are not rounded    |
//
// The sample is every M ≥ Mc − ΔM/2. Limits: maximum curvature is too low by 0.1 to 0.2 where detection
// fades gradually (Woessner & Wiemer 2005); in a simulation nothing goes undetected, so that the fall
// below Mc is that of the mesh: no event is smaller than an edge.
#pragma once

#include <span>

namespace crackle {

struct BValue {
  double b = 0.0;               ///< NaN with fewer than two events, or all of one magnitude
  double sigma_aki = 0.0;       ///< standard deviation
  double sigma_shi_bolt = 0.0;  ///< standard deviation
  double completeness = 0.0;    ///< Mc
  int events = 0;               ///< at or above it
};

/// @param bin > 0 for magnitudes that are rounded to it, 0 for continuous ones
BValue b_value(std::span<const double> magnitudes, double completeness, double bin);

/// Mc by maximum curvature; NaN without events. @param bin > 0
double maximum_curvature(std::span<const double> magnitudes, double bin);

}  // namespace crackle
