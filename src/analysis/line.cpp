// SPDX-License-Identifier: GPL-3.0-or-later
#include "line.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace crackle {

double Line::slope_error() const { return scatter / std::sqrt(sum_xx); }

double Line::error_at(double x) const {
  return scatter * std::sqrt(1.0 / points + (x - mean_x) * (x - mean_x) / sum_xx);
}

Line fit_line(std::span<const double> x, std::span<const double> y, double noise) {
  Line line;
  line.points = static_cast<double>(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) {
    line.mean_x += x[i] / line.points;
    line.at_mean += y[i] / line.points;
  }
  double sum_xy = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    line.sum_xx += (x[i] - line.mean_x) * (x[i] - line.mean_x);
    sum_xy += (x[i] - line.mean_x) * (y[i] - line.at_mean);
  }
  line.slope = sum_xy / line.sum_xx;
  double squares = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) squares += std::pow(y[i] - line.at(x[i]), 2);
  const double freedom = std::max(1.0, line.points - 2.0);
  line.scatter = std::max(noise, std::sqrt(squares / freedom));
  return line;
}

}  // namespace crackle
