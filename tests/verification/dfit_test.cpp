// SPDX-License-Identifier: GPL-3.0-or-later
//
// The picks of `dfit-analyse` on a fall-off that is computed from the physics they assume: one fracture, its
// fluid's volume in balance with diffusion into the rock, faces that touch.
//
//   A (w(p_0) - w(p)) + C_w (p_0 - p) = V(t) - V(t_p)
//   open, p >= S_h     w = w_0 + (p - S_h) / S_f
//   touching           w = w_0 / (1 + 9 (S_h - p) / σ_ref)            (Willis-Richards et al. 1996)
//   into both faces    V = 2 A 2 (k φ c_t / (π µ))^{1/2} [ (p_0 - p_r) <√(t - τ)> + Σ (dp/ds) ∫ √(t - s) ds ]
//
// (superposition of Carlslaw and Jaeger's half space; <> over the exposures τ of an area that grew linearly
// at constant pressure p_0, which is Nolte's g).
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "../unit/analysis/records.hpp"
#include "crackle/analysis/g_function.hpp"

namespace crackle_test {
namespace {

constexpr double pi = std::numbers::pi;

struct Teaching {
  double closure = 44.28e6, reservoir = 34.84e6, isip = 44.50e6;  // [Pa]
  double modulus = 42.5e9, poisson = 0.17;                        // [Pa], [-]
  double half_length = 40.0, height = 50.0;                       // [m]
  double pump_time = 240.0;                                       // [s]
  double permeability = 2.35e-20, porosity = 0.05, compressibility = 1.5e-8, viscosity = 2e-5;
  double touching_width = 100e-6, touching_stress = 30e6;  // w_0 [m], σ_ref [Pa]
  double well_storage = 1.35e-8;                           // [m3/Pa]
  double end = 1e6;                                        // [s]

  double area() const { return 2.0 * half_length * height; }
  double stiffness() const { return modulus / (1.0 - poisson * poisson) / (pi * half_length); }
  double diffusion() const { return std::sqrt(permeability * porosity * compressibility / (pi * viscosity)); }
  /// Carter's coefficient at the ISIP [m/s^0.5].
  double leak_off_coefficient() const { return diffusion() * (isip - reservoir); }
  double width(double p) const {
    if (p >= closure) return touching_width + (p - closure) / stiffness();
    return touching_width / (1.0 + 9.0 * (closure - p) / touching_stress);
  }
  double leaked_while_pumping() const {
    return 2.0 * area() * leak_off_coefficient() * std::sqrt(pump_time) * crackle::g_at_shut_in(1.0);
  }
  double efficiency() const {
    const double stored = area() * width(isip);
    return stored / (stored + leaked_while_pumping());
  }
};

/// Pressures at times after shut-in, one implicit step each.
std::vector<double> fall_off(const Teaching& t, const std::vector<double>& times) {
  std::vector<double> p{t.isip}, at{0.0};
  const auto ramp = [&](double now, std::size_t j, double to) {
    // ∫ √(now - s) ds over a step, times the rate of pressure in it
    return (to - p[j]) / (at[j + 1] - at[j]) * 2.0 / 3.0 *
           (std::pow(now - at[j], 1.5) - std::pow(now - at[j + 1], 1.5));
  };
  for (const double now : times) {
    at.push_back(now);
    const double g = 0.25 * pi * crackle::g_function(now, t.pump_time, 1.0);
    double history = 0.0;
    for (std::size_t j = 0; j + 1 < p.size(); ++j) history += ramp(now, j, p[j + 1]);
    const auto excess = [&](double q) {  // leaked less given back; rises with q
      const double leaked = 2.0 * t.area() * t.leak_off_coefficient() * std::sqrt(t.pump_time) * g +
                            4.0 * t.area() * t.diffusion() * (history + ramp(now, p.size() - 1, q));
      return leaked - t.area() * (t.width(t.isip) - t.width(q)) - t.well_storage * (t.isip - q);
    };
    double low = t.reservoir - 1e6, high = p.back();
    for (int i = 0; i < 60; ++i) {
      const double middle = 0.5 * (low + high);
      (excess(middle) < 0.0 ? low : high) = middle;
    }
    p.push_back(0.5 * (low + high));
  }
  p.erase(p.begin());
  return p;
}

crackle::PressureRecord record_of(const Teaching& t) {
  crackle::PressureRecord record;
  const auto add = [&](double time, double pressure, double rate) {
    record.time.push_back(time);
    record.pressure.push_back(pressure);
    record.rate.push_back(rate);
  };
  const double rate = (t.area() * t.width(t.isip) + t.leaked_while_pumping()) / t.pump_time;
  for (int i = 0; i < 240; ++i) add(t.pump_time * i / 240.0, t.isip + 0.08e6, rate);
  add(t.pump_time, t.isip, 0.0);
  const std::vector<double> times = sampling(1.0, 0.015, t.end);
  const std::vector<double> pressures = fall_off(t, times);
  for (std::size_t i = 0; i < times.size(); ++i) add(t.pump_time + times[i], pressures[i], 0.0);
  return record;
}

crackle::DfitInputs inputs_of(const Teaching& t) {
  crackle::DfitInputs inputs;
  inputs.young_modulus = t.modulus;
  inputs.poisson_ratio = t.poisson;
  inputs.half_length = t.half_length;
  inputs.height = t.height;
  inputs.well_storage = t.well_storage;
  inputs.porosity = t.porosity;
  inputs.total_compressibility = t.compressibility;
  inputs.viscosity = t.viscosity;
  return inputs;
}

struct Found {
  double isip, contact, tangent, carter, efficiency, reservoir, permeability;
};

Found analyse(const Teaching& t, const crackle::PressureRecord& record) {
  const auto a = crackle::analyse_dfit(record, {}, inputs_of(t));
  const auto value = [&](const char* name) { return a.pick(name).value.value_or(std::nan("")); };
  return {value("isip"),
          value("contact_compliance"),
          value("closure_tangent"),
          value("leak_off_coefficient"),
          value("efficiency"),
          value("reservoir_pressure"),
          value("permeability")};
}

void print(const char* name, const Teaching& t, const Found& f) {
  std::printf(
      "%-28s ISIP %+6.1f kPa, contact %+6.1f kPa, tangent %+7.1f kPa, C_L %+5.1f %%, efficiency %+.3f, "
      "p_res %+6.1f kPa, k %+5.1f %%\n",
      name, 1e-3 * (f.isip - t.isip), 1e-3 * (f.contact - t.closure), 1e-3 * (f.tangent - t.closure),
      100.0 * (f.carter / t.leak_off_coefficient() - 1.0), f.efficiency - t.efficiency(),
      1e-3 * (f.reservoir - t.reservoir), 100.0 * (f.permeability / t.permeability - 1.0));
}

void expect_truth(const Teaching& t, const Found& f, double contact_bound) {
  EXPECT_NEAR(f.isip, t.isip, 0.03e6);
  EXPECT_NEAR(f.contact, t.closure, contact_bound);
  EXPECT_NEAR(f.carter / t.leak_off_coefficient(), 1.0, 0.08);
  EXPECT_NEAR(f.reservoir, t.reservoir, 0.05e6);
  EXPECT_NEAR(f.efficiency, t.efficiency(), 0.08);  // the residual opening counts as leaked
  EXPECT_LT(f.tangent, t.closure);
}

TEST(DfitTeaching, PicksAndTruth) {
  const Teaching reference;
  Teaching rough, smooth, stiff_well, leaky;
  smooth.touching_width = 30e-6;
  rough.touching_width = 300e-6;
  stiff_well.well_storage = 1e-12;
  leaky.permeability *= 9.0;
  for (const auto& [name, t] :
       {std::pair{"w_0 = 100 um", reference}, std::pair{"w_0 = 30 um", smooth},
        std::pair{"w_0 = 300 um", rough}, std::pair{"no storage in the well", stiff_well},
        std::pair{"three times the leak-off", leaky}}) {
    const auto record = record_of(t);
    const Found quiet = analyse(t, record);
    print(name, t, quiet);
    expect_truth(t, quiet, 30e3);
    // what is left in the fracture is missing in the rock, and in V/A squared
    EXPECT_NEAR(quiet.permeability / t.permeability, 1.0, 0.25);
    for (const auto& [noise, bound] : {std::pair{1e3, 30e3}, std::pair{5e3, 60e3}}) {
      const Found noisy = analyse(t, with_noise(record, noise, 7));
      print(noise > 2e3 ? "  with 5 kPa of noise" : "  with 1 kPa of noise", t, noisy);
      expect_truth(t, noisy, bound);
    }
  }
}

}  // namespace
}  // namespace crackle_test
