// SPDX-License-Identifier: GPL-3.0-or-later
//
// A diagnostic fracture injection test in field time: ramp, breakdown, growth, shut-in, closure and
// 11.5 days of fall-off, against a prototype's record of the same scene.
#include <gtest/gtest.h>

#include <chrono>
#include <cstdio>

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
  std::printf("%zu steps, %d iterations, %d rejected, %.1f s, mass %.1e\n", rows.size(),
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

}  // namespace
}  // namespace crackle
