// SPDX-License-Identifier: GPL-3.0-or-later
//
// Closure: the contact by compliance, and the two tangents.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "crackle/analysis/picks.hpp"
#include "pick.hpp"

namespace crackle {
namespace {

/// Where -dp/dG rises: from the least value to the largest after it.
struct Rise {
  std::size_t low = 0, top = 0;
};

/// Bounds of -dp/dG at a point by four standard errors: of some hundred points none is beyond by chance.
double at_most(const FallOff& f, std::size_t i) { return f.by_g.value[i] + 4.0 * f.by_g.error[i]; }
double at_least(const FallOff& f, std::size_t i) { return f.by_g.value[i] - 4.0 * f.by_g.error[i]; }

/// Whether pressure never comes back to what it is at each point, but for noise.
std::vector<bool> falls_for_good(const FallOff& f) {
  std::vector<bool> for_good(f.size(), true);
  double highest = f.pressure.back();
  for (std::size_t i = f.size(); i-- > 0;) {
    for_good[i] = highest <= f.pressure[i] + 4.0 * f.point_error(i);
    highest = std::max(highest, f.pressure[i]);
  }
  return for_good;
}

/// The rise that lifts G dp/dG most above the line through the origin with the least -dp/dG before it, since
/// a tenth of its G. Swings of the fluid in the well come to nothing: they are early, and pressure comes
/// back. Uncertain slopes are taken at their worse bound, and not at all where their error is above a quarter
/// of the mean -dp/dG of the whole fall-off.
Rise largest_rise(const FallOff& f) {
  const double known = 0.25 * (f.pressure.front() - f.pressure.back()) / (f.g.back() - f.g.front());
  const std::vector<bool> for_good = falls_for_good(f);
  Rise best;
  double most = 0.0;
  for (std::size_t i = 2; i + 1 < f.size(); ++i) {
    if (f.by_g.error[i] > known || !for_good[i]) continue;
    std::size_t low = i;
    for (std::size_t j = i; j-- > 1 && f.g[j] >= 0.1 * f.g[i];) {
      if (f.by_g.error[j] <= known && at_most(f, j) < at_most(f, low)) low = j;
    }
    const double excess = f.g[i] * (at_least(f, i) - at_most(f, low));
    if (low < i && excess > most) {
      most = excess;
      best = {low, i};
    }
  }
  for (std::size_t i = best.top; i > best.low; --i) {
    if (at_least(f, i) > at_least(f, best.top)) best.top = i;
  }
  return best;
}

/// Why this is no contact; empty if it may be one.
std::string why_no_contact(const FallOff& f, const Rise& rise) {
  if (rise.low == 0) return "dp/dG never rises";
  const double low = f.by_g.value[rise.low], top = f.by_g.value[rise.top];
  const double error = std::hypot(f.by_g.error[rise.low], f.by_g.error[rise.top]);
  if (top - low <= std::max(8.0 * error, 0.2 * std::abs(low)))
    return fmt::format(
        "dp/dG does not rise by a fifth and beyond noise (from {:.4g} to {:.4g} Pa, +- {:.2g})", low, top,
        error);
  const double fallen = f.pressure[rise.low] - f.pressure[rise.top];
  const double whole = f.pressure.front() - f.pressure.back();
  if (fallen <= 0.02 * whole)
    return fmt::format("where dp/dG rises, pressure falls by {:.3g} Pa of {:.3g} only", fallen, whole);
  return {};
}

/// Last point before -dp/dG is a tenth above its minimum, and beyond noise.
std::size_t onset_of(const FallOff& f, const Rise& rise) {
  const double low = at_most(f, rise.low);
  std::size_t i = rise.top;
  while (i > rise.low && f.by_g.value[i] > low + std::max(0.1 * std::abs(low), 3.0 * f.by_g.error[i])) --i;
  return i;
}

/// The line of p over G through the points of the last `decades` before a point.
Line line_before(const FallOff& f, std::size_t point, double decades) {
  auto [first, end] =
      points_between(f.elapsed, f.elapsed[point] * std::pow(10.0, -decades), f.elapsed[point]);
  first = std::min(first, point - std::min(point, std::size_t{3}));
  const std::span g(f.g), p(f.pressure);
  return fit_line(g.subspan(first, end - first), p.subspan(first, end - first), f.point_error(point));
}

/// From the onset to where pressure leaves the line through the points up to there, two points in a row.
std::size_t last_on_line(const FallOff& f, std::size_t onset) {
  constexpr double before = 0.3;  // decades
  constexpr double deviations = 4.0;
  const double limit = f.elapsed[onset] * std::pow(10.0, 0.5 * f.window);
  const auto left = [&](const Line& line, std::size_t i) {
    return line.at(f.g[i]) - f.pressure[i] > deviations * std::hypot(line.scatter, line.error_at(f.g[i]));
  };
  std::size_t i = onset;
  for (; i + 2 < f.size() && f.elapsed[i + 1] <= limit; ++i) {
    const Line line = line_before(f, i, before);
    if (left(line, i + 1) && left(line, i + 2)) break;
  }
  return i;
}

/// Points that the tangents ask: from the contact on, or from G = 1 or a quarter of all G.
std::size_t first_for_tangent(const FallOff& f, const Pick& contact) {
  if (contact.found()) return std::max<std::size_t>(1, point_at(f, *contact.time - f.shut_in));
  return std::max<std::size_t>(1, points_between(f.g, std::min(1.0, 0.25 * f.g.back()), f.g.back()).first);
}

struct Tangent {
  std::string name;
  std::string of;  ///< "G dp/dG over G"
  const std::vector<double>& x;
  const FallRate& rate;
};

/// Where x dp/dx leaves the tangent from the origin.
Pick pick_tangent(const FallOff& f, const Pick& contact, const Tangent& t) {
  constexpr double off = 0.2, deviations = 4.0;
  const std::vector<double>&slope = t.rate.value, &error = t.rate.error;
  const std::size_t first = first_for_tangent(f, contact);
  // beyond, the derivative has no full window
  const std::size_t end =
      std::max(first + 1, point_at(f, f.elapsed.back() * std::pow(10.0, -0.5 * f.window)));
  std::size_t top = first;
  for (std::size_t i = first; i < end; ++i) {
    if (slope[i] - deviations * error[i] > slope[top] - deviations * error[top]) top = i;
  }
  const double largest = slope[top];
  if (largest <= 2.0 * deviations * error[top])
    return none(t.name, "Pa", "pressure does not fall beyond noise");
  if (slope[end - 1] + deviations * error[end - 1] > (1.0 - off) * largest)
    return none(t.name, "Pa", t.of + " does not leave the line through the origin");
  std::size_t straight = first, last = top;
  while (slope[straight] < (1.0 - off) * largest) ++straight;
  for (std::size_t i = top; i < end; ++i) {
    if (slope[i] >= (1.0 - off) * largest) last = i;
  }
  // without a rise the tangent must be seen as a line, or any decline would have one
  if (!contact.found() && t.x[last] < 1.5 * t.x[straight])
    return none(t.name, "Pa", t.of + " has no straight part through the origin");
  const double part = (slope[last] - (1.0 - off) * largest) / (slope[last] - slope[last + 1]);
  const auto there = [&](const std::vector<double>& of) { return std::lerp(of[last], of[last + 1], part); };
  Pick pick{.name = t.name, .unit = "Pa"};
  pick.value = there(f.pressure);
  pick.time = f.shut_in + there(f.elapsed);
  pick.uncertainty = std::hypot(f.point_error(last), 0.5 * (f.pressure[top] - *pick.value));
  pick.method = fmt::format("where {} has left the tangent from the origin by a fifth, at {:.4g}; {}", t.of,
                            there(t.x), window_text(f));
  return pick;
}

}  // namespace

Pick pick_contact(const FallOff& f) {
  const std::string name = "contact_compliance";
  const Rise rise = largest_rise(f);
  if (const std::string why = why_no_contact(f, rise); !why.empty()) return none(name, "Pa", why);
  const std::size_t onset = onset_of(f, rise), last = last_on_line(f, onset);
  const Line line = line_before(f, last, 0.5 * f.window);
  Pick pick{.name = name, .unit = "Pa"};
  pick.value = line.at(f.g[last]);
  pick.time = f.shut_in + f.elapsed[last];
  pick.uncertainty = std::hypot(2.0 * line.error_at(f.g[last]), f.pressure[onset] - *pick.value);
  pick.method =
      fmt::format("end of the minimum of -dp/dG ({:.4g} Pa) before it rises to {:.4g} Pa, at G = {:.4g}; {}",
                  f.by_g.value[rise.low], f.by_g.value[rise.top], f.g[last], window_text(f));
  return pick;
}

Pick pick_closure_tangent(const FallOff& f, const Pick& contact) {
  return pick_tangent(f, contact, {"closure_tangent", "G dp/dG over G", f.g, f.by_g});
}

Pick pick_closure_root(const FallOff& f, const Pick& contact) {
  return pick_tangent(f, contact,
                      {"closure_sqrt_time", "sqrt(dt) dp/dsqrt(dt) over sqrt(dt)", f.root, f.by_root});
}

}  // namespace crackle
