// SPDX-License-Identifier: GPL-3.0-or-later
//
// A crack in unbounded rock that grows under a pump, filled to its tip with a compressible fluid without
// viscosity (Griffith 1921, Sneddon 1946; validation.md D5). With a its half-length and V_0 = 0:
//   p = K_Ic/√(πa),  V = 2√π K_Ic a^{3/2}/E',  injected = V exp(p/K_f),  w(0) = 4 K_Ic √a/(E' √π)
// On a straight path, as theory has it. It grows at 70 m/s, 3 % of the speed of Rayleigh waves.
#include <gtest/gtest.h>

#include "../pumped_crack.hpp"
#include "../result.hpp"
#include "crackle/solve/estimates.hpp"

namespace crackle {
namespace {

using granite::at;

constexpr double notch = 0.1, path = 0.25;  // half-lengths [m]
constexpr double size = 4e-3;               // [m]
constexpr double fluid_modulus = 2e6;       // [Pa]
constexpr double rate = 2e-3;               // [m2/s]
constexpr double end = 2.4e-3;              // [s]

Scene make_scene() {
  MeshRecipe recipe;
  recipe.width = recipe.height = 8.0;
  recipe.size_fine = size;
  recipe.fine_radius = 0.23;
  recipe.size_coarse = 0.5;
  recipe.joints = {
      {{-notch, 0.0}, {notch, 0.0}, 0}, {{notch, 0.0}, {path, 0.0}, 1}, {{-path, 0.0}, {-notch, 0.0}, 1}};
  recipe.joint_sets = {"crack", "path"};
  Scene scene = granite::pumped_crack(std::make_shared<const Mesh>(generate_mesh(recipe)),
                                      "benzeggagh_kenane", fluid_modulus, rate);
  scene.stress = {-2e6, 0.0, 0.0};  // along the crack: no part in the theory
  return scene;
}

struct Crack {
  double half_length, pressure, width;
};

// What it is when so much has been injected, while it grows.
Crack theory(double injected) {
  const double modulus = plane_strain_modulus(granite::stiffness());
  const double toughness = std::sqrt(modulus * granite::cohesive().fracture_energy_mode1);
  const double root_pi = std::sqrt(std::numbers::pi);
  double low = notch, high = 10.0;
  for (int i = 0; i < 100; ++i) {
    const double a = 0.5 * (low + high), p = toughness / (root_pi * std::sqrt(a));
    const double volume = 2.0 * root_pi * toughness * std::pow(a, 1.5) / modulus;
    (volume * std::exp(p / fluid_modulus) < injected ? low : high) = a;
  }
  return {low, toughness / (root_pi * std::sqrt(low)),
          4.0 * toughness * std::sqrt(low) / (modulus * root_pi)};
}

// Mean opening of the edges within 20 mm of the middle.
double opening_in_the_middle(const Simulation& simulation) {
  double sum = 0.0;
  int count = 0;
  for (const Index e : simulation.scene().cracks) {
    const Index element = simulation.state().cohesive.of_edge[at(e)];
    if (std::abs(Cohesive::place(simulation.state(), element).x) > 0.02) continue;
    const EndSeparation w = simulation.cohesive()->separation(simulation.state(), element);
    sum += 0.5 * (w.opening0 + w.opening1);
    ++count;
  }
  return sum / count;
}

TEST(GriffithGrowth, PumpedCrackOnAStraightPath) {
  const Check pressure_check("D5 pumped crack: pressure"), length_check("D5 pumped crack: half-length");
  const Check width_check("D5 pumped crack: opening in the middle"),
      energy_check("D5 pumped crack: energy per advance");
  Simulation simulation(make_scene());
  double pressure = 0.0, length = 0.0, width = 0.0, residual = 0.0;
  int count = 0;
  double next = 0.5 * end, half = notch, half_before = 0.0, energy_before = 0.0;
  while (simulation.state().time < end) {
    const double dt = 0.8 * simulation.stable_limit();
    if (simulation.state().step % 50 == 0) {
      residual = std::max(residual, simulation.step_and_account(dt).residual);
    } else {
      simulation.step(dt);
    }
    if (simulation.state().time < next) continue;
    next += 0.01 * end;
    const double injected = rate * simulation.state().time;
    const Crack exact = theory(injected);
    half = 0.5 * simulation.fluid()->wetted_length(simulation.state());
    pressure += simulation.wellbore_pressure() / exact.pressure - 1.0;
    length += half / exact.half_length - 1.0;
    width += opening_in_the_middle(simulation) / exact.width - 1.0;
    if (count == 0) half_before = half, energy_before = simulation.state().dissipation.fracture;
    if (count++ % 10 == 0)
      std::printf("%.2f ms: p %.4f MPa (%+.1f %%), half-length %.1f mm (%+.1f %%)\n",
                  1e3 * simulation.state().time, 1e-6 * simulation.wellbore_pressure(),
                  100 * (simulation.wellbore_pressure() / exact.pressure - 1.0), 1e3 * half,
                  100 * (half / exact.half_length - 1.0));
  }
  pressure /= count, length /= count, width /= count;
  // Between two lengths, so that the cohesive zone ahead of both drops out.
  const double energy = (simulation.state().dissipation.fracture - energy_before) /
                            (2.0 * (half - half_before)) / granite::cohesive().fracture_energy_mode1 -
                        1.0;
  std::printf(
      "means: pressure %+.1f %%, half-length %+.1f %%, opening %+.1f %%; energy per advance %+.1f %%; "
      "residual "
      "%.0e\n",
      100 * pressure, 100 * length, 100 * width, 100 * energy, residual);
  pressure_check.result(pressure);
  length_check.result(length);
  width_check.result(width);
  energy_check.result(energy);
  EXPECT_LT(std::abs(pressure), 0.03);
  EXPECT_LT(std::abs(length), 0.03);
  EXPECT_LT(std::abs(width), 0.03);
  EXPECT_LT(std::abs(energy), 0.05);
  EXPECT_LT(residual, 1e-3);
}

}  // namespace
}  // namespace crackle
