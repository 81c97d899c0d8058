// SPDX-License-Identifier: GPL-3.0-or-later
//
// Pump and cavity (validation.md D1): p = K_f ln(1 + Q t / V₀) between rigid walls, and
// p = K_f [ln(1 + Q t / V₀) − ln(1 + p/G)] in an elastic hole.
#include <gtest/gtest.h>

#include "../../granite.hpp"
#include "../../result.hpp"

namespace crackle {
namespace {

using granite::at;

constexpr double water = 2.2e9;  // [Pa]
constexpr double rate = 0.065;   // [m2/s]

TEST(Pump, VolumesAreExactOverStages) {
  const Pump pump({{1.0, 2.0, 0.5}, {2.0, 3.0, 1.0}, {4.0, 5.0, -0.25}});
  EXPECT_EQ(pump.rate(0.5), 0.0);
  EXPECT_EQ(pump.rate(2.0), 1.0);
  EXPECT_EQ(pump.rate(3.5), 0.0);
  EXPECT_DOUBLE_EQ(pump.volume(0.0, 10.0), 0.5 + 1.0 - 0.25);
  EXPECT_DOUBLE_EQ(pump.volume(1.9, 2.1), 0.05 + 0.1);
}

TEST(CompressibleFluid, MassAndPressureAreInverse) {
  const CompressibleFluid f{1.45e9, 1000.0, 2e6};
  for (const double p : {-3e6, 2e6, 40e6}) EXPECT_NEAR(f.pressure(f.mass(0.3, p), 0.3), p, 1e-5);
  // dE = −p dV at constant mass
  const double mass = f.mass(0.3, 9e6), dv = 1e-6;
  const auto energy = [&](double v) { return f.energy(mass, v, f.pressure(mass, v)); };
  EXPECT_NEAR((energy(0.3 + dv) - energy(0.3 - dv)) / (2 * dv) / -9e6, 1.0, 1e-6);
}

TEST(Pump, RigidCavity) {
  const Check check("D1 pump into a rigid cavity: pressure");
  const auto mesh = granite::make({.segments = 105, .width = 1.0, .fine_radius = 0.06, .size_coarse = 0.1});
  State state = make_tied_state(mesh);  // masses are not set: inverse mass 0 holds every node
  Fluid fluid(state, {water, 1000.0, 0.0}, Pump({{0.0, 1.0, rate}}));
  fluid.fill(state, granite::edges_of_kind(*mesh, EdgeKind::wellbore), 0.0);
  const double area = granite::hole_area(*mesh),
               circle = std::numbers::pi * std::pow(granite::wellbore_radius, 2);
  const double dt = 1e-6;
  double worst = 0.0;
  for (int i = 1; i <= 1000; ++i) {
    fluid.advance(state, dt);
    state.time += dt;
    const double exact = water * std::log1p(rate * i * dt / area);
    worst = std::max(worst, std::abs(state.fluid.cavities[0].pressure / exact - 1.0));
  }
  const double slope = water * std::log1p(rate * 1e-6 / area) / 1e-6;
  std::printf(
      "rigid cavity: p = K ln(1 + Qt/V) within %.1e; polygon's area %.4e below the circle's; %.3f MPa/ms\n",
      worst, 1.0 - area / circle, slope * 1e-9);
  check.result(worst);
  EXPECT_LT(worst, 1e-10);
  EXPECT_NEAR(area / circle - 1.0, -5.97e-4, 1e-6);
  EXPECT_NEAR(slope * 1e-9, 18.207, 0.02);
}

TEST(Pump, ElasticHole) {
  const Check check("D1 pump into an elastic hole: pressure");
  Scene scene =
      granite::scene(granite::make({.segments = 52, .width = 2.0, .fine_radius = 0.08, .size_coarse = 0.1}));
  scene.damping.ratio = 0.1;
  scene.fluid = CompressibleFluid{water, 1000.0, 0.0};
  scene.pump = Pump({{0.0, 1.0, rate}});
  Simulation simulation(scene);
  const double dt = 0.9 * simulation.stable().limit;
  const double area = granite::hole_area(*scene.mesh), shear = scene.stiffness.c66;
  double worst = 0.0, injected_error = 0.0;
  double first_mass = simulation.state().fluid.cavities[0].mass;
  while (simulation.state().time < 1e-3) {
    simulation.step(dt);
    const Cavity& cavity = simulation.state().fluid.cavities[0];
    const double injected = rate * simulation.state().time;
    double p = cavity.pressure;
    for (int i = 0; i < 30; ++i) p = water * (std::log1p(injected / area) - std::log1p(p / shear));
    if (simulation.state().time > 0.3e-3) worst = std::max(worst, std::abs(cavity.pressure / p - 1.0));
    injected_error = std::max({injected_error, std::abs(cavity.injected / injected - 1.0),
                               std::abs((cavity.mass - first_mass) / 1000.0 / injected - 1.0)});
  }
  std::printf("elastic hole from 0.3 to 1 ms: pressure within %.2f %%; injected = stored within %.0e\n",
              100 * worst, injected_error);
  check.result(worst);
  EXPECT_LT(worst, 0.01);
  EXPECT_LT(injected_error, 1e-10);
}

}  // namespace
}  // namespace crackle
