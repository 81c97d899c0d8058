// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the fall-off after closure tells: reservoir pressure and permeability.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "crackle/analysis/picks.hpp"
#include "fracture.hpp"
#include "pick.hpp"

namespace crackle {
namespace {

constexpr double pi = std::numbers::pi;
using Flow = AfterClosure::Flow;

/// Slope of ln(-dp/d ln Δt) over ln Δt from a point on; none where the derivative is not above noise.
std::optional<double> loglog_slope(const FallOff& f, std::size_t first) {
  std::vector<double> x, y;
  for (std::size_t i = std::max<std::size_t>(1, first); i + 1 < f.size(); ++i) {
    if (f.by_log.value[i] <= 2.0 * f.by_log.error[i]) continue;
    x.push_back(std::log(f.elapsed[i]));
    y.push_back(std::log(f.by_log.value[i]));
  }
  constexpr std::size_t fewest = 5;
  if (x.size() < fewest || 5 * x.size() < 4 * (f.size() - 1 - first)) return {};
  return fit_line(x, y, 0.0).slope;
}

Flow flow_of(double slope) {
  if (std::abs(slope + 0.5) <= 0.1) return Flow::linear;
  if (std::abs(slope + 1.0) <= 0.15) return Flow::radial;
  return Flow::none;
}

const char* abscissa(Flow flow) { return flow == Flow::linear ? "dt^-1/2" : "dt^-1"; }

void fit_flow(const FallOff& f, std::size_t first, AfterClosure& found) {
  std::vector<double> x, p;
  for (std::size_t i = first; i < f.size(); ++i) {
    x.push_back(found.flow == Flow::linear ? 1.0 / f.root[i] : 1.0 / f.elapsed[i]);
    p.push_back(f.pressure[i]);
  }
  const std::size_t half = x.size() / 2;
  const std::span xs(x), ps(p);
  const double noise = f.point_error(first);
  const Line line = fit_line(x, p, noise), early = fit_line(xs.first(half), ps.first(half), noise),
             late = fit_line(xs.subspan(half), ps.subspan(half), noise);
  found.slope = line.slope;
  found.slope_uncertainty = std::hypot(2.0 * line.slope_error(), 0.5 * (late.slope - early.slope));
  found.pressure = line.at(0.0);
  found.pressure_uncertainty = std::hypot(2.0 * line.error_at(0.0), 0.5 * (late.at(0.0) - early.at(0.0)));
  found.from = f.elapsed[first];
}

Pick make_permeability(double k, double relative_uncertainty, double time, const std::string& method) {
  Pick pick{.name = "permeability", .unit = "m2"};
  pick.value = k;
  pick.time = time;
  pick.uncertainty = k * relative_uncertainty;
  pick.method = method;
  return pick;
}

}  // namespace

AfterClosure find_after_closure(const FallOff& f, const Pick& contact, const Pick& tangent) {
  AfterClosure found;
  double closed = 0.0;
  for (const Pick* pick : {&contact, &tangent}) {
    if (pick->found()) closed = std::max(closed, *pick->time - f.shut_in);
  }
  const double end = f.elapsed.back();
  const double last_half = end / std::sqrt(10.0);
  if (last_half < 2.0 * closed) {
    found.why =
        fmt::format("the record ends {:.3g} times after closure; it takes 6.4 to see the flow", end / closed);
    return found;
  }
  const auto slope = loglog_slope(f, point_at(f, last_half));
  if (!slope) {
    found.why = "the derivative over the last half decade is within noise";
    return found;
  }
  found.loglog_slope = *slope;
  found.flow = flow_of(*slope);
  if (found.flow == Flow::none) {
    found.why = fmt::format(
        "the logarithmic derivative has the slope {:.3f} over the last half decade; -0.5 is linear flow, -1 "
        "radial",
        *slope);
    return found;
  }
  fit_flow(f, point_at(f, std::max(0.1 * end, 2.0 * closed)), found);
  return found;
}

Pick pick_reservoir_pressure(const FallOff& f, const AfterClosure& flow) {
  if (flow.flow == Flow::none) return none("reservoir_pressure", "Pa", flow.why);
  Pick pick{.name = "reservoir_pressure", .unit = "Pa"};
  pick.value = flow.pressure;
  pick.time = f.shut_in + flow.from;
  pick.uncertainty = flow.pressure_uncertainty;
  pick.method =
      fmt::format("line of p over {}, dt from {:.4g} s to {:.4g} s, extended to 0 ({} flow: slope {:.3f})",
                  abscissa(flow.flow), flow.from, f.elapsed.back(),
                  flow.flow == Flow::linear ? "linear" : "radial", flow.loglog_slope);
  return pick;
}

Pick pick_permeability(const FallOff& f, const AfterClosure& flow, const Injection& injection,
                       const DfitInputs& in, const Pick& isip, const Pick& leak_off_coefficient) {
  const auto refuse = [](const std::string& why) { return none("permeability", "m2", why); };
  if (!in.viscosity) return refuse("it needs viscosity");
  const double volume = injection.volume + injection.earlier_volume;
  const double relative = flow.flow == Flow::none ? 0.0 : flow.slope_uncertainty / std::abs(flow.slope);
  if (flow.flow == Flow::radial) {
    if (!in.height) return refuse("radial flow: it needs height");
    return make_permeability(
        *in.viscosity * volume / (4.0 * pi * *in.height * flow.slope), relative, f.shut_in + flow.from,
        fmt::format("radial flow after closure: dp/d(dt^-1) = {:.4g} Pa s, V = {:.4g} m3", flow.slope,
                    volume));
  }
  if (!in.porosity || !in.total_compressibility) return refuse("it needs porosity and total_compressibility");
  const double storage = *in.porosity * *in.total_compressibility;
  const FractureInputs fracture = fracture_of(in);
  if (flow.flow == Flow::linear && fracture.area) {
    const double depth = volume / *fracture.area;
    return make_permeability(
        *in.viscosity * depth * depth / (4.0 * pi * storage * flow.slope * flow.slope), 2.0 * relative,
        f.shut_in + flow.from,
        fmt::format("linear flow after closure: dp/d(dt^-1/2) = {:.4g} Pa s^0.5, V/A = {:.4g} m", flow.slope,
                    depth));
  }
  std::optional<double> reservoir = in.reservoir_pressure;
  if (flow.flow != Flow::none) reservoir = flow.pressure;
  if (!leak_off_coefficient.found() || !isip.found() || !reservoir) {
    return refuse(flow.flow == Flow::linear ? "linear flow: " + fracture.why_no_area
                                            : flow.why + "; Carter's coefficient needs reservoir_pressure");
  }
  const double drop = *isip.value - *reservoir;
  if (drop <= 0.0) return refuse("the reservoir pressure is not below the ISIP");
  const double per_root = *leak_off_coefficient.value / drop;
  return make_permeability(pi * *in.viscosity * per_root * per_root / storage,
                           2.0 * *leak_off_coefficient.uncertainty / *leak_off_coefficient.value,
                           *leak_off_coefficient.time,
                           fmt::format("Carter's coefficient with {:.4g} Pa from ISIP to reservoir", drop));
}

}  // namespace crackle
