// SPDX-License-Identifier: GPL-3.0-or-later
//
// Stable time step of the explicit loop, from proven bounds. By triangles, each with its own corner
// masses m = ρA/3:
//   rock      ω_e² ≤ (6 (λ+μ)/ρ) S,  S = [ΣL² + √((ΣL²)² − 48A²)] / (8A²)
//   element   ω_j² = (p_f/2) (1/m_a + 1/m_b);   together  ω² ≤ ω_e² + 2 max_j ω_j²
//   viscosity κ ≤ (3 μᵥ/ρ) S,  ξ = κ/(2ω);       Δt ≤ (2/ω) (√(1+ξ²) − ξ)
// and by nodes, which corners may share (Gershgorin by 2 x 2 blocks): R and V the sums of the norms of
// the stiffness and viscosity blocks in the node's row, p_f of every element at it:
//   Δt²/4 (R + Σ p_f) + Δt/2 V ≤ m
// The larger of the two holds. The fluid does not limit the step (its pressure is solved for). These bounds
// may be 1.1 to 2.2 times too short; sharpened() of lanczos.hpp finds the highest frequency itself.
#pragma once

#include <string>

#include "crackle/cohesive/cohesive.hpp"
#include "crackle/solid/bulk.hpp"

namespace crackle {

struct StableStep {
  double limit = 0.0;   ///< largest stable step [s]
  double proven = 0.0;  ///< by the bounds above [s]
  double margin = 0.0;  ///< of the highest frequency squared that gave the limit; 0: the bounds gave it
  Index triangle = -1;  ///< that limits the proven one
  double without_viscosity = 0.0;  ///< what it would be there without viscosity [s]
  double without_elements = 0.0;   ///< without viscosity and cohesive elements [s]
  /// One line: what limits the step, and where.
  std::string explain(const Mesh& mesh) const;
};

/// Stable step of one node [s], by its row.
double node_step(const State& state, const Bulk& bulk, const Cohesive* cohesive, Index node);

/// Mass [kg/m] with which the stable step of a node, by its row, is a given one [s].
double mass_of_step(const State& state, const Bulk& bulk, const Cohesive* cohesive, Index node, double step);

/// Largest penalty [Pa] with which an element may be inserted on an edge so that a corner that it cuts
/// loose, with another such element on its other side, allows a step [s]; may be negative.
double penalty_below(const State& state, const Bulk& bulk, Index edge, double step);

/// @param cohesive nullptr: no cohesive elements
StableStep stable_step(const State& state, const Bulk& bulk, const Cohesive* cohesive);

}  // namespace crackle
