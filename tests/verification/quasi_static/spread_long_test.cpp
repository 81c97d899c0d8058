// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the picks owe to the mesh and to the time step.
#include <gtest/gtest.h>

#include "../../acceptance.hpp"
#include "dfit.hpp"

namespace crackle {
namespace {

TEST(DfitPicks, SpreadOverMeshesAndSteps) {
  const struct {
    double step, relative;
  } runs[] = {{1.0, 0.02}, {0.5, 0.02}, {0.25, 0.02}, {0.5, 0.08}, {0.5, 0.005}};
  const char* names[] = {"isip", "contact_compliance"};
  double low[2] = {1e12, 1e12}, high[2] = {0.0, 0.0};
  for (const auto& run : runs) {
    QuasiStaticScene s = dfit::scene(run.step, 60.0);
    s.control.relative = run.relative;
    const DfitAnalysis a = dfit::picks_of(s);
    std::printf("h %.2f m, steps of %.1f %%:", run.step, 100.0 * run.relative);
    for (int i = 0; i < 2; ++i) {
      const double p = dfit::value(a, names[i]);
      low[i] = std::min(low[i], p);
      high[i] = std::max(high[i], p);
      std::printf(" %s %.4f MPa", names[i], 1e-6 * p);
    }
    std::printf(" tangent %.3f MPa, C_L %.3e\n", 1e-6 * dfit::value(a, "closure_tangent"),
                dfit::value(a, "leak_off_coefficient"));
  }
  for (int i = 0; i < 2; ++i) {
    const double spread = 1e-3 * (high[i] - low[i]);
    accept(12, std::string("h of 1, 0.5, 0.25 m, steps of 8, 2, 0.5 %: spread of ") + names[i], "15 kPa",
           text("%.1f kPa", spread), spread <= 15.0);
    EXPECT_LE(spread, 15.0);
  }
}

}  // namespace
}  // namespace crackle
