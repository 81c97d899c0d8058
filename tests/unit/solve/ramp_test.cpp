// SPDX-License-Identifier: GPL-3.0-or-later
//
// The elastic ramp by static solves against the same ramp by steps.
#include <gtest/gtest.h>

#include "../../granite.hpp"

namespace crackle {
namespace {

Scene pumped_wellbore(bool fast_forward) {
  Scene scene = granite::scene(granite::make({.segments = 32, .width = 4.0, .fine_radius = 0.08}));
  scene.stress = granite::anisotropic;
  scene.damping = {0.0, 0.1};
  scene.law = find_law("linear");
  scene.cohesive = granite::cohesive();
  scene.insertion.on_demand = true;
  scene.fluid = CompressibleFluid{1.45e9, 1000.0, 0.0};
  scene.pump = Pump({{0.0, 2e-3, 0.065}});
  scene.fast_forward = fast_forward;
  return scene;
}

TEST(Ramp, IsTheRampOfSteps) {
  Simulation ramp(pumped_wellbore(true)), steps(pumped_wellbore(false));
  ASSERT_GT(ramp.ramp_end(), 0.5e-3);
  EXPECT_EQ(steps.ramp_end(), 0.0);
  const int rows = 10;  // each about one period of the wellbore
  const auto count =
      static_cast<int>(std::ceil(ramp.ramp_end() / (0.8 * steps.stable().limit) / rows)) * rows;
  const double dt = ramp.ramp_end() / count;
  double first = 0.0, worst = 0.0, residual = 0.0;
  ramp.ramp_to(0.0);
  for (int row = 1; row <= rows; ++row) {
    double mean = 0.0;  // over the row: steps ring a little
    for (int i = 0; i < count / rows; ++i) {
      mean += 0.5 * steps.wellbore_pressure() / (count / rows);
      steps.step(dt);
      mean += 0.5 * steps.wellbore_pressure() / (count / rows);
    }
    residual = std::max(residual, ramp.ramp_to((row - 0.5) * ramp.ramp_end() / rows).residual);
    const double miss = std::abs(ramp.wellbore_pressure() / mean - 1.0);
    if (row == 1) first = miss;  // the wave of the pump's start passes
    if (row > 1) worst = std::max(worst, miss);
  }
  ramp.ramp_to(ramp.ramp_end());
  std::printf(
      "ramp to %.3f ms, %.3f MPa (steps: %.3f); pressure within %.2f %% (in the first tenth %.2f %%), "
      "residual %.1e\n",
      1e3 * ramp.ramp_end(), 1e-6 * ramp.wellbore_pressure(), 1e-6 * steps.wellbore_pressure(), 100.0 * worst,
      100.0 * first, residual);
  EXPECT_LT(first, 0.03);
  EXPECT_LT(worst, 5e-3);
  EXPECT_LT(residual, 1e-3);
  EXPECT_EQ(ramp.state().cohesive.count(), 0) << "the ramp ends before the first insertion";
  // And the dynamics go on from there at rest with it: no wave starts.
  const double before = ramp.wellbore_pressure();
  const double rate =
      ramp.scene().pump.rate(0.0) * (before / (ramp.ramp_end() * ramp.scene().pump.rate(0.0)));
  for (int i = 0; i < count / rows; ++i) ramp.step(dt);
  const double expected = before + rate * dt * (count / rows);
  std::printf("a tenth later by steps %.3f MPa, the line goes to %.3f\n", 1e-6 * ramp.wellbore_pressure(),
              1e-6 * expected);
  EXPECT_NEAR(ramp.wellbore_pressure() / expected, 1.0, 5e-3);
}

// No ramp where the answer would be another: a cut crack, an absorbing boundary, elements everywhere.
TEST(Ramp, IsNotTakenWhereItDoesNotHold) {
  Scene cut = pumped_wellbore(true), absorbing = cut, all = cut, fast = cut;
  for (Index e = 0; e < cut.mesh->edge_count() && cut.cracks.empty(); ++e) {  // well inside
    const Edge& edge = cut.mesh->edges[granite::at(e)];
    if (edge.kind == EdgeKind::interior &&
        std::abs(norm(cut.mesh->vertices[granite::at(edge.vertex[0])]) - 0.5) < 0.2)
      cut.cracks.push_back(e);
  }
  absorbing.absorbing_boundary = true;
  all.insertion.on_demand = false;
  fast.pump = Pump({{0.0, 2e-3, 6.5}});
  EXPECT_EQ(Simulation(absorbing).ramp_end(), 0.0);
  EXPECT_EQ(Simulation(all).ramp_end(), 0.0);
  EXPECT_EQ(Simulation(fast).ramp_end(), 0.0);
  EXPECT_EQ(Simulation(cut).ramp_end(), 0.0);
}

}  // namespace
}  // namespace crackle
