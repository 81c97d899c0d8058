// SPDX-License-Identifier: GPL-3.0-or-later
//
// A bar of 0.1 x 0.025 m pulled apart, weakest in its middle: f_t(y) = f_t0 (1 + 0.4 |2y/L|), G = 50 J/m2.
// What it dissipates over G W says whether the element length is right (T3) and whether the band locks where
// it has to zigzag (T5).
#include <gtest/gtest.h>

#include <numeric>

#include "../../acceptance.hpp"
#include "../../result.hpp"
#include "scenes.hpp"

namespace crackle {
namespace {

using granite::at;
using namespace smeared;

constexpr double length = 0.1, width = 0.025, energy = 50.0;

Mesh rows(int across, bool along_crack) {
  // rows of equilateral triangles, across the bar or along it
  const double step = width / across;
  if (along_crack) {
    const int ny = 2 * static_cast<int>(std::round(length / (0.8660254 * step) / 2)) + 1;
    return structured_rectangle({-0.5 * width, -0.5 * length}, {0.5 * width, 0.5 * length}, across, ny,
                                MeshPattern::shifted_rows);
  }
  // An even number: no triangle lies astride the middle, where both halves of a band would be equally weak.
  const int nx = 4 * across, ny = static_cast<int>(std::round(across / 0.8660254));
  return transposed(structured_rectangle({-0.5 * length, -0.5 * width}, {0.5 * length, 0.5 * width}, nx, ny,
                                         MeshPattern::shifted_rows));
}
Mesh right(int across) {
  return structured_rectangle({-0.5 * width, -0.5 * length}, {0.5 * width, 0.5 * length}, across,
                              4 * across + 1, MeshPattern::right);
}
Mesh random(int across, std::uint64_t seed) {
  MeshRecipe recipe;
  recipe.width = width;
  recipe.height = length;
  recipe.size_fine = recipe.size_coarse = width / across;
  recipe.fine_radius = 1.0;
  recipe.seed = seed;
  return generate_mesh(recipe);
}

struct Found {
  double dissipated, sliding, residual;
  Index failed, damaged;
};

Found pull(Mesh mesh, DamageMaterial m) {
  Scene s = scene(granite::free_body(std::move(mesh)), m);
  constexpr int bins = 100;
  s.damage.materials.clear();
  for (int i = 0; i <= bins; ++i) {
    DamageMaterial one = m;
    one.fracture_energy_mode1 = energy;
    one.fracture_energy_mode2 = 800.0;
    one.tensile_strength = 9e6 * (1.0 + 0.4 * i / bins);
    s.damage.materials.push_back(one);
  }
  for (Index t = 0; t < s.mesh->triangle_count(); ++t) {
    const double y = std::abs(granite::centroid(*s.mesh, t).y) / (0.5 * length);
    s.damage.of_triangle.push_back(static_cast<std::uint16_t>(std::lround(bins * y)));
  }
  strengthen_ends(s, 0.5 * length);
  Pull body(s, 0.5 * length, 0.05, 1e-4);
  const State& state = body.simulation.state();
  while (state.time < 1.2e-3) body.step();
  double sliding = 0.0;
  for (const DamagedTriangle& d : state.damage.triangles) sliding += d.sliding_work;
  return {state.dissipation.fracture / (energy * width), sliding / (energy * width), body.residual,
          failed(state), static_cast<Index>(state.damage.triangles.size())};
}

void print(const char* what, const Found& f) {
  std::printf("%-52s D/GW %.4f (%.4f without sliding), %d failed of %d damaged, ledger %.1e\n", what,
              f.dissipated, f.dissipated - f.sliding, f.failed, f.damaged, f.residual);
  EXPECT_LT(f.residual, 1e-3) << what;
}

const DamageMaterial coupled = rock(DamagePreset::recommended);

TEST(DamagedBar, DissipatesGWhereTheBandRunsStraight) {
  const Check check("T3 damaged bar: dissipated over G W");
  double worst = 0.0, chord_found = 0.0, residual = 0.0;
  for (const int across : {5, 10, 20}) {
    for (const bool rows_mesh : {false, true}) {
      const Found f = pull(rows_mesh ? rows(across, true) : right(across), coupled);
      print(((rows_mesh ? "rows along the crack" : "right") + std::string(", ") +
             std::to_string(width / across))
                .c_str(),
            f);
      worst = std::max(worst, std::abs(f.dissipated - 1.0));
      residual = std::max(residual, f.residual);
      DamageMaterial chord = coupled;
      chord.element_length = ElementLength::chord;
      if (across != 10) continue;
      const Found by_chord = pull(rows_mesh ? rows(across, true) : right(across), chord);
      print("  the same, length by the chord", by_chord);
      chord_found = by_chord.dissipated;
      EXPECT_GT(by_chord.dissipated, 1.25) << "documented: 1.33 to 1.37";
    }
  }
  check.result(worst);
  accept("T3", "bar, band runs straight, 5 to 1.25 mm: dissipated over G W", "1 %",
         text("%.2f %%", 100 * worst), worst < 0.01);
  accept("T3", "the same with the chord as element length", "documented 1.33 to 1.37",
         text("%.3f", chord_found), chord_found > 1.25);
  accept("T13", "energy residual, bars", "1e-3", text("%.1e", residual), residual < 1e-3);
  EXPECT_LT(worst, 0.01);
}

TEST(DamagedBar, LocksOnlyInTheFaithfulPreset) {
  const Check check("T5 damaged bar, zigzag: dissipated over G W");
  DamageMaterial independent = coupled;
  independent.coupled = independent.drop_all = false;
  double worst = 0.0, locked = 0.0, sliding = 0.0;
  for (const std::uint64_t seed : {0u, 1u, 2u, 3u, 4u, 5u}) {
    const Mesh mesh = seed == 0 ? rows(10, false) : random(10, seed);
    const std::string name = seed == 0 ? "rows across the crack" : "random mesh " + std::to_string(seed);
    const Found one = pull(mesh, coupled), two = pull(mesh, independent);
    print((name + ", one damage").c_str(), one);
    print((name + ", independent damages").c_str(), two);
    // The reference does not count what sliding dissipates.
    worst = std::max(worst, std::abs(one.dissipated - one.sliding - 1.0));
    sliding = std::max(sliding, one.dissipated);
    if (seed == 0) locked = two.dissipated;
  }
  check.result(worst);
  accept("T5",
         "bar, rows of triangles across the crack; five random meshes: dissipated over G W, without sliding",
         "1.10", text("%.3f at most", 1.0 + worst), worst < 0.10);
  accept("T5", "the same with what sliding dissipates, which the reference does not count", "none",
         text("%.3f at most", sliding), true);
  accept("T5", "independent damages, rows across the crack: it locks", "1.5 or more", text("%.2f", locked),
         locked > 1.5);
  EXPECT_LT(worst, 0.10);
  EXPECT_GT(locked, 1.5) << "the faithful preset has to show it";
}

}  // namespace
}  // namespace crackle
