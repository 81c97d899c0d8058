// SPDX-License-Identifier: GPL-3.0-or-later
#include "crackle/seismic/clusters.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>
#include <stdexcept>

#include "crackle/seismic/listener.hpp"

namespace crackle {
namespace {

constexpr Lame granite{16.2e9, 13.8e9};

SeismicEvent event(double time, Vec2 place) {
  SeismicEvent e;
  e.time = time;
  e.place = place;
  e.length = 3e-3;
  e.opening = 5e-6;
  e.energy = 0.01;
  e.fracture_energy = 0.015;
  e.moment = moment_of_jump(granite, {1.0, 0.0}, e.length, e.opening, e.slip);
  return e;
}

TEST(Clusters, AChainIsOne) {
  std::vector<SeismicEvent> events;
  events.reserve(10);
  for (int i = 0; i < 10; ++i) events.push_back(event(i * 1e-6, {i * 3e-3, 0.0}));
  const auto clusters = cluster_events(events, {3.1e-3, 1.1e-6}, 2.0);
  ASSERT_EQ(clusters.size(), 1U);
  const Cluster& c = clusters.front();
  EXPECT_EQ(c.events.size(), 10U);
  EXPECT_EQ(c.time, 0.0);
  EXPECT_NEAR(c.duration, 9e-6, 1e-18);
  EXPECT_NEAR(c.place.x, 13.5e-3, 1e-15);
  EXPECT_NEAR(c.length, 0.03, 1e-15);
  EXPECT_NEAR(c.opened, 0.03 * 5e-6, 1e-18);
  EXPECT_NEAR(c.dissipated, 0.15, 1e-14);
  EXPECT_NEAR(c.magnitude, magnitude_of_energy(0.1 * 2.0), 1e-12);
  const SeismicEvent whole = as_event(c, events);
  EXPECT_EQ(whole.edges, 10);
  EXPECT_EQ(whole.kind, EventKind::breaking);
  EXPECT_EQ(whole.mode, FailureMode::tensile);
  EXPECT_NEAR(whole.opening, 5e-6, 1e-18);
  EXPECT_NEAR(whole.fracture_energy, 0.15, 1e-14);
  EXPECT_EQ(whole.moment, c.moment);
  EXPECT_NEAR(c.moment_magnitude, moment_magnitude(10.0 * scalar_moment(events[0].moment) * 2.0), 1e-12);
}

TEST(Clusters, DistanceAndTimeBothPart) {
  const std::vector<SeismicEvent> events{event(0.0, {0.0, 0.0}), event(0.0, {1.0, 0.0}),
                                         event(5e-6, {0.0, 0.0}), event(5.9e-6, {0.9e-3, 0.0})};
  const auto clusters = cluster_events(events, {1e-3, 1e-6}, 1.0);
  ASSERT_EQ(clusters.size(), 3U);
  EXPECT_EQ(clusters[0].events, std::vector<Index>{0});
  EXPECT_EQ(clusters[1].events, std::vector<Index>{1});
  EXPECT_EQ(clusters[2].events, (std::vector<Index>{2, 3}));
}

// A slip that lasts holds the door open for what follows its end, past others that came and went.
TEST(Clusters, ASlipLastsUntilItsEnd) {
  std::vector<SeismicEvent> events{event(0.0, {0.0, 0.0}), event(1e-6, {9.0, 0.0}), event(50e-6, {0.0, 0.0})};
  EXPECT_EQ(cluster_events(events, {1e-3, 2e-6}, 1.0).size(), 3U);
  events[0].kind = EventKind::slip;
  events[0].duration = 49e-6;
  EXPECT_EQ(cluster_events(events, {1e-3, 2e-6}, 1.0).size(), 2U);
}

TEST(Clusters, ConserveMomentAndEnergy) {
  std::mt19937_64 random(5);
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
  };
  std::vector<SeismicEvent> events;
  MomentTensor moment;
  double energy = 0.0, dissipated = 0.0, length = 0.0;
  for (int i = 0; i < 3000; ++i) {
    SeismicEvent e = event(uniform(0.0, 1e-3), {uniform(-0.3, 0.3), uniform(-0.3, 0.3)});
    e.opening = uniform(0.0, 1e-5);
    e.slip = uniform(-1e-5, 1e-5);
    e.energy = uniform(0.0, 0.1);
    e.friction_energy = uniform(0.0, 0.01);
    e.moment = moment_of_jump(granite, {uniform(-1.0, 1.0), uniform(-1.0, 1.0)}, e.length, e.opening, e.slip);
    moment += e.moment;
    energy += e.energy;
    dissipated += e.fracture_energy + e.friction_energy;
    length += e.length;
    events.push_back(e);
  }
  const auto clusters = cluster_events(events, {0.03, 5e-5}, 1.0);
  std::vector<int> seen(events.size());
  for (const Cluster& c : clusters) {
    for (const Index i : c.events) ++seen[static_cast<std::size_t>(i)];
    moment += {-c.moment.xx, -c.moment.yy, -c.moment.zz, -c.moment.xy};
    energy -= c.energy;
    dissipated -= c.dissipated;
    length -= c.length;
  }
  EXPECT_EQ(seen, std::vector<int>(events.size(), 1)) << "every event in exactly one";
  const double lost = scalar_moment(moment) / (3000 * scalar_moment(event(0.0, {}).moment));
  std::printf("%zu clusters of 3000 events: moment lost %.1e, energy lost %.1e of all\n", clusters.size(),
              lost, energy / 150.0);
  EXPECT_GT(clusters.size(), 10U);
  EXPECT_LT(clusters.size(), 2900U);
  const double round_off = 3000 * 1.1e-16;  // of a sum in another order
  EXPECT_LT(lost, round_off);
  EXPECT_LT(std::abs(energy / 150.0), round_off);
  EXPECT_LT(std::abs(dissipated / 60.0), round_off);
  EXPECT_LT(std::abs(length / 9.0), round_off);

  // the sets do not depend on the order of the catalog
  std::vector<SeismicEvent> reversed(events.rbegin(), events.rend());
  const auto again = cluster_events(reversed, {0.03, 5e-5}, 1.0);
  const auto sizes = [](const std::vector<Cluster>& all) {
    std::vector<std::size_t> s;
    s.reserve(all.size());
    for (const Cluster& c : all) s.push_back(c.events.size());
    std::sort(s.begin(), s.end());
    return s;
  };
  EXPECT_EQ(sizes(clusters), sizes(again));
}

TEST(Clusters, OfNothing) {
  EXPECT_TRUE(cluster_events({}, {1.0, 1.0}, 1.0).empty());
  EXPECT_THROW(cluster_events({}, {-1.0, 1.0}, 1.0), std::invalid_argument);
  EXPECT_THROW(cluster_events({}, {1.0, std::nan("")}, 1.0), std::invalid_argument);
}

}  // namespace
}  // namespace crackle
