// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "../../result.hpp"
#include "world.hpp"

namespace crackle::test {
namespace {

class ContactStack : public testing::TestWithParam<int> {};

TEST_P(ContactStack, BaseBearsTheWeight) {
  const int n = GetParam();
  const Check check("C  stack of " + std::to_string(n) + " blocks: force on the base");
  std::vector<Mesh> bodies{structured_rectangle({-0.2, -0.1}, {0.2, 0.0}, 5, 1, MeshPattern::right)};
  for (int i = 0; i < n; ++i) {
    bodies.push_back(
        structured_rectangle({-0.1, 0.1 * i}, {0.1, 0.1 * (i + 1)}, 2 + i % 2, 1, MeshPattern::cross));
  }
  WorldMaterial material;
  material.contact.tan_friction = 0.5;
  World world(bodies, material);
  world.fix(0);
  world.gravity = {0.0, -9.81};
  world.settle(0.5, 150.0);
  double weight = 0.0, fastest = 0.0;
  for (int i = 1; i <= n; ++i) weight += 9.81 * world.mass(static_cast<std::size_t>(i));
  for (const Vec2 v : world.state.velocity) fastest = std::max(fastest, norm(v));
  const double base = -world.vertical_force(0);
  std::printf("  %d blocks: base bears %.4f N/m of %.4f, off by %.2e; fastest node %.2e m/s\n", n, base,
              weight, base / weight - 1.0, fastest);
  check.result(base / weight - 1.0);
  EXPECT_NEAR(base / weight, 1.0, 1e-3);
  EXPECT_LT(fastest, 1e-5);
}

INSTANTIATE_TEST_SUITE_P(Heights, ContactStack, testing::Values(3, 4, 5));

// A block thrown onto a base of some 350 free sides, so that there is work for two threads.
World thrown_block() {
  WorldMaterial material;
  material.contact.tan_friction = 0.4;
  World world(
      {placed(structured_rectangle({-0.1, 0.0}, {0.1, 0.1}, 9, 5, MeshPattern::cross), 0.1, {0.0, 0.011}),
       structured_rectangle({-0.3, -0.02}, {0.7, 0.0}, 150, 3, MeshPattern::right)},
      material);
  world.throw_body(0, {1.0, -1.0});
  world.gravity = {0.0, -9.81};
  return world;
}

TEST(ContactBits, SameForAnyNumberOfThreads) {
  const int before = omp_get_max_threads();
  std::vector<std::vector<Vec2>> results;
  Index contacts = 0;
  for (const int threads : {1, 2}) {
    omp_set_num_threads(threads);
    World world = thrown_block();
    for (int i = 0; i < 800; ++i) {
      world.step();
      contacts = std::max(contacts, world.contacts());
    }
    results.push_back(world.state.displacement);
  }
  omp_set_num_threads(before);
  EXPECT_GT(contacts, 0);
  EXPECT_TRUE(results[0] == results[1]);
}

TEST(ContactBits, SameAfterARestart) {
  World whole = thrown_block(), cut = thrown_block();
  for (int i = 0; i < 800; ++i) {
    whole.step();
    cut.step();
    if (i % 7 == 0) cut.restart();
  }
  EXPECT_TRUE(whole.state.displacement == cut.state.displacement);
  EXPECT_EQ(whole.state.dissipation.friction, cut.state.dissipation.friction);
}

}  // namespace
}  // namespace crackle::test
