// SPDX-License-Identifier: GPL-3.0-or-later
//
// A wellbore of radius R with two radial cracks of length L (validation.md D3): K_I = F(L/R) σ √(πL), from
// the energy that the rock releases, G = K_I²/E' = ½ dW/dA, W the work of the loads and A the cracks' area.
#include <gtest/gtest.h>

#include "../result.hpp"
#include "crackle/solve/estimates.hpp"
#include "slit.hpp"

namespace crackle {
namespace {

using granite::at;

constexpr double radius = granite::wellbore_radius;

// Work [J/m] of the loads on wellbore and cracks, each of a given length [m].
double work(double length, double edge, Sym2 stress) {
  MeshRecipe recipe;
  recipe.width = recipe.height = 8.0;
  recipe.wellbore_diameter = 2.0 * radius;
  recipe.wellbore_segments =
      2 * static_cast<int>(std::numbers::pi * radius / edge);  // corners at both cracks
  recipe.size_fine = edge;
  recipe.fine_radius = 3.5 * radius;
  recipe.size_coarse = 0.5;
  const Slit slit = make_slit(recipe, radius + length);
  std::vector<Vec2> forces;
  const std::vector<Vec2> u = displacement(slit, stress, &forces);
  double sum = 0.0;
  for (std::size_t v = 0; v < u.size(); ++v) sum += dot(forces[v], u[v]);
  return sum;
}

struct Load {
  const char* name;
  Sym2 stress;
  double factor[2];  // at L/R = 0.5 and 2
};

TEST(HoleWithCracks, StressIntensityFromTheEnergyReleased) {
  const Check check("D3 wellbore with two cracks: K_I from the energy released");
  const double modulus = plane_strain_modulus(granite::stiffness());
  const Load loads[] = {{"pressure in wellbore and cracks", {1e6, 1e6, 0.0}, {1.56387, 1.21581}},
                        {"stress from afar across the cracks", {0.0, 1e6, 0.0}, {1.83279, 1.24452}}};
  double worst[2] = {0.0, 0.0};
  for (const Load& load : loads) {
    for (const std::size_t i : {0, 1}) {
      const double length = (i == 0 ? 0.5 : 2.0) * radius, longer = 1.1;
      for (const std::size_t fine : {0, 1}) {
        const double edge = length / (fine == 0 ? 8.0 : 16.0);
        const double released =
            0.5 * (work(longer * length, edge, load.stress) - work(length / longer, edge, load.stress)) /
            (2.0 * length * (longer - 1.0 / longer));
        const double error =
            std::sqrt(modulus * released) / (load.factor[i] * 1e6 * std::sqrt(std::numbers::pi * length)) -
            1.0;
        std::printf("%s, L = %.1f R, %d edges a crack: K_I %+.2f %%\n", load.name, length / radius,
                    fine == 0 ? 8 : 16, 100 * error);
        worst[fine] = std::max(worst[fine], std::abs(error));
      }
    }
  }
  check.result(worst[1], std::log2(worst[0] / worst[1]));
  EXPECT_LT(worst[1], 0.03);
}

}  // namespace
}  // namespace crackle
