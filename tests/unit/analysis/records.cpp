// SPDX-License-Identifier: GPL-3.0-or-later
#include "records.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include "crackle/analysis/g_function.hpp"

namespace crackle_test {

namespace {

constexpr double pi = std::numbers::pi;

void append(crackle::PressureRecord& record, double time, double pressure, double rate) {
  record.time.push_back(time);
  record.pressure.push_back(pressure);
  record.rate.push_back(rate);
}

/// A point of the simulated fall-off.
struct Point {
  double elapsed, pressure, fall;  // [s], [MPa], -dp/d ln Δt [kPa]
};

constexpr std::array<Point, 19> simulated{{{1, 44.5714, 6.667},
                                           {3, 44.5625, 8.805},
                                           {10, 44.5471, 17.232},
                                           {30, 44.5217, 26.747},
                                           {60, 44.5014, 30.550},
                                           {120, 44.4809, 33.774},
                                           {300, 44.4437, 52.086},
                                           {600, 44.4001, 73.628},
                                           {1000, 44.3602, 73.931},
                                           {1200, 44.3473, 41.109},
                                           {1500, 44.3459, 3490.899},
                                           {2000, 42.4198, 5959.732},
                                           {3000, 40.6192, 3616.531},
                                           {5000, 39.1222, 2434.551},
                                           {10000, 37.7628, 1587.410},
                                           {30000, 36.4723, 855.375},
                                           {100000, 35.7160, 450.027},
                                           {300000, 35.3409, 253.753},
                                           {900000, 35.1291, 137.986}}};

/// Hermite's cubic between two points, over ln Δt [MPa]; slopes at most three times that of the chord, with
/// which it is monotone (Fritsch and Carlson 1980): at 1500 s pressure has a kink.
double between(const Point& a, const Point& b, double elapsed) {
  const double width = std::log(b.elapsed / a.elapsed), s = std::log(elapsed / a.elapsed) / width;
  const double most = 3.0 * (a.pressure - b.pressure);
  const double va = -std::min(1e-3 * a.fall * width, most), vb = -std::min(1e-3 * b.fall * width, most);
  return a.pressure * (1.0 + 2.0 * s) * (1.0 - s) * (1.0 - s) + b.pressure * s * s * (3.0 - 2.0 * s) +
         va * s * (1.0 - s) * (1.0 - s) - vb * s * s * (1.0 - s);
}

}  // namespace

double CarterTest::stiffness() const {
  return young_modulus / (1.0 - poisson_ratio * poisson_ratio) / (pi * half_length);
}

double CarterTest::fall_per_g() const {
  return 0.5 * pi * leak_off_coefficient * std::sqrt(pump_time) * stiffness();
}

double CarterTest::closure_g() const { return (isip - closure) / fall_per_g(); }

double CarterTest::closure_elapsed() const {
  double low = 1e-6, high = 1e12;
  while (high > low * (1.0 + 1e-13)) {
    const double middle = std::sqrt(low * high);
    (crackle::g_function(middle, pump_time, alpha) < closure_g() ? low : high) = middle;
  }
  return low;
}

double CarterTest::pressure(double elapsed) const {
  const double g = crackle::g_function(elapsed, pump_time, alpha);
  const double open = isip - fall_per_g() * g;
  if (open >= closure) return open;
  const double closed = closure_elapsed();
  const double g_rate = (crackle::g_function(closed * 1.0001, pump_time, alpha) -
                         crackle::g_function(closed * 0.9999, pump_time, alpha)) /
                        (0.0002 * closed);
  const double s = exponent * (closure - reservoir) / (stiffening * fall_per_g() * g_rate);
  return reservoir + (closure - reservoir) * std::pow(s / (elapsed - closed + s), exponent);
}

crackle::DfitInputs CarterTest::inputs() const {
  crackle::DfitInputs inputs;
  inputs.young_modulus = young_modulus;
  inputs.poisson_ratio = poisson_ratio;
  inputs.half_length = half_length;
  inputs.height = height;
  return inputs;
}

std::vector<double> sampling(double step, double share, double end) {
  std::vector<double> times;
  for (double t = step; t <= end; t += std::max(step, share * t)) times.push_back(t);
  return times;
}

crackle::PressureRecord record_of(const CarterTest& test, const std::vector<double>& elapsed) {
  crackle::PressureRecord record;
  constexpr double rest = 10.0;  // before pumping [s]
  for (double t = 0.0; t < rest; t += 1.0) append(record, t, test.reservoir, 0.0);
  for (int i = 0; i < 300; ++i)
    append(record, rest + test.pump_time * i / 300.0, test.isip + test.friction, test.rate);
  append(record, rest + test.pump_time, test.isip, 0.0);
  for (const double t : elapsed) append(record, rest + test.pump_time + t, test.pressure(t), 0.0);
  return record;
}

crackle::PressureRecord simulated_record() {
  crackle::PressureRecord record;
  constexpr double ramp = 33.34, shut_in = 240.0, rate = 1.0 / 60.0;
  constexpr double before = 34.84e6, peak = 76e6, propagation = 44.588e6;
  for (int t = 0; t < 240; ++t) {
    const double p = t <= ramp ? before + (peak - before) * t / ramp
                               : propagation + (peak - propagation) * std::exp(-(t - ramp) / 2.0);
    append(record, t, p, rate);
  }
  append(record, shut_in, propagation, 0.0);
  std::size_t k = 0;
  for (double t = simulated.front().elapsed; t <= simulated.back().elapsed; t *= 1.02) {
    while (k + 2 < simulated.size() && t > simulated[k + 1].elapsed) ++k;
    append(record, shut_in + t, 1e6 * between(simulated[k], simulated[k + 1], t), 0.0);
  }
  return record;
}

crackle::DfitInputs simulated_inputs() {
  crackle::DfitInputs inputs;
  inputs.young_modulus = 42.5e9;
  inputs.poisson_ratio = 0.17;
  inputs.half_length = 40.0;
  inputs.height = 50.0;
  inputs.well_storage = 1.35e-8;
  inputs.porosity = 0.05;
  inputs.total_compressibility = 1.5e-8;
  inputs.viscosity = 2e-5;
  return inputs;
}

crackle::DfitSettings simulated_settings() {
  crackle::DfitSettings settings;
  settings.since_breakdown = true;
  return settings;
}

crackle::PressureRecord with_noise(crackle::PressureRecord record, double deviation, std::uint32_t seed) {
  std::mt19937 random(seed);  // its numbers are fixed by the standard, a std::normal_distribution's are not
  const auto uniform = [&] { return (static_cast<double>(random()) + 0.5) / 4294967296.0; };
  for (double& p : record.pressure) {
    const double radius = std::sqrt(-2.0 * std::log(uniform()));
    p += deviation * radius * std::cos(2.0 * pi * uniform());
  }
  return record;
}

}  // namespace crackle_test
