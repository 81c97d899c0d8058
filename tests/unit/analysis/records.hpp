// SPDX-License-Identifier: GPL-3.0-or-later
//
// Records of pump-ins whose truth is known.
#pragma once

#include <cstdint>
#include <vector>

#include "crackle/analysis/picks.hpp"

namespace crackle_test {

/// Closed form: a fracture of constant stiffness that leaks by Carter's law (Nolte 1979), then closes at
/// once, and decays towards the reservoir's pressure:
///   pumping       p = isip + friction
///   to closure    p = isip - (π/2) C_L t_p^{1/2} S_f G(Δt)
///   afterwards    p = p_res + (p_c - p_res) (s / (Δt - Δt_c + s))^n,  n = 1/2 (linear flow) or 1 (radial)
/// where s is such that -dp/dG rises `stiffening` times at closure.
struct CarterTest {
  double pump_time = 300.0;                             // [s]
  double rate = 0.01;                                   // [m3/s]
  double isip = 45.0e6;                                 // [Pa]
  double friction = 1.0e6;                              // while pumping [Pa]
  double closure = 44.0e6;                              // below all pressures: never [Pa]
  double reservoir = 35.0e6;                            // [Pa]
  double young_modulus = 42.5e9, poisson_ratio = 0.17;  // [Pa], [-]
  double half_length = 10.0, height = 20.0;             // [m]
  double leak_off_coefficient = 2e-6;                   // [m/s^0.5]
  double stiffening = 10.0;
  double exponent = 0.5;
  double alpha = 1.0;
  double end = 1e6;  // of the fall-off [s]

  double stiffness() const;               ///< S_f of kgd [Pa/m]
  double fall_per_g() const;              ///< -dp/dG before closure [Pa]
  double closure_g() const;               ///< G at closure
  double closure_elapsed() const;         ///< [s]
  double pressure(double elapsed) const;  ///< after shut-in [Pa]
  crackle::DfitInputs inputs() const;
};

/// Times after shut-in [s]: at first every `step` seconds, later every `share` of the time.
std::vector<double> sampling(double step, double share, double end);

crackle::PressureRecord record_of(const CarterTest& test, const std::vector<double>& elapsed);

/// The synthetic test of a simulated fracture with matrix diffusion and contact (half length 40 m at shut-in,
/// E = 42.5 GPa, nu = 0.17, S_h = 44.28 MPa, p_res = 34.84 MPa, C_L = 5e-6 m/s^0.5 equivalent): its published
/// points of p and dp/d ln Δt, between them cubics in ln Δt, sampled every 2 % of time. t_p = 207 s since
/// breakdown, 240 s of pumping.
crackle::PressureRecord simulated_record();
crackle::DfitInputs simulated_inputs();
crackle::DfitSettings simulated_settings();

/// Adds normally distributed noise [Pa], the same for a seed everywhere.
crackle::PressureRecord with_noise(crackle::PressureRecord record, double deviation, std::uint32_t seed);

}  // namespace crackle_test
