// SPDX-License-Identifier: GPL-3.0-or-later
#include "catalog_summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace crackle {
namespace {

constexpr double bin = 0.1;  // of magnitudes, for completeness

std::string range(const std::vector<SeismicEvent>& events, double SeismicEvent::*value, const char* form) {
  const auto [low, high] = std::minmax_element(
      events.begin(), events.end(), [&](const auto& a, const auto& b) { return a.*value < b.*value; });
  return fmt::format(fmt::runtime(form), (*low).*value, (*high).*value);
}

std::string kinds(const std::vector<SeismicEvent>& events) {
  std::array<int, 4> by_mode{};
  int slips = 0;
  double broken = 0.0, slid = 0.0, friction = 0.0;
  for (const SeismicEvent& e : events) {
    if (e.kind == EventKind::slip) {
      ++slips;
      slid += e.length;
      friction += e.friction_energy;
      continue;
    }
    ++by_mode[static_cast<std::size_t>(e.mode)];
    broken += e.length;
  }
  std::string text = fmt::format("  breaking: {} tensile, {} shear, {} mixed; {:.4g} m broken\n", by_mode[1],
                                 by_mode[2], by_mode[3], broken);
  if (slips > 0) {
    text +=
        fmt::format("  slips: {}, over {:.4g} m, {:.3g} J/m dissipated by friction\n", slips, slid, friction);
  }
  return text;
}

std::string moments(const std::vector<SeismicEvent>& events, double thickness) {
  std::array<int, 4> types{};
  MomentTensor sum;
  for (const SeismicEvent& e : events) {
    ++types[static_cast<std::size_t>(source_type(e.opening, e.slip))];
    sum += e.moment;
  }
  const MomentShares shares = moment_shares(sum);
  return fmt::format(
      "  sources: {} tensile, {} shear, {} mixed, {} closing (by the angle of opening to slip)\n"
      "  sum of the moment tensors: M0 {:.3g} N m, Mw {:.2f}; ISO {:.0f} %, CLVD {:.0f} %, DC {:.0f} %\n",
      types[0], types[1], types[2], types[3], scalar_moment(sum) * thickness,
      moment_magnitude(scalar_moment(sum) * thickness), 100.0 * shares.iso, 100.0 * shares.clvd,
      100.0 * shares.dc);
}

std::string clusters(const std::vector<SeismicEvent>& events, const ClusterRule& rule, double thickness) {
  const std::vector<Cluster> found = cluster_events(events, rule, thickness);
  const Cluster& largest = *std::max_element(found.begin(), found.end(), [](const auto& a, const auto& b) {
    return a.events.size() < b.events.size();
  });
  return fmt::format(
      "  clusters within {:.3g} mm and {:.3g} us: {}; the largest has {} event{}, {:.4g} m, M {:.2f}, "
      "Mw {:.2f}\n",
      1e3 * rule.radius, 1e6 * rule.window, found.size(), largest.events.size(),
      largest.events.size() == 1 ? "" : "s", largest.length, largest.magnitude, largest.moment_magnitude);
}

}  // namespace

BValue b_value_of(const std::vector<SeismicEvent>& events) {
  std::vector<double> magnitudes;
  for (const SeismicEvent& e : events) {
    if (std::isfinite(e.magnitude)) magnitudes.push_back(e.magnitude);
  }
  // The sample starts at the lower end of the bin that holds most; the magnitudes are not rounded.
  return b_value(magnitudes, maximum_curvature(magnitudes, bin) - 0.5 * bin, 0.0);
}

std::string catalog_summary(const std::string& folder, const std::vector<SeismicEvent>& events,
                            const Case& scene, const ClusterRule& rule) {
  std::string text = fmt::format("{}: {} event{}\n", folder, events.size(), events.size() == 1 ? "" : "s");
  if (events.empty()) return text;
  const double thickness = scene.seismic.thickness;
  double reach = 0.0;
  for (const SeismicEvent& e : events) reach = std::max(reach, norm(e.place));
  text += kinds(events);
  text += fmt::format("  magnitudes of energy {}, of moment {} (for {:g} m of thickness)\n",
                      range(events, &SeismicEvent::magnitude, "{:.2f} to {:.2f}"),
                      range(events, &SeismicEvent::moment_magnitude, "{:.2f} to {:.2f}"), thickness);
  text += fmt::format("  from {} s, up to {:.4g} m from the origin\n",
                      range(events, &SeismicEvent::time, "{:.6g} to {:.6g}"), reach);
  text += moments(events, thickness);
  text += clusters(events, rule, thickness);
  const BValue b = b_value_of(events);
  text += std::isfinite(b.b)
              ? fmt::format(
                    "  b = {:.2f} +- {:.2f} (Aki), +- {:.2f} (Shi & Bolt), from {} events above M {:.2f}\n",
                    b.b, b.sigma_aki, b.sigma_shi_bolt, b.events, b.completeness)
              : std::string("  b: too few events\n");
  return text;
}

}  // namespace crackle
