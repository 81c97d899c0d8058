// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <stdexcept>

#include "crackle/analysis/picks.hpp"

namespace crackle {
namespace {

double pump_time(const PressureRecord& record, const Injection& injection, const DfitSettings& settings) {
  if (settings.pump_time) return *settings.pump_time;
  if (!settings.since_breakdown) return injection.volume / injection.rate;
  const double since = injection.shut_in - injection.breakdown_time;
  if (since > 0.05 * (injection.shut_in - injection.start)) return since;
  throw record_error(
      record, injection.shut_in_sample - 1,
      fmt::format("pump_time = breakdown: the largest pressure is {:.4g} s before shut-in, which "
                  "is no breakdown; give pump_time as a time",
                  since));
}

}  // namespace

const Pick& DfitAnalysis::pick(const std::string& name) const {
  for (const Pick& p : picks) {
    if (p.name == name) return p;
  }
  throw std::invalid_argument("no pick is called " + name);
}

DfitAnalysis analyse_dfit(const PressureRecord& record, const DfitSettings& settings,
                          const DfitInputs& inputs) {
  check_record(record);
  DfitAnalysis a;
  a.injection = find_injection(record, settings.shut_in);
  const FallOff& f = a.fall_off = make_fall_off(
      record, a.injection, {pump_time(record, a.injection, settings), settings.alpha, settings.window});
  const Pick contact = pick_contact(f);
  const Pick tangent = pick_closure_tangent(f, contact);
  const Pick isip = pick_isip(f, contact);
  const Pick carter = pick_leak_off_coefficient(f, contact, inputs);
  a.after_closure = find_after_closure(f, contact, tangent);
  a.picks = {isip,
             contact,
             tangent,
             pick_closure_root(f, contact),
             carter,
             pick_efficiency(f, contact, tangent),
             pick_reservoir_pressure(f, a.after_closure),
             pick_permeability(f, a.after_closure, a.injection, inputs, isip, carter),
             pick_leak_off_type(f, contact, tangent)};
  return a;
}

}  // namespace crackle
