// SPDX-License-Identifier: GPL-3.0-or-later
//
// Fluid of constant bulk modulus (AbuAisha et al. 2016, Eq. 6.7):
//   p = p₀ + K_f ln(m / (V ρ₀)),  ρ dp/dρ = K_f
// (Eq. 6.6 as printed, K_f = −V dp/dρ, is dimensionally wrong.)
//
// | parameter    | unit  | range |
// |--------------|-------|-------|
// | bulk_modulus | Pa    | > 0   |
// | density      | kg/m3 | > 0   | at reference_pressure
// | reference_pressure | Pa | any |
//
// Limits: no vapour, so the pressure may become negative where a sealed cavity is pulled open.
#pragma once

#include <cmath>

namespace crackle {

struct CompressibleFluid {
  double bulk_modulus = 2.2e9;
  double density = 1000.0;
  double reference_pressure = 0.0;

  /// Pressure [Pa] of a mass [kg/m] in a volume [m2].
  double pressure(double mass, double volume) const {
    return reference_pressure + bulk_modulus * std::log(mass / (volume * density));
  }
  /// Mass [kg/m] that fills a volume [m2] at a pressure [Pa].
  double mass(double volume, double pressure) const {
    return volume * density * std::exp((pressure - reference_pressure) / bulk_modulus);
  }
  /// Enthalpy per mass [J/kg], zero at the reference pressure but for p₀/ρ₀: h = p₀/ρ₀ + ∫ dp/ρ.
  double enthalpy(double pressure) const {
    return (reference_pressure - bulk_modulus * std::expm1(-(pressure - reference_pressure) / bulk_modulus)) /
           density;
  }
  /// Energy [J/m] of a mass in a volume: m h − p V; its change is pump work less work on the rock.
  double energy(double mass, double volume, double pressure) const {
    return mass * enthalpy(pressure) - pressure * volume;
  }
};

}  // namespace crackle
