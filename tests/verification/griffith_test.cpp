// SPDX-License-Identifier: GPL-3.0-or-later
//
// A crack under uniform pressure in elastic rock (Griffith 1921, Sneddon 1946; validation.md B5):
//   w(x) = 4 p √(a² − x²)/E',  V = 2π p a²/E',  K_I = p √(πa) from the energy released, G = ½ p dV/da
#include <gtest/gtest.h>

#include "../granite.hpp"
#include "../result.hpp"
#include "crackle/solve/estimates.hpp"
#include "slit.hpp"

namespace crackle {
namespace {

using granite::at;

constexpr double half_width = 20.0;  // of the block [m]
constexpr double pressure = 2e6;     // [Pa]

struct Opened {
  double volume = 0.0, widest = 0.0;
  std::size_t edges = 0;
};

Opened open(double half_length, double size) {
  MeshRecipe recipe;
  recipe.width = recipe.height = 2.0 * half_width;
  recipe.size_fine = size;
  recipe.fine_radius = 1.5;
  recipe.size_coarse = 3.0;
  const Slit slit = make_slit(recipe, half_length);
  const Mesh& mesh = *slit.mesh;
  const std::vector<Vec2> u = displacement(slit, {pressure, pressure, 0.0});
  Opened o;
  std::vector<Vec2> profile{{-half_length, 0.0}, {half_length, 0.0}};
  for (const auto& [lower, upper] : slit.faces) {
    const double width = u[at(upper)].y - u[at(lower)].y, x = mesh.vertices[at(lower)].x;
    profile.push_back({x, width});
    o.widest = std::max(o.widest, width);
  }
  std::sort(profile.begin(), profile.end(), [](Vec2 p, Vec2 q) { return p.x < q.x; });
  for (std::size_t i = 1; i < profile.size(); ++i)
    o.volume += 0.5 * (profile[i].y + profile[i - 1].y) * (profile[i].x - profile[i - 1].x);
  o.edges = profile.size() - 1;
  return o;
}

TEST(Griffith, PressurisedCrack) {
  const Check volume_check("B5 crack under pressure: volume"),
      width_check("B5 crack under pressure: opening in the middle");
  const Check toughness_check("B5 crack under pressure: K_I from the energy released");
  const double modulus = plane_strain_modulus(granite::stiffness());
  double volume[3], width[3], intensity = 0.0;
  int i = 0;
  for (const double size : {0.1, 0.05, 0.025}) {
    const Opened o = open(1.0, size);
    volume[i] = o.volume * modulus / (2.0 * std::numbers::pi * pressure) - 1.0;
    width[i] = o.widest * modulus / (4.0 * pressure) - 1.0;
    std::printf("%zu edges: volume %+.2f %%, opening in the middle %+.2f %%\n", o.edges, 100 * volume[i],
                100 * width[i]);
    ++i;
  }
  const double longer = 1.05;
  const double rate =
      (open(longer, 0.025).volume - open(1.0 / longer, 0.025).volume) / (2.0 * (longer - 1.0 / longer));
  intensity = std::sqrt(modulus * 0.5 * pressure * rate) / (pressure * std::sqrt(std::numbers::pi)) - 1.0;
  std::printf("K_I %+.2f %%\n", 100 * intensity);
  volume_check.result(volume[2], std::log2(volume[1] / volume[2]));
  width_check.result(width[2], std::log2(width[1] / width[2]));
  toughness_check.result(intensity);
  EXPECT_LT(std::abs(volume[2]), 0.03);
  EXPECT_LT(std::abs(width[2]), 0.03);
  EXPECT_GT(std::log2(std::abs(volume[1] / volume[2])), 0.8);
  EXPECT_LT(std::abs(intensity), 0.02);
}

}  // namespace
}  // namespace crackle
