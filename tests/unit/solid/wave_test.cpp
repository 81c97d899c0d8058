// SPDX-License-Identifier: GPL-3.0-or-later
//
// Speeds of P and S waves in a strip with rollers, by the way of the pulse's centre, and of Rayleigh waves
// along a free surface that a line force hits, by arrivals (validation.md A4).
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

// Vertical velocity in time at places of the surface, after a Ricker pulse of force at x = 0.
std::vector<std::vector<double>> lamb_records(const std::vector<double>& places, double wave_length,
                                              double dt_share, double end, double& dt) {
  Scene scene = granite::scene(
      granite::free_body(structured_rectangle({-0.6, -0.9}, {1.5, 0.0}, 210, 90, MeshPattern::right)));
  Simulation simulation(scene);
  State& state = simulation.state();
  dt = dt_share * simulation.stable().limit;
  const auto node_near = [&](double x) {
    Index best = 0;
    for (Index n = 0; n < state.node_count(); ++n) {
      if (norm(state.node_reference(n) - Vec2{x, 0.0}) < norm(state.node_reference(best) - Vec2{x, 0.0}))
        best = n;
    }
    return at(best);
  };
  const std::size_t source = node_near(0.0);
  std::vector<std::size_t> stations;
  for (const double x : places) stations.push_back(node_near(x));
  const double period = wave_length / 2166.14;
  std::vector<std::vector<double>> records(places.size());
  while (state.time < end) {
    const double a = std::pow(std::numbers::pi * (state.time / period - 1.5), 2);
    state.velocity[source].y -= dt * 1e3 * (1.0 - 2.0 * a) * std::exp(-a) * state.inverse_mass[source];
    simulation.step(dt);
    for (std::size_t i = 0; i < stations.size(); ++i) records[i].push_back(state.velocity[stations[i]].y);
  }
  return records;
}

// The lag [samples] at which two records agree best, between samples by a parabola.
double best_lag(const std::vector<double>& first, const std::vector<double>& second) {
  const auto product = [&](std::size_t lag) {
    double sum = 0.0;
    for (std::size_t i = 0; i + lag < first.size(); ++i) sum += first[i] * second[i + lag];
    return sum;
  };
  std::size_t best = 1;
  for (std::size_t lag = 1; lag + 1 < first.size(); ++lag) {
    if (product(lag) > product(best)) best = lag;
  }
  const double left = product(best - 1), middle = product(best), right = product(best + 1);
  return static_cast<double>(best) + 0.5 * (left - right) / (left - 2.0 * middle + right);
}

TEST(Wave, SpeedOfRayleigh) {
  const Check check("A4 speed of Rayleigh waves");
  const std::vector<double> places{0.5, 0.6, 0.7, 0.8};
  double dt = 0.0;
  const auto records = lamb_records(places, 0.15, 0.9, 0.55e-3, dt);
  double worst = 0.0;
  for (std::size_t i = 1; i < places.size(); ++i) {
    const double speed = (places[i] - places[0]) / (best_lag(records[0], records[i]) * dt);
    std::printf("Rayleigh wave, %.1f to %.1f m: %.1f m/s, %+.2f %%\n", places[0], places[i], speed,
                100 * (speed / 2166.14 - 1.0));
    worst = std::max(worst, std::abs(speed / 2166.14 - 1.0));
  }
  check.result(worst);
  EXPECT_LT(worst, 0.02);
}

}  // namespace
}  // namespace crackle
