// SPDX-License-Identifier: GPL-3.0-or-later
#include "crackle/analysis/fall_off.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>

#include "crackle/analysis/g_function.hpp"

namespace crackle {
namespace {

constexpr double bin_width = 0.02;  ///< of ln Δt
constexpr std::size_t fewest_bins = 20;

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Means over the samples of a bin, also of what pressure is a line over.
struct Bin {
  double count = 0.0, elapsed = 0.0, log = 0.0, g = 0.0, root = 0.0, pressure = 0.0;
};

void append(const Bin& sum, std::vector<double>& log_elapsed, FallOff& f) {
  f.count.push_back(sum.count);
  f.elapsed.push_back(sum.elapsed / sum.count);
  f.g.push_back(sum.g / sum.count);
  f.root.push_back(sum.root / sum.count);
  f.pressure.push_back(sum.pressure / sum.count);
  log_elapsed.push_back(sum.log / sum.count);
}

/// @return ln Δt of the bins
std::vector<double> fill_bins(const PressureRecord& record, const Injection& injection, FallOff& f) {
  std::vector<double> log_elapsed;
  std::size_t i = injection.shut_in_sample;
  while (i < injection.end_sample && record.time[i] <= injection.shut_in) ++i;  // it has no logarithm
  while (i < injection.end_sample) {
    // a little less, so that samples 2 % apart are not paired by rounding
    const double end = (record.time[i] - injection.shut_in) * (1.0 + 0.9 * bin_width);
    Bin sum;
    for (; i < injection.end_sample; ++i) {
      const double elapsed = record.time[i] - injection.shut_in;
      if (sum.count > 0.0 && elapsed >= end) break;
      sum.count += 1.0;
      sum.elapsed += elapsed;
      sum.log += std::log(elapsed);
      sum.g += g_function(elapsed, f.pump_time, f.alpha);
      sum.root += std::sqrt(elapsed);
      sum.pressure += record.pressure[i];
    }
    append(sum, log_elapsed, f);
  }
  return log_elapsed;
}

/// First and one past the last point within half a window on both sides, with at least one neighbour.
std::pair<std::size_t, std::size_t> window_at(const FallOff& f, std::size_t i, double window) {
  const double half = std::min({0.5 * window * std::numbers::ln10, std::log(f.elapsed[i] / f.elapsed.front()),
                                std::log(f.elapsed.back() / f.elapsed[i])});
  const double low = f.elapsed[i] * std::exp(-half * (1.0 + 1e-9)),
               high = f.elapsed[i] * std::exp(half * (1.0 + 1e-9));
  const auto first = std::lower_bound(f.elapsed.begin(), f.elapsed.end(), low) - f.elapsed.begin();
  const auto end = std::upper_bound(f.elapsed.begin(), f.elapsed.end(), high) - f.elapsed.begin();
  return {std::min(static_cast<std::size_t>(first), i - 1), std::max(static_cast<std::size_t>(end), i + 2)};
}

FallRate fall_rate(const FallOff& f, std::span<const double> x, double window) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  FallRate rate{std::vector<double>(f.size(), nan), std::vector<double>(f.size(), nan)};
  for (std::size_t i = 1; i + 1 < f.size(); ++i) {
    const auto [first, end] = window_at(f, i, window);
    const double n = static_cast<double>(end - first);
    double mean_x = 0.0, mean_p = 0.0;
    for (std::size_t j = first; j < end; ++j) {
      mean_x += x[j] / n;
      mean_p += f.pressure[j] / n;
    }
    double xx = 0.0, xp = 0.0, variance = 0.0;
    for (std::size_t j = first; j < end; ++j) {
      const double dx = x[j] - mean_x;
      xx += dx * dx;
      xp += dx * (f.pressure[j] - mean_p);
      variance += dx * dx * f.point_error(j) * f.point_error(j);
    }
    rate.value[i] = -xp / xx;
    rate.error[i] = std::sqrt(variance) / xx;
  }
  return rate;
}

double noise_share_of(const FallRate& rate) {
  std::vector<double> shares;
  for (std::size_t i = 1; i + 1 < rate.value.size(); ++i) {
    shares.push_back(rate.error[i] / std::max(std::abs(rate.value[i]), 1e-300));
  }
  return median(shares);
}

}  // namespace

double FallOff::point_error(std::size_t i) const { return noise / std::sqrt(count[i]); }

double noise_of(const std::vector<double>& time, const std::vector<double>& pressure) {
  constexpr double median_to_deviation = 1.4826;  // of a normal distribution
  constexpr std::array<std::size_t, 4> neighbours{0, 1, 3, 4};
  std::vector<double> deviations;
  double step = 0.0;  // smallest step of the gauge
  std::size_t equal = 0;
  for (std::size_t i = 0; i + 4 < time.size(); ++i) {
    double between = 0.0, squares = 1.0;
    for (const std::size_t a : neighbours) {
      double weight = 1.0;  // Lagrange's
      for (const std::size_t b : neighbours) {
        if (a != b) weight *= (time[i + 2] - time[i + b]) / (time[i + a] - time[i + b]);
      }
      between += weight * pressure[i + a];
      squares += weight * weight;
    }
    deviations.push_back(std::abs(pressure[i + 2] - between) / std::sqrt(squares));
    const double change = std::abs(pressure[i + 1] - pressure[i]);
    if (change == 0.0) ++equal;
    if (change > 0.0 && (step == 0.0 || change < step)) step = change;
  }
  if (deviations.empty()) return 0.0;
  if (10 * equal < deviations.size()) step = 0.0;  // values of a gauge that resolves more repeat seldom
  return std::max(median_to_deviation * median(deviations), step / std::sqrt(12.0));
}

FallOff make_fall_off(const PressureRecord& record, const Injection& injection,
                      const FallOffSettings& settings) {
  FallOff f;
  f.shut_in = injection.shut_in;
  f.pump_time = settings.pump_time;
  f.alpha = settings.alpha;
  const auto part = [&](const std::vector<double>& v) {
    return std::vector<double>(v.begin() + static_cast<std::ptrdiff_t>(injection.shut_in_sample),
                               v.begin() + static_cast<std::ptrdiff_t>(injection.end_sample));
  };
  f.noise = noise_of(part(record.time), part(record.pressure));
  const std::vector<double> log_elapsed = fill_bins(record, injection, f);
  if (f.size() < fewest_bins) {
    throw record_error(
        record, injection.end_sample - 1,
        fmt::format("the fall-off fills {} steps of 2 % in time; {} are the fewest that can be "
                    "analysed: record more often",
                    f.size(), fewest_bins));
  }
  constexpr double enough = 0.05;
  const std::vector<double> windows =
      settings.window > 0.0 ? std::vector{settings.window} : std::vector{0.15, 0.2, 0.3, 0.4};
  for (const double window : windows) {
    f.window = window;
    f.by_log = fall_rate(f, log_elapsed, window);
    f.noise_share = noise_share_of(f.by_log);
    if (f.noise_share <= enough) break;
  }
  f.by_g = fall_rate(f, f.g, f.window);
  f.by_root = fall_rate(f, f.root, f.window);
  return f;
}

}  // namespace crackle
