// SPDX-License-Identifier: GPL-3.0-or-later
#include "crackle/seismic/b_value.hpp"

#include <cmath>
#include <limits>
#include <map>
#include <numbers>

namespace crackle {

BValue b_value(std::span<const double> magnitudes, double completeness, double bin) {
  BValue result;
  result.completeness = completeness;
  result.b = result.sigma_aki = result.sigma_shi_bolt = std::numeric_limits<double>::quiet_NaN();
  // A magnitude rounded to the bins may lie a round-off below the lower end of its bin's neighbour.
  const double least = completeness - 0.5 * bin;
  const auto counts = [&](double m) { return m >= least - 1e-9 * bin; };
  double sum = 0.0;
  for (const double m : magnitudes) {
    if (!counts(m)) continue;
    sum += m;
    ++result.events;
  }
  if (result.events < 2) return result;
  const double n = result.events;
  const double mean = sum / n;
  double squares = 0.0;
  for (const double m : magnitudes) {
    if (counts(m)) squares += (m - mean) * (m - mean);
  }
  if (!(squares > 0.0)) return result;
  result.b = std::numbers::log10e / (mean - least);
  result.sigma_aki = result.b / std::sqrt(n);
  result.sigma_shi_bolt = 2.30 * result.b * result.b * std::sqrt(squares / (n * (n - 1.0)));
  return result;
}

double maximum_curvature(std::span<const double> magnitudes, double bin) {
  std::map<long, int> histogram;
  for (const double m : magnitudes) ++histogram[std::lround(m / bin)];
  double best = std::numeric_limits<double>::quiet_NaN();
  int most = 0;
  for (const auto& [index, count] : histogram) {
    if (count <= most) continue;
    most = count;
    best = static_cast<double>(index) * bin;
  }
  return best;
}

}  // namespace crackle
