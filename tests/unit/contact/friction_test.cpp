// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "../../result.hpp"
#include "crackle/seismic/slip_events.hpp"
#include "world.hpp"

namespace crackle::test {
namespace {

constexpr double g = 9.81;

WorldMaterial rough(double friction) {
  WorldMaterial m;
  m.contact.tan_friction = friction;
  m.damping_ratio = 0.2;
  return m;
}

// A block of 0.2 m x 0.1 m that lies on a fixed base cut into `cuts` sides, come to rest under a
// gravity that pulls straight down.
World block_on_base(double friction, int cuts) {
  World world({structured_rectangle({-0.1, 0.0}, {0.1, 0.1}, 3, 2, MeshPattern::cross),
               structured_rectangle({-0.3, -0.1}, {0.9, 0.0}, cuts, 1, MeshPattern::right)},
              rough(friction));
  world.fix(1);
  world.gravity = {0.0, -g};
  world.settle(0.15, 300.0);
  return world;
}

TEST(ContactFriction, StaysOnAGentleSlope) {
  World world = block_on_base(0.3, 13);
  const double slope = std::atan(0.27);
  world.gravity = g * Vec2{std::sin(slope), -std::cos(slope)};
  world.settle(0.2, 300.0);
  const double before = world.centre(0).x, start = world.state.time;
  while (world.state.time < start + 0.3) world.step();
  const double creep = std::abs(world.centre(0).x - before) / 0.3;
  std::printf("  tan theta 0.27 < mu 0.3: creeps at %.2e m/s\n", creep);
  EXPECT_LT(creep, 1e-6);
}

TEST(ContactFriction, SlidesDownASteepSlope) {
  const Check check("C  block that slides down a slope: acceleration");
  World world = block_on_base(0.3, 13);
  const double slope = std::acos(-1.0) / 6.0;
  world.gravity = g * Vec2{std::sin(slope), -std::cos(slope)};
  const auto run = [&](double duration) {
    for (const double end = world.state.time + duration; world.state.time < end;) world.step();
  };
  run(0.05);
  const double v = world.velocity(0).x, t = world.state.time;
  run(0.3);
  const double a = (world.velocity(0).x - v) / (world.state.time - t);
  const double exact = g * (std::sin(slope) - 0.3 * std::cos(slope));
  std::printf("  a = %.5f m/s2, exact %.5f: off by %.2e\n", a, exact, a / exact - 1.0);
  check.result(a / exact - 1.0);
  EXPECT_NEAR(a / exact, 1.0, 0.01);
}

// A block that is thrown over a base cut into sides a third as long as its way: one event, which has all of
// the friction, the block's length times its way, and what bears the block as stress drop at rest.
TEST(ContactFriction, SlidingIsOneSlipEvent) {
  World world = block_on_base(0.1, 37);
  const SeismicMedium medium{{1e8, 1e8}};
  const SlipRule rule{1e-3, 5e-4, 5e-3};
  world.throw_body(0, {0.5, 0.0});
  const double from = world.centre(0).x, friction = world.state.dissipation.friction;
  std::vector<SeismicEvent> events;
  for (const double end = world.state.time + 0.6; world.state.time < end;) {
    world.advance();
    const auto ended = track_slip(world.state.slips, sliding_sides(world.state, world.contact().slips()),
                                  {world.state.time, world.dt}, rule, medium);
    events.insert(events.end(), ended.begin(), ended.end());
  }
  EXPECT_TRUE(world.state.slips.edges.empty()) << "it has come to rest";
  ASSERT_FALSE(events.empty());
  const SeismicEvent& e = *std::ranges::max_element(events, {}, &SeismicEvent::friction_energy);
  double small = 0.0;
  for (const SeismicEvent& other : events) small += other.friction_energy;
  const double way = world.centre(0).x - from, rubbed = world.state.dissipation.friction - friction;
  std::printf(
      "  event of %d sides, %.4f s: slip times length %.6f of %.6f m2, friction %.5f (all %zu events %.5f) "
      "of %.5f J/m, stress drop %.1f Pa\n",
      e.edges, e.duration, e.length * std::abs(e.slip), 0.2 * way, e.friction_energy, events.size(), small,
      rubbed, e.stress_drop);
  EXPECT_GT(way, 0.1);
  EXPECT_NEAR(e.length * std::abs(e.slip) / (0.2 * way), 1.0, 0.02) << "it rocks: some of it lifts";
  EXPECT_NEAR(e.friction_energy / rubbed, 1.0, 0.01);
  EXPECT_NEAR(scalar_moment(e.moment) / (1e8 * e.length * std::abs(e.slip)), 1.0, 1e-3);
  EXPECT_EQ(e.kind, EventKind::slip);
}

struct Slide {
  double distance, time, lost, rubbed, damped, bump;
};

Slide slide_to_rest(int cuts) {
  World world = block_on_base(0.5, cuts);
  world.dt *=
      0.2;  // the viscous share, booked at the start of each step, is half as large again at the full one
  world.throw_body(0, {1.0, 0.0});
  const double start = world.state.time, from = world.centre(0).x;
  const double friction = world.state.dissipation.friction, viscous = world.state.dissipation.viscous;
  const double energy = world.step().mechanical();
  Slide s{};
  while (world.velocity(0).x > 0.0 && world.state.time < start + 1.0) {
    world.step();
    // Once the block has come to terms with the sudden start, and before it stops.
    const double t = world.state.time - start;
    if (t > 0.1 && t < 0.19) s.bump = std::max(s.bump, std::abs(world.velocity(0).y));
  }
  s.time = world.state.time - start;
  s.distance = world.centre(0).x - from;
  s.lost = energy - world.step().mechanical();
  s.rubbed = world.state.dissipation.friction - friction;
  s.damped = world.state.dissipation.viscous - viscous;
  return s;
}

TEST(ContactFriction, SlidesToRest) {
  const Check check("C  block that slides to rest: distance");
  double worst = 0.0;
  double uncut = 0.0;
  for (const int cuts : {2, 5, 13, 37}) {
    const Slide s = slide_to_rest(cuts);
    std::printf(
        "  base of %2d sides: distance %.6f m (exact 0.10194), time %.5f s (0.20387), friction %.5f + "
        "viscous "
        "%.5f of %.5f J/m, normal velocity at most %.1e m/s\n",
        cuts, s.distance, s.time, s.rubbed, s.damped, s.lost, s.bump);
    worst = std::max(worst, std::abs(s.distance / 0.101936 - 1.0));
    EXPECT_NEAR(s.distance / 0.101936, 1.0, 0.001);
    EXPECT_NEAR(s.time / 0.203874, 1.0, 0.01);
    EXPECT_NEAR((s.rubbed + s.damped) / s.lost, 1.0, 0.001);
    EXPECT_NEAR(s.rubbed / s.lost, 1.0, 0.005);
    // The elastic block rocks; that it passes from side to side must not add to it.
    if (cuts == 2) uncut = s.bump;
    EXPECT_LE(s.bump, uncut);
  }
  check.result(worst);
}

TEST(ContactFriction, DissipationNeverFalls) {
  World world = block_on_base(0.5, 13);
  world.throw_body(0, {0.5, -0.2});
  double before = world.state.dissipation.friction, least = 0.0;
  for (int i = 0; i < 2000; ++i) {
    world.step();
    least = std::min(least, world.state.dissipation.friction - before);
    before = world.state.dissipation.friction;
  }
  EXPECT_EQ(least, 0.0);
}

}  // namespace
}  // namespace crackle::test
