// SPDX-License-Identifier: GPL-3.0-or-later
//
// What is read off a fall-off. A picker that finds nothing answers with a pick without a value, whose
// method says why.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "crackle/analysis/fall_off.hpp"
#include "crackle/analysis/record.hpp"

namespace crackle {

struct Pick {
  std::string name = {};
  std::string method = {};           ///< how it was found and over what; "none: <why>" without a value
  std::optional<double> value = {};  ///< in `unit`
  std::string text = {};             ///< the value where it is a word (leak_off_type)
  std::string unit = {};             ///< "Pa", "m/s^0.5", "m2", "1"; empty for a word
  std::optional<double> time = {};   ///< on the record's clock [s]
  std::optional<double> uncertainty =
      {};  ///< one standard deviation and what the choice of method adds [unit]
  bool found() const { return value.has_value() || !text.empty(); }
};

/// How a fracture's mean opening follows its net pressure, p_net = S_f w.
enum class Geometry {
  kgd,     ///< plane strain in section: S_f = E' / (π l), A = 2 l H
  pkn,     ///< plane strain across, height H: S_f = 2 E' / (π H), A = 2 l H
  radial,  ///< penny of radius l: S_f = 3 π E' / (16 l), A = π l²
};

/// What a record of pressure does not hold. A picker that needs what is not given answers "none".
struct DfitInputs {
  std::optional<double> young_modulus;  ///< E [Pa]
  std::optional<double> poisson_ratio;  ///< [-]
  Geometry geometry = Geometry::kgd;
  std::optional<double> height;  ///< H [m]
  /// l [m]; of a simulated test, the mean of its half_length_m over the window of pick_isip(): tips go on
  /// after shut-in
  std::optional<double> half_length;
  std::optional<double> fracture_stiffness;     ///< S_f in place of the above [Pa/m]
  std::optional<double> well_storage;           ///< C_w, volume a pressure [m3/Pa]
  std::optional<double> porosity;               ///< [-]
  std::optional<double> total_compressibility;  ///< c_t [1/Pa]
  std::optional<double> viscosity;              ///< of the fluid in the rock [Pa s]
  std::optional<double> reservoir_pressure;     ///< where the record does not show it [Pa]
};

/// Pressure of the instant of shut-in without friction: the line of p over G in the window 1 <= G <=
/// 0.4 G_contact (after the tip's last growth, before it closes; of the last G without a contact; from
/// half of the upper end where that is below 2), extended to G = 0.
Pick pick_isip(const FallOff& f, const Pick& contact);

/// Fracture's faces touch: the stiffness of the fracture rises, and with it -dp/dG, from a minimum
/// (McClure et al. 2016, SPE 179725; 2019, URTeC 123). The end of the minimum: last point before the
/// rise where -dp/dG is not above its least value by more than three standard errors, 5 % of itself or
/// 1 % of the rise, moved to where pressure leaves the line through the points before it, at most by the
/// half window by which the derivative sees ahead.
/// The minimum is sought from a tenth of the rise's G on, and pressure does not come back after the rise:
/// swings of the fluid in the well are no contact. Points where the error of -dp/dG is above a quarter of its
/// mean over the whole fall-off are not asked. None where -dp/dG does not rise by a fifth and eight standard
/// errors, or where pressure falls by less than 2 % of the fall-off meanwhile.
Pick pick_contact(const FallOff& f);

/// Last point where G dp/dG over G is within a fifth of its tangent from the origin (Barree, Barree and Craig
/// 2009, SPE 107877): -dp/dG is largest on the tangent. What leaves it by less is not seen on a plot. Points
/// before the contact, and without one before G = 1 or a quarter of the last G, are not asked. None where
/// -dp/dG ends above 0.8 of its largest value; without a contact also where it is not within a fifth of it
/// while G grows by half. The window of the derivative moves this pick later where pressure bends sharply.
Pick pick_closure_tangent(const FallOff& f, const Pick& contact);
/// The same on √Δt, with √Δt dp/d√Δt.
Pick pick_closure_root(const FallOff& f, const Pick& contact);

/// Carter's C_L from the slope m = -dp/dG in the window of pick_isip():
/// C_L = m / ((π/2) t_p^{1/2} S_f) (1 + C_w S_f / A) (Nolte 1979).
Pick pick_leak_off_coefficient(const FallOff& f, const Pick& contact, const DfitInputs& inputs);

/// Share of the injected volume that is in the fracture at shut-in, if it is closed to nothing at the
/// closure: η = (π/4) G_c / (g(0) + (π/4) G_c) (Nolte 1986), which is G_c / (2 + G_c) for α = 1/2. Closure is
/// the contact, or else the tangent. The uncertainty holds what α between 1/2 and 1 changes.
Pick pick_efficiency(const FallOff& f, const Pick& contact, const Pick& tangent);

/// Slope of the logarithmic derivative over the last half decade, and the flow it means.
struct AfterClosure {
  enum class Flow { none, linear, radial };
  Flow flow = Flow::none;
  double loglog_slope = 0.0;  ///< -1/2: linear, -1: radial
  double slope = 0.0;         ///< dp/dx of the fit, x = Δt^{-1/2} [Pa s^0.5] or Δt^{-1} [Pa s]
  double slope_uncertainty = 0.0;
  double pressure = 0.0;  ///< at x = 0 [Pa]
  double pressure_uncertainty = 0.0;
  double from = 0.0;  ///< first Δt of the fit [s]
  std::string why;    ///< no flow was found
};

/// Pressure of an impulse in the far field: p - p_res ~ Δt^{-1/2} (linear flow) or Δt^{-1} (radial;
/// Gu et al. 1993, SPE 25425; Soliman et al. 2005). The flow is told by the slope
/// of -dp/d ln Δt over the last half decade (-1/2 within 0.1, -1 within 0.15); the line is fitted to the last
/// decade, from twice the closure on.
AfterClosure find_after_closure(const FallOff& f, const Pick& contact, const Pick& tangent);

/// Line of the after-closure flow extended to infinite time.
Pick pick_reservoir_pressure(const FallOff& f, const AfterClosure& flow);

/// Linear: k = µ (V/A)² / (4 π φ c_t s²), s = dp/d(Δt^{-1/2}), V all that was injected (an instantaneous
/// plane source); radial: k = µ V / (4 π H s), s = dp/d(Δt^{-1}) (a line source). Without after-closure
/// flow, but with a reservoir pressure given: from Carter's coefficient, k = π µ (C_L / Δp)² / (φ c_t), Δp
/// the ISIP less the reservoir pressure.
Pick pick_permeability(const FallOff& f, const AfterClosure& flow, const Injection& injection,
                       const DfitInputs& inputs, const Pick& isip, const Pick& leak_off_coefficient);

/// What the fracture does before the contact (else before the tangent), by -dp/dG there (Barree et al. 2009):
/// "normal" (constant), "pressure_dependent" (a hump: falls, then constant), "tip_extension" (falls to the
/// end: G dp/dG is a line above the origin) or "height_recession" (a belly: rises gradually).
Pick pick_leak_off_type(const FallOff& f, const Pick& contact, const Pick& tangent);

/// A whole analysis.
struct DfitAnalysis {
  DfitInputs inputs;  ///< with the half length of a simulated test
  Injection injection;
  FallOff fall_off;
  AfterClosure after_closure;
  std::vector<Pick>
      picks;  ///< isip, contact_compliance, closure_tangent, closure_sqrt_time,
              ///< leak_off_coefficient, efficiency, reservoir_pressure, permeability, leak_off_type
  const Pick& pick(const std::string& name) const;
};

struct DfitSettings {
  std::optional<double> shut_in;    ///< on the record's clock [s]
  std::optional<double> pump_time;  ///< t_p [s]; default: injected volume over last rate
  bool since_breakdown = false;     ///< t_p since the largest pressure instead
  double alpha = 1.0;
  double window = 0.0;  ///< as in FallOffSettings
};

/// @throws CaseError on a record that cannot be analysed
DfitAnalysis analyse_dfit(const PressureRecord& record, const DfitSettings& settings,
                          const DfitInputs& inputs);

}  // namespace crackle
