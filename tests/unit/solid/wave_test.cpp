// SPDX-License-Identifier: GPL-3.0-or-later
//
// Speeds of P and S waves in a strip with rollers (validation.md A4), by the way of the pulse's centre.
#include <gtest/gtest.h>

#include "../../granite.hpp"
#include "../../result.hpp"

namespace crackle {
namespace {

using granite::at;

// A pulse that runs along x, moving the rock along `motion`; sides at y = 0 and 0.05 m move only that way.
double speed_error(Vec2 motion, double exact, const PlaneStiffness& stiffness = granite::stiffness()) {
  Mesh strip = jittered(structured_rectangle({0, 0}, {1, 0.05}, 200, 10, MeshPattern::cross), 0.2, 4);
  Scene scene = granite::scene(granite::free_body(std::move(strip)));
  scene.stiffness = stiffness;
  Simulation simulation(scene);
  State& state = simulation.state();
  const double dt = 0.8 * simulation.stable().limit;
  const double width = 0.04, start = 0.25;
  const auto shape = [&](double x) { return 1e-6 * std::exp(-0.5 * std::pow((x - start) / width, 2)); };
  const auto slope = [&](double x) { return -(x - start) / (width * width) * shape(x); };
  const auto across = [&](Vec2 v) { return dot(v, motion) * motion; };
  std::vector<std::size_t> rollers;
  for (Index n = 0; n < state.node_count(); ++n) {
    const Vec2 x = state.node_reference(n);
    state.displacement[at(n)] = shape(x.x) * motion;
    state.velocity[at(n)] = (-exact * slope(x.x + 0.5 * exact * dt)) * motion;
    if (x.y == 0.0 || x.y == 0.05) rollers.push_back(at(n));
  }
  const auto centre = [&] {
    double sum = 0.0, moment = 0.0;
    for (Index n = 0; n < state.node_count(); ++n) {
      const double kinetic = dot(state.velocity[at(n)], state.velocity[at(n)]) / state.inverse_mass[at(n)];
      sum += kinetic;
      moment += kinetic * state.node_reference(n).x;
    }
    return moment / sum;
  };
  const double from = centre();
  const int steps = static_cast<int>(0.5 / (exact * dt));
  for (int i = 0; i < steps; ++i) {
    simulation.step(dt);
    for (const std::size_t n : rollers) {
      state.velocity[n] = across(state.velocity[n]);
      state.displacement[n] = across(state.displacement[n]);
    }
  }
  return (centre() - from) / (steps * dt) / exact - 1.0;
}

TEST(Wave, SpeedOfP) {
  const Check check("A4 speed of P waves");
  const double error = speed_error({1, 0}, 4182.58);
  std::printf("P wave: speed %+.3f %%\n", 100 * error);
  check.result(error);
  EXPECT_LT(std::abs(error), 0.01);
}

TEST(Wave, SpeedOfS) {
  const Check check("A4 speed of S waves");
  const double error = speed_error({0, 1}, 2347.72);
  std::printf("S wave: speed %+.3f %%\n", 100 * error);
  check.result(error);
  EXPECT_LT(std::abs(error), 0.01);
}

// The shale of validation.md A5: P waves along and across its bedding, and S waves.
TEST(Wave, SpeedsInBeddedRock) {
  const Check check("A5 speeds of waves in bedded rock");
  const TransverseIsotropy level{40e9, 20e9, 0.2, 0.25, 9e9, 0.0};
  TransverseIsotropy upright = level;
  upright.bedding_angle = 0.5 * std::numbers::pi;
  const double along = std::sqrt(53.030303e9 / granite::density),
               across = std::sqrt(29.090909e9 / granite::density), shear = std::sqrt(9e9 / granite::density);
  const double errors[] = {speed_error({1, 0}, along, transversely_isotropic_plane_strain(level)),
                           speed_error({1, 0}, across, transversely_isotropic_plane_strain(upright)),
                           speed_error({0, 1}, shear, transversely_isotropic_plane_strain(level))};
  std::printf("bedded rock: P along %+.3f %%, P across %+.3f %%, S %+.3f %%\n", 100 * errors[0],
              100 * errors[1], 100 * errors[2]);
  check.result(std::max({std::abs(errors[0]), std::abs(errors[1]), std::abs(errors[2])}));
  for (const double error : errors) EXPECT_LT(std::abs(error), 0.01);
}

}  // namespace
}  // namespace crackle
