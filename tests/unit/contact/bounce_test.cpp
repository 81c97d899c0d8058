// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "world.hpp"

namespace crackle::test {
namespace {

Mesh block(double width, double height, int nx, int ny) {
  return structured_rectangle({-0.5 * width, -0.5 * height}, {0.5 * width, 0.5 * height}, nx, ny,
                              MeshPattern::right);
}

// A triangle thrown about in a box of fixed walls. A bounce errs by the place of first touch in a
// step, which is of order (ωΔt)² and random; hence a small step.
void bounce_in_box(int bounces, double fraction_of_step) {
  const double room = 0.16, thick = 0.3, gap = 0.001;
  const double wide = room + 2 * thick, off = 0.5 * (room + thick);
  World world(
      {one_triangle({-0.05, -0.04}, {0.05, -0.03}, {0.01, 0.05}),
       placed(block(wide, thick, 1, 1), 0.0, {0.0, -off}), placed(block(wide, thick, 1, 1), 0.0, {0.0, off}),
       placed(block(thick, room - 2 * gap, 1, 1), 0.0, {-off, 0.0}),
       placed(block(thick, room - 2 * gap, 1, 1), 0.0, {off, 0.0})},
      {});
  for (std::size_t wall = 1; wall < 5; ++wall) world.fix(wall);
  world.dt *= fraction_of_step;
  world.throw_body(0, {2.0, 1.3});
  const double start = world.step().mechanical();
  int done = 0;
  bool touching = false;
  double most = 0.0;
  while (done < bounces) {
    const double energy = world.step().mechanical();
    const bool now = !world.state.contact.points.empty();
    if (touching && !now) {
      ++done;
      most = std::max(most, std::abs(std::sqrt(energy / start) - 1.0));
    }
    touching = now;
    ASSERT_LT(world.state.step, 10000LL * bounces) << done << " bounces only";
    const Vec2 x = world.centre(0);
    ASSERT_TRUE(std::abs(x.x) < 0.5 * room && std::abs(x.y) < 0.5 * room)
        << "left the box after " << done << " bounces";
  }
  std::printf("  %d bounces, %lld steps: |e - 1| %.2e at most\n", bounces,
              static_cast<long long>(world.state.step), most);
  EXPECT_LT(most, 1e-3);
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
