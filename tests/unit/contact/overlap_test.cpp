// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>

#include "world.hpp"

namespace crackle::test {
namespace {

Mesh square(double size) {
  return structured_rectangle({-0.5 * size, -0.5 * size}, {0.5 * size, 0.5 * size}, 2, 2, MeshPattern::cross);
}

// Two blocks that overlap from the start bear nothing, and only as much as they are pressed further.
TEST(ContactOverlap, BornOverlappedBearsNothing) {
  World world({square(0.2), placed(square(0.2), 0.0, {0.198, 0.03})}, {});
  double most = 0.0;
  for (int i = 0; i < 500; ++i) most = std::max(most, world.step().mechanical());
  EXPECT_EQ(most, 0.0);
  world.dt *= 0.3;
  world.throw_body(0, {0.3, 0.0});
  const double start = world.step().mechanical();
  double error = 0.0;
  for (int i = 0; i < 5000; ++i) error = std::max(error, world.step().mechanical() / start - 1.0);
  std::printf("  pressed further: energy rises by %.2e at most; second block gets %.3f m/s\n", error,
              world.velocity(1).x);
  EXPECT_LT(error, 1e-3);
  EXPECT_GT(world.velocity(1).x, 0.1);
}

// Two triangles that meet in a vertex only, of their own each or one for both.
TEST(ContactOverlap, TrianglesAtAVertexGainNoEnergy) {
  for (const bool shared : {false, true}) {
    for (const Vec2 v : {Vec2{1.0, 0.0}, Vec2{-0.3, 0.9}, Vec2{0.7, 0.7}, Vec2{0.8, -0.5}}) {
      Mesh pair = together({one_triangle({0, 0}, {-0.1, 0.05}, {-0.1, -0.05}),
                            one_triangle({0, 0}, {0.1, -0.06}, {0.1, 0.05})});
      if (shared) {
        pair.triangles[1][0] = 0;
        build_edges(pair);
      }
      World world({pair}, {});
      world.dt *= 0.2;
      for (Index i = 0; i < 3; ++i) {
        world.state
            .velocity[static_cast<std::size_t>(world.state.node_of_corner[static_cast<std::size_t>(i)])] = v;
      }
      const double start = world.step().mechanical();
      double error = 0.0;
      for (int i = 0; i < 20000; ++i)
        error = std::max(error, std::abs(world.step().mechanical() / start - 1.0));
      std::printf("  %s vertex, thrown (%.1f, %.1f): energy off by %.2e at most\n", shared ? "one" : "own",
                  v.x, v.y, error);
      EXPECT_LT(error, 2e-3);
    }
  }
}

}  // namespace
}  // namespace crackle::test
