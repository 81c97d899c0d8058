// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>

namespace crackle {

/// Coulomb friction in series with an elastic tangential spring,
///   τ = k (s − sₚ),  |τ| ≤ τ_max,
/// where sₚ is the plastic slip: the only history. Both broken faces that still match and general
/// contact use it. Units: stiffness [Pa/m] with slip [m] and strength [Pa] (or [N/m²] per pair).
/// @return the traction; `plastic_slip` is moved so that the law holds.
inline double coulomb_traction(double stiffness, double slip, double strength, double& plastic_slip) {
  const double trial = stiffness * (slip - plastic_slip);
  const double traction = std::clamp(trial, -strength, strength);
  if (traction != trial) plastic_slip = slip - traction / stiffness;
  return traction;
}

}  // namespace crackle
