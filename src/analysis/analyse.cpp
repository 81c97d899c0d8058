// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <stdexcept>

#include "crackle/analysis/picks.hpp"
#include "pick.hpp"

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

// Mean of what a simulated test knows, over the samples of the window of the early line.
std::optional<double> truth_in_window(const PressureRecord& record, const FallOff& f, const Pick& contact,
                                      const std::string& column) {
  const auto truth = record.truth.find(column);
  const auto early = early_line(f, contact);
  if (truth == record.truth.end() || !early) return {};
  const auto [first, end] = points_between(f.g, early->from, early->to);
  double sum = 0.0, count = 0.0;
  for (std::size_t i = 0; i < record.time.size(); ++i) {
    const double elapsed = record.time[i] - f.shut_in;
    if (elapsed < f.elapsed[first] || elapsed > f.elapsed[end - 1]) continue;
    sum += truth->second[i];
    count += 1.0;
  }
  return sum / count;
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
  DfitInputs& known = a.inputs = inputs;
  if (!known.half_length) known.half_length = truth_in_window(record, f, contact, "half_length_m");
  const Pick tangent = pick_closure_tangent(f, contact);
  const Pick isip = pick_isip(f, contact);
  const Pick carter = pick_leak_off_coefficient(f, contact, known);
  a.after_closure = find_after_closure(f, contact, tangent);
  a.picks = {isip,
             contact,
             tangent,
             pick_closure_root(f, contact),
             carter,
             pick_efficiency(f, contact, tangent),
             pick_reservoir_pressure(f, a.after_closure),
             pick_permeability(f, a.after_closure, a.injection, known, isip, carter),
             pick_leak_off_type(f, contact, tangent)};
  return a;
}

}  // namespace crackle
