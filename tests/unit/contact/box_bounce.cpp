// SPDX-License-Identifier: GPL-3.0-or-later
#include "box_bounce.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "../../result.hpp"
#include "world.hpp"

namespace crackle::test {
namespace {

Mesh slab(double width, double height) {
  return structured_rectangle({-0.5 * width, -0.5 * height}, {0.5 * width, 0.5 * height}, 1, 1,
                              MeshPattern::right);
}

}  // namespace

void bounce_in_box(int bounces, double fraction_of_step) {
  const Check check("C  restitution, " + std::to_string(bounces) + " bounces in a box");
  const double room = 0.13, thick = 0.3, overlap = 0.05;  // walls that overlap leave no slit
  const double wide = room + 2 * thick, off = 0.5 * (room + thick);
  World world(
      {one_triangle({-0.05, -0.04}, {0.05, -0.03}, {0.01, 0.05}), placed(slab(wide, thick), 0.0, {0.0, -off}),
       placed(slab(wide, thick), 0.0, {0.0, off}), placed(slab(thick, room + 2 * overlap), 0.0, {-off, 0.0}),
       placed(slab(thick, room + 2 * overlap), 0.0, {off, 0.0})},
      {});
  for (std::size_t wall = 1; wall < 5; ++wall) world.fix(wall);
  world.dt *= fraction_of_step;
  world.throw_body(0, {2.0, 1.3});
  const double start = world.step().mechanical();
  int done = 0;
  bool touching = false;
  double most = 0.0;
  while (done < bounces) {
    world.advance();
    const bool now = world.contacts() > 0;
    if (touching && !now) {
      ++done;
      most = std::max(most, std::abs(std::sqrt(world.step().mechanical() / start) - 1.0));
    }
    touching = now;
    ASSERT_LT(world.state.step, 10000LL * bounces) << done << " bounces only";
    const Vec2 x = world.centre(0);
    ASSERT_TRUE(std::abs(x.x) < 0.5 * room && std::abs(x.y) < 0.5 * room)
        << "left the box after " << done << " bounces";
  }
  std::printf("  %d bounces, %lld steps: |e - 1| %.2e at most\n", bounces,
              static_cast<long long>(world.state.step), most);
  check.result(most);
  EXPECT_LT(most, 1e-3);
}

}  // namespace crackle::test
