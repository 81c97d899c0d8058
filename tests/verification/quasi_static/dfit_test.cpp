// SPDX-License-Identifier: GPL-3.0-or-later
//
// A diagnostic fracture injection test in field time: ramp, breakdown, growth, shut-in, closure and
// 11.5 days of fall-off, against a prototype's record of the same scene.
#include <gtest/gtest.h>

#include <chrono>
#include <cstdio>

#include "crackle/core/errors.hpp"
#include "wing.hpp"

namespace crackle {
namespace {

constexpr double height = 50.0, closure_stress = 44.28e6, reservoir = 34.84e6, shut_in = 240.0;

QuasiStaticScene dfit(double step, double path) {
  QuasiStaticScene s = wing::scene(wing::mesh(step, path, 10.0 * path), path, 1.5);
  s.stiffness = isotropic_plane_strain(42.5e9, 0.17);
  s.pore_pressure = reservoir;
  s.stress = {0.0, reservoir - closure_stress, 0.0};
  s.fracture_energy = 100.0;
  s.tensile_strength = 10.75e6;
  s.fluid.viscosity = 1e-3;
  s.fluid.cavitation_pressure = 30e6;
  s.fluid.reference_pressure = reservoir;
  s.leak_off = MatrixRock{2.35e-20, 0.05, 1.5e-8, 2e-5, reservoir};
  s.well.storage = 1.35e-8 / (2.0 * height);
  s.well.breakdown_pressure = 76e6;
  s.well.impedance = 2e10;
  s.well.impedance_time = 8.0;
  s.pump = Pump({{0.0, shut_in, 1.0 / 60.0 / (2.0 * height)}});
  return s;
}

TEST(Dfit, Reference) {
  const auto begin = std::chrono::steady_clock::now();
  QuasiStatic stage(dfit(0.5, 60.0));
  std::vector<QuasiStaticRow> rows;
  double defect = 0.0;
  stage.run(shut_in + 1e6, [&](const QuasiStaticRow& row) {
    rows.push_back(row);
    defect = std::max(defect, std::abs(row.mass_defect) / row.injected);
  });
  const double wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  const auto at_time = [&](double t) {
    std::size_t i = 1;
    while (i + 1 < rows.size() && rows[i].time < t) ++i;
    const double s = (t - rows[i - 1].time) / (rows[i].time - rows[i - 1].time);
    QuasiStaticRow row = rows[i];
    row.well_pressure = rows[i - 1].well_pressure + s * (row.well_pressure - rows[i - 1].well_pressure);
    return row;
  };
  double breakdown = 0.0;
  for (const QuasiStaticRow& row : rows) {
    if (row.well_pressure >= 76e6 * (1 - 1e-9)) breakdown = row.time;
  }
  const QuasiStaticRow end = at_time(shut_in);
  const double length = 0.5 * (end.broken_length + end.damaged_length);
  std::printf("%zu steps, %ld iterations, %ld rejected, %.1f s, mass %.1e\n", rows.size(),
              stage.newton_iterations(), stage.rejected_steps(), wall, defect);
  std::printf(
      "breakdown at %.3f s (33.34); shut-in: length %.1f m (40.0), p %.3f (44.588), w %.3f mm (0.998)\n",
      breakdown, length, end.well_pressure * 1e-6, end.opening * 1e3);
  EXPECT_NEAR(breakdown, 33.34, 0.01);
  EXPECT_NEAR(length, 40.0, 1.5);
  EXPECT_LT(defect, 1e-8);
  const struct {
    double after, pressure, gate;
  } record[] = {{1, 44.571, 0.03},    {60, 44.501, 0.03}, {300, 44.444, 0.03}, {1000, 44.360, 0.03},
                {1200, 44.347, 0.03}, {2000, 42.42, 0.8}, {5000, 39.12, 0.4},  {3e4, 36.47, 0.1},
                {1e5, 35.716, 0.05},  {3e5, 35.341, 0.05}};
  for (const auto& r : record) {
    const QuasiStaticRow row = at_time(shut_in + r.after);
    std::printf("%8.0f s: p %.4f (%.3f), mean opening %.1f um, contact %.2f\n", r.after,
                row.well_pressure * 1e-6, r.pressure, row.mean_opening * 1e6, row.contact_fraction);
    EXPECT_NEAR(row.well_pressure * 1e-6, r.pressure, r.gate);
  }
}

// Shut in without leak-off: grows on for a while, then holds S_h + K/√(πℓ).
TEST(Dfit, WithoutLeakOffPressureStays) {
  QuasiStaticScene s = dfit(0.5, 75.0);
  s.leak_off = std::monostate{};
  QuasiStatic stage(s);
  QuasiStaticRow early, late;
  stage.run(shut_in + 1e4, [&](const QuasiStaticRow& row) { early = row; });
  stage.run(shut_in + 1.1e5, [&](const QuasiStaticRow& row) { late = row; });
  const double k = std::sqrt(42.5e9 / (1.0 - 0.17 * 0.17) * 100.0);
  const double length = 0.5 * (late.broken_length + late.damaged_length);
  const double expected = closure_stress + k / std::sqrt(M_PI * length);
  std::printf("no leak-off: length %.1f m, p %.5f MPa (%.5f), changes by %.1f Pa over 1e5 s\n", length,
              late.well_pressure * 1e-6, expected * 1e-6, late.well_pressure - early.well_pressure);
  EXPECT_NEAR(late.well_pressure, expected, 0.01e6);
  EXPECT_LT(std::abs(late.well_pressure - early.well_pressure), 1e3);
}

// The well's impedance acts for 8 s after breakdown; from 20 s on the histories agree.
TEST(Dfit, ImpedanceIsForgotten) {
  std::vector<QuasiStaticRow> rows[2];
  double most[2] = {0.0, 0.0};
  for (const int with : {0, 1}) {
    QuasiStaticScene s = dfit(0.5, 60.0);
    if (with == 0) s.well.impedance = 0.0;
    QuasiStatic stage(s);
    stage.run(shut_in, [&](const QuasiStaticRow& row) {
      rows[with].push_back(row);
      if (row.time > 33.4 && row.time < 33.34 + 8.0)
        most[with] = std::max(most[with], row.perforation_rate * 2.0 * height);
    });
  }
  double worst = 0.0;
  for (const QuasiStaticRow& row : rows[1]) {
    if (row.time < 33.34 + 20.0) continue;
    std::size_t i = 1;
    while (rows[0][i].time < row.time) ++i;
    const QuasiStaticRow &a = rows[0][i - 1], &b = rows[0][i];
    const double p =
        a.well_pressure + (row.time - a.time) / (b.time - a.time) * (b.well_pressure - a.well_pressure);
    worst = std::max(worst, std::abs(row.well_pressure - p));
  }
  std::printf(
      "impedance: largest rate %.3f m3/s (%.1f without), pressures within %.1f kPa from 20 s after "
      "breakdown\n",
      most[1], most[0], worst * 1e-3);
  EXPECT_LT(worst, 20e3);
  EXPECT_LT(most[1], 0.15);
}

TEST(Dfit, SecondCycleReopens) {
  QuasiStaticScene s = dfit(0.5, 60.0);
  const double rate = 1.0 / 60.0 / (2.0 * height), again = 20000.0;
  s.pump = Pump({{0.0, shut_in, rate}, {again, again + 240.0, rate}});
  QuasiStatic stage(s);
  double peak = 0.0, when = 0.0, damaged = 0.0, dissipated = 0.0;
  QuasiStaticRow last;
  stage.run(again + 240.0, [&](const QuasiStaticRow& row) {
    if (row.time <= again) {
      damaged = row.damaged_length;
      dissipated = row.dissipated;
    } else if (row.well_pressure > peak) {
      peak = row.well_pressure;
      when = row.time - again;
    }
    last = row;
  });
  std::printf(
      "second cycle: peak %.3f MPa at +%.1f s (45.207 at +9.0), %.3f at its end (44.555), damaged %.2f to "
      "%.2f m\n",
      peak * 1e-6, when, last.well_pressure * 1e-6, damaged, last.damaged_length);
  EXPECT_NEAR(peak, 45.21e6, 0.1e6);
  EXPECT_NEAR(last.well_pressure, 44.555e6, 0.03e6);
  EXPECT_GE(last.dissipated, dissipated);
}

// What cannot work is refused, with the reason.
TEST(Dfit, Refuses) {
  QuasiStaticScene s = dfit(1.0, 30.0);
  s.closure.residual_aperture = 0.0;
  EXPECT_THROW(QuasiStatic{s}, CaseError);
  s = dfit(1.0, 30.0);
  s.fluid.cavitation_pressure = reservoir;
  EXPECT_THROW(QuasiStatic{s}, CaseError);
  s = dfit(1.0, 10.0);
  QuasiStatic stage(s);
  EXPECT_THROW(stage.run(shut_in), NumericalError);  // the path ends
}

}  // namespace
}  // namespace crackle
