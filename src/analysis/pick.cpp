// SPDX-License-Identifier: GPL-3.0-or-later
#include "pick.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace crackle {

Pick none(const std::string& name, const std::string& unit, const std::string& why) {
  Pick pick{.name = name, .method = "none: " + why, .unit = unit};
  return pick;
}

std::pair<std::size_t, std::size_t> points_between(std::span<const double> x, double low, double high) {
  const auto first = std::lower_bound(x.begin(), x.end(), low);
  const auto end = std::upper_bound(first, x.end(), high);
  return {static_cast<std::size_t>(first - x.begin()), static_cast<std::size_t>(end - x.begin())};
}

std::size_t point_at(const FallOff& f, double elapsed) {
  const auto next = std::upper_bound(f.elapsed.begin(), f.elapsed.end(), elapsed);
  return next == f.elapsed.begin() ? 0 : static_cast<std::size_t>(next - f.elapsed.begin()) - 1;
}

std::optional<EarlyLine> early_line(const FallOff& f, const Pick& contact) {
  const double last = contact.found() ? f.g[point_at(f, *contact.time - f.shut_in)] : f.g.back();
  EarlyLine early;
  early.to = 0.4 * last;
  early.from = std::min(1.0, 0.5 * early.to);
  const auto [first, end] = points_between(f.g, early.from, early.to);
  constexpr std::size_t fewest = 6;
  if (end < first + fewest) return {};
  const auto fit = [&](std::size_t a, std::size_t b) {
    const std::span g(f.g), p(f.pressure);
    return fit_line(g.subspan(a, b - a), p.subspan(a, b - a), f.point_error(a));
  };
  const std::size_t middle = (first + end) / 2;
  const Line left = fit(first, middle), right = fit(middle, end);
  early.line = fit(first, end);
  early.intercept = early.line.at(0.0);
  early.intercept_uncertainty =
      std::hypot(2.0 * early.line.error_at(0.0), 0.5 * (left.at(0.0) - right.at(0.0)));
  early.slope_uncertainty = std::hypot(2.0 * early.line.slope_error(), 0.5 * (left.slope - right.slope));
  return early;
}

std::string window_text(const FallOff& f) { return fmt::format("derivative over {:g} decades", f.window); }

}  // namespace crackle
