// SPDX-License-Identifier: GPL-3.0-or-later
//
// Stable time step of the explicit loop, from a proven bound on the largest frequency of a triangle
// with its corner masses m = ρA/3:
//   rock      ω_e² ≤ (6 (λ+μ)/ρ) S,  S = [ΣL² + √((ΣL²)² − 48A²)] / (8A²)
//   element   ω_j² = (p_f/2) (1/m_a + 1/m_b);   together  ω² ≤ ω_e² + 2 max_j ω_j²
//   viscosity κ ≤ (3 μᵥ/ρ) S,  ξ = κ/(2ω);       Δt ≤ (2/ω) (√(1+ξ²) − ξ)
// The fluid does not limit the step (its pressure is solved for).
#pragma once

#include <string>

#include "crackle/cohesive/cohesive.hpp"
#include "crackle/solid/bulk.hpp"

namespace crackle {

struct StableStep {
  double limit = 0.0;              ///< largest stable step [s]
  Index triangle = -1;             ///< that limits it
  double without_viscosity = 0.0;  ///< what it would be there without viscosity [s]
  double without_elements = 0.0;   ///< without viscosity and cohesive elements [s]
  /// One line: what limits the step, and where.
  std::string explain(const Mesh& mesh) const;
};

/// @param cohesive nullptr: no cohesive elements
StableStep stable_step(const State& state, const Bulk& bulk, const Cohesive* cohesive);

}  // namespace crackle
