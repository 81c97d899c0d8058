// SPDX-License-Identifier: GPL-3.0-or-later
//
// Laminar flow between the faces of a fracture (cubic law; Witherspoon et al. 1980) and the fluid's
// density in a cell of it:
//   q = −(w³ / 12 μ) ∂p/∂s                                   [m2/s] per metre of thickness
//   q F = that, F = max(1, (c Re₀^¾)^{4/7}), c = 0.316/96       turbulent: Blasius' f = 0.316 Re^-¼ over
//         96/Re between plates, with Re = 2 ρ₀ |q|/μ and Re₀ that of the laminar flow (Re = Re₀/F)
//   ρ/ρ₀ = 1 + c_f (p − p_ref)                p ≥ p_cav
//   ρ/ρ₀ = (1 + c_f (p_cav − p_ref)) exp((p − p_cav)/p_soft)   below: vapour, the cell empties
// At a vertex the aperture is the mean of its cells (edges): the one of the vertex itself would choke
// the flow to the tip, where it goes to zero.
//
// | parameter           | unit | range | meaning                                           |
// |---------------------|------|-------|---------------------------------------------------|
// | viscosity           | Pa s | > 0   | μ                                                 |
// | compressibility     | 1/Pa | > 0   | c_f                                               |
// | reference_pressure  | Pa   | any   | p_ref, where the density is ρ₀                    |
// | cavitation_pressure | Pa   | any   | p_cav; at least 1 MPa from the initial pressure   |
// | reference_density   | kg/m3| >= 0  | ρ₀; 0: all flow is laminar                        |
// | smallest_aperture   | m    | > 0   | floor of w in the conductivity only               |
#pragma once

#include <algorithm>
#include <cmath>

namespace crackle {

/// A value and its derivative by the one variable it depends on.
struct ValueSlope {
  double value = 0.0;
  double slope = 0.0;
};

struct FractureFluid {
  double viscosity = 1e-3;
  double compressibility = 4.5e-10;
  double reference_pressure = 0.0;
  double cavitation_pressure = -10e6;
  double cavitation_range = 1e6;  ///< p_soft [Pa]
  double smallest_aperture = 1e-6;
  double reference_density = 0.0;

  /// A flow [m2/s] with turbulence, and its derivative by the laminar flow that the same pressures would
  /// drive.
  ValueSlope flow(double laminar) const {
    const double reynolds = 2.0 * reference_density * std::abs(laminar) / viscosity;
    const double f = std::pow(0.316 / 96.0 * std::pow(reynolds, 0.75), 4.0 / 7.0);
    if (f <= 1.0) return {laminar, 1.0};
    return {laminar / f, 4.0 / (7.0 * f)};
  }
  /// w³/(12 μ) [m3/(Pa s)], by the aperture [m].
  ValueSlope conductivity(double aperture) const {
    if (aperture <= smallest_aperture)
      return {smallest_aperture * smallest_aperture * smallest_aperture / (12.0 * viscosity), 0.0};
    const double w2 = aperture * aperture;
    return {w2 * aperture / (12.0 * viscosity), w2 / (4.0 * viscosity)};
  }
  /// ∫ dp ρ₀/ρ from p_ref [Pa]: work that a unit of mass (volume at ρ₀) takes along.
  double enthalpy(double pressure) const {
    const double liquid = std::max(pressure, cavitation_pressure);
    const double h = std::log1p(compressibility * (liquid - reference_pressure)) / compressibility;
    if (pressure >= cavitation_pressure) return h;
    return h - cavitation_range / density(cavitation_pressure).value *
                   std::expm1((cavitation_pressure - pressure) / cavitation_range);
  }
  /// ρ/ρ₀ [-], by the pressure [Pa].
  ValueSlope density(double pressure) const {
    if (pressure >= cavitation_pressure)
      return {1.0 + compressibility * (pressure - reference_pressure), compressibility};
    const double at_cavitation = 1.0 + compressibility * (cavitation_pressure - reference_pressure);
    const double value = at_cavitation * std::exp((pressure - cavitation_pressure) / cavitation_range);
    return {value, value / cavitation_range};
  }
};

}  // namespace crackle
