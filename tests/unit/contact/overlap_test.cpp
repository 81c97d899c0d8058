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
  EXPECT_LT(most, 1e-15) << "J/m";
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

// Two triangles that meet in a vertex only, of their own each or one for both. They are thrown at one
// another, or close round the vertex like scissors.
TEST(ContactOverlap, TrianglesAtAVertexGainNoEnergy) {
  struct Throw {
    Vec2 velocity;
    double spin;  // of the first about the vertex, the second the other way [rad/s]
  };
  const auto run = [](bool shared, const Throw& thrown) {
    Mesh pair = together(
        {one_triangle({0, 0}, {-0.1, 0.05}, {-0.1, -0.05}), one_triangle({0, 0}, {0.1, -0.06}, {0.1, 0.05})});
    if (shared) {
      pair.vertices.erase(pair.vertices.begin() + 3);
      pair.triangles[1] = {0, 3, 4};
      build_edges(pair);
    }
    World world({pair}, {});
    world.dt *= 0.2;
    for (Index n = 0; n < world.state.node_count(); ++n) {
      const Vec2 x = world.state.node_reference(n);
      const Vec2 turned = thrown.spin * Vec2{-x.y, x.x};
      world.state.velocity[static_cast<std::size_t>(n)] = n < 3 ? thrown.velocity + turned : -turned;
    }
    const double start = world.step().mechanical();
    double error = 0.0;
    Index most = 0;
    for (int i = 0; i < 20000; ++i) {
      error = std::max(error, std::abs(world.step().mechanical() / start - 1.0));
      most = std::max(most, world.contacts());
    }
    std::printf(
        "  %s vertex, thrown (%.1f, %.1f), spin %.0f: energy off by %.2e at most, %d points in contact\n",
        shared ? "one" : "own", thrown.velocity.x, thrown.velocity.y, thrown.spin, error, most);
    ASSERT_TRUE(std::isfinite(world.step().mechanical()));
    EXPECT_GT(most, 0);
    EXPECT_LT(error, 2e-3);
  };
  run(false, {{1.0, 0.0}, 0.0});
  run(false, {{1.0, 0.1}, 5.0});
  run(false, {{0.8, -0.2}, -20.0});
  run(true, {{0.0, 0.0}, 10.0});
  run(true, {{0.0, 0.0}, -20.0});
}

}  // namespace
}  // namespace crackle::test
