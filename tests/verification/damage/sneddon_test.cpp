// SPDX-License-Identifier: GPL-3.0-or-later
//
// A smeared crack that opens (T7), against Sneddon and Elliot (1946): V = 2 π a² p/E'. The rock is under
// tension p and the crack bears nothing, which moves it like a pressure p in the crack in rock without
// stress. In bedded rock E' is E* = 1/(√(s11 s22/2) √(√(s22/s11) + (2 s12 + s66)/(2 s11))), x along the crack
// (Sih, Paris, Irwin 1965). The boundary, fixed at six half-lengths, takes 2 to 3 % of the volume.
#include <gtest/gtest.h>

#include "../../result.hpp"
#include "scenes.hpp"

namespace crackle {
namespace {

using granite::at;
using namespace smeared;

constexpr double tension = 1e6;  // [Pa]
constexpr double half = 0.02;    // [m]

struct Opened {
  double volume = 0.0;  // [m2]
  Index triangles = 0;
};

// Volume of the crack by Σ A w_n, or where all stress is dropped by the change of area of its triangles.
Opened open_crack(int cells, double angle, const std::string& kind, bool drop_all,
                  const PlaneStiffness& stiffness) {
  const bool level = angle == 0.0, upright = angle > 1.5;
  const int n = 12 * cells;  // an odd number across, so that the crack runs in the middle of a row
  Mesh mesh = structured_rectangle({-6 * half, -6 * half}, {6 * half, 6 * half}, upright ? n + 1 : n,
                                   level ? n + 1 : n, MeshPattern::right);
  if (kind != "right") mesh = jittered(mesh, 0.28, 3);
  DamageMaterial m = rock(DamagePreset::recommended);
  m.drop_all = drop_all;
  m.tensile_strength = m.cohesion = 1e12;  // what is not cut does not break
  m.fracture_energy_mode1 = m.fracture_energy_mode2 = 1e20;
  Scene s = scene(std::make_shared<const Mesh>(std::move(mesh)), m);
  s.stiffness = stiffness;
  s.stress = {tension, tension, 0.0};
  s.damage.cut = notch(*s.mesh, half, angle);
  Simulation simulation(s);
  const State& state = simulation.state();
  Opened crack;
  for (const DamagedTriangle& d : state.damage.triangles) {
    const double area = simulation.bulk().area(d.triangle);
    crack.volume += drop_all ? area * (simulation.bulk().area_ratio(state, d.triangle) - 1.0)
                             : area / d.length * d.opening;
    ++crack.triangles;
  }
  return crack;
}

double sneddon(double modulus) { return 2.0 * std::numbers::pi * half * half * tension / modulus; }

TEST(SmearedCrack, OpensLikeSneddons) {
  const Check check("T7 volume of a smeared crack over Sneddon's");
  const double exact =
      sneddon(granite::young_modulus / (1.0 - granite::poisson_ratio * granite::poisson_ratio));
  const PlaneStiffness isotropic = granite::stiffness();
  double low = 1e9, high = 0.0;
  const auto look = [&](int cells, double degrees, const char* kind, bool drop_all) {
    const Opened c = open_crack(cells, degrees * std::numbers::pi / 180.0, kind, drop_all, isotropic);
    std::printf("%2.0f degrees, h = a/%d, %s, %s: V/V0 %.4f (%d triangles)\n", degrees, cells, kind,
                drop_all ? "all stress dropped" : "stress along it kept", c.volume / exact, c.triangles);
    return c.volume / exact;
  };
  for (const double degrees : {0.0, 30.0, 90.0}) {
    const double v = look(8, degrees, "right", false);
    low = std::min(low, v), high = std::max(high, v);
  }
  const double jittered_fine = look(8, 0.0, "jittered", false);
  low = std::min(low, jittered_fine), high = std::max(high, jittered_fine);
  const double coarse = look(4, 0.0, "right", false), fine = look(8, 0.0, "right", false);
  EXPECT_LT(std::abs(fine - 0.97), std::abs(coarse - 0.97)) << "nearer to what the boundary leaves";
  for (const double degrees : {0.0, 30.0}) {
    const double v = look(8, degrees, "jittered", true);
    EXPECT_GT(v, 0.88);
    EXPECT_LT(v, 0.96);
  }
  check.result(std::max(1.0 - low, high - 1.0));
  EXPECT_GT(low, 0.93);
  EXPECT_LT(high, 1.04);
}

TEST(SmearedCrack, OpensByTheModulusOfBeddedRock) {
  const Check check("T7 smeared crack in bedded rock: volume over that in isotropic rock");
  const double modulus = granite::young_modulus / (1.0 - granite::poisson_ratio * granite::poisson_ratio);
  const TransverseIsotropy shale{40e9, 20e9, 0.2, 0.25, 9e9, 0.0};
  TransverseIsotropy upright = shale;
  upright.bedding_angle = 0.5 * std::numbers::pi;
  const double isotropic = open_crack(8, 0.0, "right", false, granite::stiffness()).volume;
  const double along = open_crack(8, 0.0, "right", false, transversely_isotropic_plane_strain(shale)).volume;
  const double across =
      open_crack(8, 0.0, "right", false, transversely_isotropic_plane_strain(upright)).volume;
  std::printf("along the bedding %.4f (theory %.4f), across it %.4f (%.4f), the two %.4f (%.4f)\n",
              along / isotropic, modulus / 25.0314e9, across / isotropic, modulus / 33.7963e9, along / across,
              33.7963 / 25.0314);
  check.result(along / isotropic * 25.0314e9 / modulus - 1.0);
  EXPECT_NEAR(along / isotropic * 25.0314e9 / modulus, 1.0, 0.01);
  EXPECT_NEAR(along / across * 25.0314 / 33.7963, 1.0, 0.02);
}

}  // namespace
}  // namespace crackle
