// SPDX-License-Identifier: GPL-3.0-or-later
//
// Joints that slide by hand: a row of edges along x, edge i from vertex i to vertex i + 1.
#include "crackle/seismic/slip_events.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <functional>
#include <stdexcept>

namespace crackle {
namespace {

constexpr SeismicMedium granite{{16.2e9, 13.8e9}, 1.0};
constexpr double dt = 1e-7, h = 3e-3;
constexpr SlipRule rule{1e-2, 5e-3, 2.5e-7};

/// A row of edges, each with a slip rate in time; steps through it.
class Row {
 public:
  explicit Row(int count) {
    for (Index i = 0; i < count; ++i) {
      SlidingEdge e;
      e.edge = 10 + i;
      e.vertex = {i, i + 1};
      e.place = {(i + 0.5) * h, 0.0};
      e.direction = {h, 0.0};
      e.length = h;
      e.traction = 5e6;
      edges.push_back(e);
    }
  }

  /// One step. @param rate of the edge number i [m/s]
  std::vector<SeismicEvent> step(const std::function<double(int)>& rate) {
    clock.time += dt;
    for (std::size_t i = 0; i < edges.size(); ++i) {
      SlidingEdge& e = edges[i];
      e.slip_rate = rate(static_cast<int>(i));
      e.slip += e.slip_rate * dt;
      e.traction -= 1e11 * e.slip_rate * dt;
      e.friction_work = std::abs(e.traction * e.slip_rate) * dt * h;
    }
    return track_slip(memory, edges, clock, rule, granite);
  }

  SlipMemory memory;
  std::vector<SlidingEdge> edges;
  StepTime clock{0.0, dt};
};

TEST(SlipEvents, StartsAndStops) {
  Row row(5);
  std::vector<SeismicEvent> events;
  for (int n = 0; n < 40; ++n) {
    // edges 1 to 3 slide from step 10 to 19
    for (SlidingEdge& e : row.edges) e.kinetic = 2.0 + (n == 15 ? 0.5 : 0.0);
    for (const SeismicEvent& e :
         row.step([&](int i) { return i >= 1 && i <= 3 && n >= 10 && n < 20 ? 0.1 * i : 0.0; })) {
      events.push_back(e);
      EXPECT_EQ(n, 22) << "when it has been quiet for two steps and a half";
    }
  }
  ASSERT_EQ(events.size(), 1U);
  const SeismicEvent& e = events.front();
  EXPECT_EQ(e.kind, EventKind::slip);
  EXPECT_EQ(e.mode, FailureMode::shear);
  EXPECT_EQ(e.edges, 3);
  EXPECT_EQ(e.edge, 11);
  EXPECT_NEAR(e.time, 1.0e-6, 1e-18);
  EXPECT_NEAR(e.duration, 1.0e-6, 1e-18);
  EXPECT_NEAR(e.length, 3 * h, 1e-15);
  const double mean = 0.2 * 10 * dt;
  EXPECT_NEAR(e.slip, mean, 1e-18);
  EXPECT_NEAR(e.place.x, (1.5 * 1 + 2.5 * 2 + 3.5 * 3) / 6.0 * h, 1e-15);
  // nine of ten steps: the traction at the start is that of the first step
  EXPECT_NEAR(e.stress_drop, 1e11 * 0.9 * mean, 1e-3);
  double work = 0.0;
  for (int i = 1; i <= 3; ++i) {
    for (int k = 1; k <= 10; ++k) work += (5e6 - 1e11 * 0.1 * i * k * dt) * 0.1 * i * dt * h;
  }
  std::printf("work of friction: error %.1e\n", std::abs(e.friction_energy / work - 1.0));
  EXPECT_NEAR(e.friction_energy / work, 1.0, 1e-12);
  EXPECT_NEAR(e.energy, 3 * 0.5, 1e-12);
  EXPECT_NEAR(scalar_moment(e.moment), granite.rock.shear_modulus * 3 * h * mean, 1e-9);
  EXPECT_NEAR(moment_shares(e.moment).dc, 1.0, 1e-12);
  EXPECT_TRUE(row.memory.edges.empty());
  EXPECT_TRUE(row.memory.events.empty());
}

TEST(SlipEvents, ApartTheyAreTwo) {
  Row row(7);
  for (int n = 0; n < 5; ++n) row.step([](int i) { return i == 1 || i == 5 ? 0.1 : 0.0; });
  EXPECT_EQ(row.memory.events.size(), 2U);
  const auto events = finish_slip(row.memory, granite);
  ASSERT_EQ(events.size(), 2U);
  EXPECT_EQ(events[0].edge, 11);
  EXPECT_EQ(events[1].edge, 15);
}

// Two that grow towards each other become one, with everything that both have done.
TEST(SlipEvents, ThatMeetBecomeOne) {
  Row row(9);
  std::vector<SeismicEvent> events;
  double work = 0.0;
  for (SlidingEdge& e : row.edges) e.traction = -5e6;
  for (int n = 0; n < 30; ++n) {
    for (SlidingEdge& e : row.edges) e.kinetic = n == 2 ? 1.0 : 0.0;
    const auto rate = [&](int i) { return n < 10 && (i <= n || 8 - i <= n) ? -0.1 : 0.0; };
    for (const SeismicEvent& e : row.step(rate)) events.push_back(e);
    for (const SlidingEdge& e : row.edges) work += e.friction_work;
  }
  ASSERT_EQ(events.size(), 1U);
  EXPECT_EQ(events[0].edges, 9);
  EXPECT_EQ(events[0].edge, 10);
  EXPECT_NEAR(events[0].time, 0.0, 1e-18);
  EXPECT_NEAR(events[0].friction_energy / work, 1.0, 1e-12);
  EXPECT_LT(events[0].slip, 0.0);
  EXPECT_GT(events[0].stress_drop, 0.0) << "whatever the direction of slip";
  EXPECT_NEAR(events[0].energy, 2.0, 1e-12)
      << "of the larger: in step 2 each had two edges from before, at rest then";
}

TEST(SlipEvents, SmallRatesStartNothingButKeepOneGoing) {
  Row row(3);
  for (int n = 0; n < 10; ++n) row.step([](int) { return 0.9e-2; });
  EXPECT_TRUE(row.memory.edges.empty());
  row.step([](int i) { return i == 1 ? 1.1e-2 : 0.0; });
  for (int n = 0; n < 10; ++n) EXPECT_TRUE(row.step([](int i) { return i == 1 ? 0.6e-2 : 0.0; }).empty());
  EXPECT_EQ(row.memory.edges.size(), 1U);
  int ended = 0;
  for (int n = 0; n < 10; ++n) {
    ended += static_cast<int>(row.step([](int i) { return i == 1 ? 0.4e-2 : 0.0; }).size());
  }
  EXPECT_EQ(ended, 1);
}

TEST(SlipEvents, AStickSlipIsTwo) {
  Row row(2);
  std::vector<SeismicEvent> events;
  for (int n = 0; n < 60; ++n) {
    for (const SeismicEvent& e : row.step([&](int i) { return i == 0 && n / 10 % 2 == 1 ? 0.1 : 0.0; })) {
      events.push_back(e);
    }
  }
  ASSERT_EQ(events.size(), 2U);
  EXPECT_NEAR(events[0].time, 1e-6, 1e-15);
  EXPECT_NEAR(events[1].time, 3e-6, 1e-15);
  for (const SeismicEvent& e : events) EXPECT_NEAR(e.slip, 0.1 * 10 * dt, 1e-18);
}

TEST(SlipEvents, EdgesComeInOrder) {
  Row row(2);
  std::swap(row.edges[0], row.edges[1]);
  EXPECT_THROW(row.step([](int) { return 0.0; }), std::invalid_argument);
}

}  // namespace
}  // namespace crackle
