// SPDX-License-Identifier: GPL-3.0-or-later
// Straight lines through points. Private to analysis.
#pragma once

#include <span>

namespace crackle {

/// y = at_mean + slope (x - mean_x), by least squares.
struct Line {
  double mean_x = 0.0, at_mean = 0.0, slope = 0.0;
  double sum_xx = 0.0;   ///< Σ (x - mean_x)²
  double scatter = 0.0;  ///< standard deviation of the points about the line
  double points = 0.0;
  double at(double x) const { return at_mean + slope * (x - mean_x); }
  double slope_error() const;       ///< standard error
  double error_at(double x) const;  ///< standard error of the line itself at x
};

/// @param noise least standard deviation of a y that is believed
Line fit_line(std::span<const double> x, std::span<const double> y, double noise);

}  // namespace crackle
