// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "box_bounce.hpp"
#include "world.hpp"

namespace crackle::test {
namespace {

Mesh block(double width, double height, int nx, int ny) {
  return structured_rectangle({-0.5 * width, -0.5 * height}, {0.5 * width, 0.5 * height}, nx, ny,
                              MeshPattern::right);
}

TEST(ContactBounce, TriangleKeepsItsEnergyOver1000Bounces) { bounce_in_box(1000, 0.1); }

// Two blocks that meet off their middle, both free.
TEST(ContactBounce, FreeBlocksKeepMomentumAndEnergy) {
  World world(
      {placed(block(0.2, 0.2, 2, 2), 0.3, {-0.16, 0.03}), placed(block(0.3, 0.2, 3, 2), -0.2, {0.16, -0.04})},
      {});
  world.dt *= 0.5;
  world.throw_body(0, {1.0, 0.0});
  world.throw_body(1, {-0.5, 0.2});
  const Vec2 before = world.momentum(0) + world.momentum(1);
  const double scale = norm(world.momentum(0)) + norm(world.momentum(1));
  const double start = world.step().mechanical();
  const auto angular = [&] {
    double sum = 0.0;
    for (Index n = 0; n < world.state.node_count(); ++n) {
      const std::size_t i = static_cast<std::size_t>(n);
      // at the middle of the step, where velocities are
      const Vec2 x = world.state.node_reference(n) + world.state.displacement[i] -
                     (0.5 * world.dt) * world.state.velocity[i];
      sum += cross(x, world.state.velocity[i]) / world.state.inverse_mass[i];
    }
    return sum;
  };
  const double angular_before = angular();
  double momentum_error = 0.0, energy_error = 0.0;
  Index most_points = 0;
  for (int i = 0; i * world.dt < 0.6; ++i) {
    energy_error = std::max(energy_error, std::abs(world.step().mechanical() / start - 1.0));
    momentum_error = std::max(momentum_error, norm(world.momentum(0) + world.momentum(1) - before) / scale);
    most_points = std::max(most_points, world.contacts());
  }
  const double angular_after = angular();
  const double angular_scale = 0.2 * scale;
  std::printf("  momentum %.2e, moment of momentum %.2e, energy %.2e, %d points in contact at most\n",
              momentum_error, std::abs(angular_after - angular_before) / angular_scale, energy_error,
              most_points);
  EXPECT_GT(most_points, 0);
  EXPECT_GT(world.momentum(1).x, 0.0) << "the second block was pushed back";
  EXPECT_LT(momentum_error, 1e-12);
  EXPECT_LT(std::abs(angular_after - angular_before) / angular_scale, 1e-9);
  EXPECT_LT(energy_error, 1e-3);
}

// Flat against flat, and the wall cut otherwise than the block.
TEST(ContactBounce, FlatBlockComesBackWithItsEnergy) {
  World world({block(0.2, 0.1, 2, 1), placed(block(1.0, 0.2, 7, 1), 0.0, {0.0, -0.2})}, {});
  world.fix(1);
  world.throw_body(0, {0.0, -1.0});
  world.dt *= 0.1;
  const double start = world.step().mechanical();
  double energy = 0.0, error = 0.0;
  bool touched = false;
  for (int i = 0; i * world.dt < 0.4; ++i) {
    energy = world.step().mechanical();
    error = std::max(error, std::abs(energy / start - 1.0));
    touched = touched || world.contacts() > 0;
  }
  std::printf("  energy returned: %.2e off at the end, %.2e at most on the way\n",
              std::abs(energy / start - 1.0), error);
  EXPECT_TRUE(touched);
  EXPECT_GT(world.momentum(0).y, 0.0);
  EXPECT_LT(std::abs(energy / start - 1.0), 1e-4);
}

}  // namespace
}  // namespace crackle::test
