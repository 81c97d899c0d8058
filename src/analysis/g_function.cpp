// SPDX-License-Identifier: GPL-3.0-or-later
#include "crackle/analysis/g_function.hpp"

#include <cmath>
#include <numbers>

namespace crackle {
namespace {

/// g(δ) - g(0) for α = 1; the forms keep their digits at either end.
double rise_linear(double d) {
  if (d < 1.0) return 4.0 / 3.0 * (std::expm1(1.5 * std::log1p(d)) - d * std::sqrt(d));
  return 4.0 / 3.0 * (d * std::sqrt(d) * std::expm1(1.5 * std::log1p(1.0 / d)) - 1.0);
}

/// The same for α = 1/2, with asin((1+δ)^{-1/2}) = π/2 - atan(δ^{1/2}).
double rise_root(double d) {
  constexpr double quarter = 0.5 * std::numbers::pi;
  if (d < 1.0) return d * quarter - (1.0 + d) * std::atan(std::sqrt(d)) + std::sqrt(d);
  return (1.0 + d) * std::atan(1.0 / std::sqrt(d)) + std::sqrt(d) - quarter;
}

}  // namespace

double g_at_shut_in(double alpha) {
  const double weight = 2.0 * alpha - 1.0;
  return weight * 4.0 / 3.0 + (1.0 - weight) * 0.5 * std::numbers::pi;
}

double g_function(double elapsed, double pump_time, double alpha) {
  const double d = elapsed / pump_time, weight = 2.0 * alpha - 1.0;
  return 4.0 / std::numbers::pi * (weight * rise_linear(d) + (1.0 - weight) * rise_root(d));
}

}  // namespace crackle
