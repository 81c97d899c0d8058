// SPDX-License-Identifier: GPL-3.0-or-later
//
// A notch in unbounded rock under the pressure of a soft fluid, which a random mesh lets grow on no straight
// path: p = K_Ic/√(πa) (Griffith 1921). The edges at its tips have their elements from the start: triangles
// would see the singular stress there late, by 30 % of the pressure. The geostatic stage, which ends just
// below that pressure, leaves it whole. The fluid is in the cohesive zone (18 mm) too, as in a longer notch:
// below Griffith's pressure.
#include <gtest/gtest.h>

#include "../pumped_crack.hpp"
#include "../result.hpp"
#include "crackle/solve/estimates.hpp"

namespace crackle {
namespace {

using granite::at;

constexpr double half = 0.1;  // [m]

Scene make_scene(std::uint64_t seed, double pressure) {
  MeshRecipe recipe;
  recipe.width = recipe.height = 2.0;
  recipe.size_fine = 8e-3;
  recipe.fine_radius = 0.13;
  recipe.size_coarse = 0.25;
  recipe.seed = seed;
  recipe.joints = {{{-half, 0.0}, {half, 0.0}, 0}};
  recipe.joint_sets = {"notch"};
  Scene scene = granite::pumped_crack(std::make_shared<const Mesh>(generate_mesh(recipe)),
                                      "benzeggagh_kenane", 1e5, 0.2);
  scene.initial_pressure = pressure;
  return scene;
}

TEST(PressedNotch, FluidInItsCohesiveZoneLowersThePressureAtWhichItGrows) {
  const Check check("D5 notch under pressure in a random mesh: pressure at which it grows");
  const double modulus = plane_strain_modulus(granite::stiffness());
  const double griffith =
      std::sqrt(modulus * granite::cohesive().fracture_energy_mode1 / (std::numbers::pi * half));
  double worst = 0.0;
  for (const std::uint64_t seed : {1, 2}) {
    Simulation simulation(make_scene(seed, 0.7 * griffith));
    for (const CohesiveHistory& h : simulation.state().cohesive.histories) {
      const bool whole = simulation.state().cohesive.status[at(h.element)] < CohesiveStatus::broken;
      EXPECT_FALSE(whole && h.point[2].damage > 0.0) << "damaged by the geostatic stage";
    }
    const double dt = 0.8 * simulation.stable_limit();
    double highest = 0.0;
    while (simulation.new_events().empty() && simulation.state().time < 8e-3) {
      simulation.step(dt);
      highest = std::max(highest, simulation.state().fluid.cavities[0].pressure);
    }
    std::printf("mesh %d: grows at %.3f MPa, Griffith %.3f (%+.1f %%), first element broken at %.2f ms\n",
                static_cast<int>(seed), 1e-6 * highest, 1e-6 * griffith, 100.0 * (highest / griffith - 1.0),
                1e3 * simulation.state().time);
    EXPECT_LT(highest, 1.05 * griffith);
    EXPECT_GT(highest, 0.75 * griffith);
    worst = std::max(worst, std::abs(highest / griffith - 1.0));
  }
  check.result(worst);
}

}  // namespace
}  // namespace crackle
