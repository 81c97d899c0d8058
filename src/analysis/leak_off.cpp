// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the fall-off before closure tells: ISIP, Carter's coefficient, efficiency, type of leak-off.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "crackle/analysis/g_function.hpp"
#include "crackle/analysis/picks.hpp"
#include "fracture.hpp"
#include "pick.hpp"

namespace crackle {
namespace {

constexpr double pi = std::numbers::pi;

const char* too_few = "fewer than 6 points of 2 % in time lie in the window of G";

double efficiency_at(double g, double alpha) {
  const double leaked = 0.25 * pi * g;
  return leaked / (g_at_shut_in(alpha) + leaked);
}

/// Mean of -dp/dG over part of a range of G, parts counted from 0.
double mean_rate(const FallOff& f, double from, double to, int part, int parts) {
  const double width = (to - from) / parts;
  const auto [first, end] = points_between(f.g, from + part * width, from + (part + 1) * width);
  double sum = 0.0, count = 0.0;
  for (std::size_t i = std::max<std::size_t>(1, first); i < std::min(end, f.size() - 1); ++i) {
    sum += f.by_g.value[i];
    count += 1.0;
  }
  return count > 0.0 ? sum / count : 0.0;
}

/// The word for three means of -dp/dG, early to late.
std::string type_of(double early, double middle, double late) {
  constexpr double same = 0.15;
  const double a = early / late - 1.0, b = middle / late - 1.0;
  if (std::abs(a) <= same && std::abs(b) <= same) return "normal";
  if (a < 0.0) return "height_recession";
  // of G dp/dG = a + b G, a line above the origin, middle - late is a fifth of early - late
  return std::abs(b) <= 0.1 * a ? "pressure_dependent" : "tip_extension";
}

}  // namespace

Pick pick_isip(const FallOff& f, const Pick& contact) {
  const auto early = early_line(f, contact);
  if (!early) return none("isip", "Pa", too_few);
  Pick pick{.name = "isip", .unit = "Pa"};
  pick.value = early->intercept;
  pick.time = f.shut_in;
  pick.uncertainty = early->intercept_uncertainty;
  pick.method =
      fmt::format("line of p over G, {:.3g} <= G <= {:.3g}, extended to G = 0", early->from, early->to);
  return pick;
}

Pick pick_leak_off_coefficient(const FallOff& f, const Pick& contact, const DfitInputs& inputs) {
  const std::string name = "leak_off_coefficient", unit = "m/s^0.5";
  const FractureInputs fracture = fracture_of(inputs);
  if (!fracture.stiffness) return none(name, unit, fracture.why_no_stiffness);
  const auto early = early_line(f, contact);
  if (!early) return none(name, unit, too_few);
  double storage = 0.0;  // of the well as a share of the fracture's
  if (inputs.well_storage) {
    if (!fracture.area) return none(name, unit, "well_storage is given, but " + fracture.why_no_area);
    storage = *inputs.well_storage * *fracture.stiffness / *fracture.area;
  }
  const double per_slope = (1.0 + storage) / (0.5 * pi * std::sqrt(f.pump_time) * *fracture.stiffness);
  if (early->line.slope >= 0.0) return none(name, unit, "pressure does not fall over the window of G");
  Pick pick{.name = name, .unit = unit};
  pick.value = -early->line.slope * per_slope;
  pick.time = f.shut_in + f.elapsed[points_between(f.g, early->from, early->to).second - 1];
  pick.uncertainty = early->slope_uncertainty * per_slope;
  pick.method = fmt::format(
      "slope of p over G, {:.4g} Pa over {:.3g} <= G <= {:.3g}; t_p = {:.6g} s, S_f = {:.4g} Pa/m ({}), well "
      "storage {:.2g} of the fracture's",
      -early->line.slope, early->from, early->to, f.pump_time, *fracture.stiffness, fracture.stiffness_from,
      storage);
  return pick;
}

Pick pick_efficiency(const FallOff& f, const Pick& contact, const Pick& tangent) {
  const Pick& closure = contact.found() ? contact : tangent;
  if (!closure.found()) return none("efficiency", "1", "there is no closure");
  const double elapsed = *closure.time - f.shut_in;
  const double g = g_function(elapsed, f.pump_time, f.alpha);
  const auto bound = [&](double alpha) {
    return efficiency_at(g_function(elapsed, f.pump_time, alpha), alpha);
  };
  Pick pick{.name = "efficiency", .unit = "1"};
  pick.value = efficiency_at(g, f.alpha);
  pick.time = closure.time;
  const double ahead = g_function(elapsed * std::pow(10.0, 0.5 * f.window), f.pump_time, f.alpha);
  pick.uncertainty = std::hypot(0.5 * (bound(1.0) - bound(0.5)), efficiency_at(ahead, f.alpha) - *pick.value);
  pick.method = fmt::format("(pi/4) G_c / (g(0) + (pi/4) G_c) at {}, G_c = {:.4g}, alpha = {:g}",
                            closure.name, g, f.alpha);
  return pick;
}

Pick pick_leak_off_type(const FallOff& f, const Pick& contact, const Pick& tangent) {
  const Pick& closure = contact.found() ? contact : tangent;
  if (!closure.found()) return none("leak_off_type", "", "there is no closure");
  const double end = 0.9 * f.g[point_at(f, *closure.time - f.shut_in)], start = 0.1 * end;
  const double early = mean_rate(f, start, end, 0, 3), middle = mean_rate(f, start, end, 1, 3),
               late = mean_rate(f, start, end, 2, 3);
  if (late <= 0.0) return none("leak_off_type", "", "pressure does not fall before closure");
  Pick pick{.name = "leak_off_type"};
  pick.text = type_of(early, middle, late);
  pick.time = closure.time;
  // a stiffening that takes longer than all of the fall-off before it is no contact of the whole face
  const bool gradual =
      contact.found() && tangent.found() &&
      f.g[point_at(f, *tangent.time - f.shut_in)] > 2.5 * f.g[point_at(f, *contact.time - f.shut_in)];
  if (gradual) pick.text = "height_recession";
  pick.method =
      fmt::format("-dp/dG in the thirds of {:.3g} <= G <= {:.3g} before {}: {:.4g}, {:.4g}, {:.4g} Pa{}",
                  start, end, closure.name, early, middle, late,
                  gradual ? "; from contact to tangent G grows more than 2.5 times" : "");
  return pick;
}

}  // namespace crackle
