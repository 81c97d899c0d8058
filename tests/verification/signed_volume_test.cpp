// SPDX-License-Identifier: GPL-3.0-or-later
//
// Signed test of pressure and volume (validation.md D2): the excavated hole has its first volume
// again at p = (S_H + S_h)/2, and V/V₀ − 1 = (S + p)/G on either side of it.
#include <gtest/gtest.h>

#include "../granite.hpp"
#include "../result.hpp"

namespace crackle {
namespace {

constexpr struct {
  const char* name;
  Sym2 stress;
  double mean;
} states[] = {{"anisotropic", granite::anisotropic, 5.975e6}, {"isotropic", granite::isotropic, 4.85e6}};

Scene hole(Sym2 stress) {
  static const auto mesh =
      granite::make({.segments = 52, .width = 4.0, .fine_radius = 0.1, .size_coarse = 0.2});
  Scene scene = granite::scene(mesh);
  scene.stress = stress;
  scene.fluid = CompressibleFluid{1.45e9, 1000.0, 0.0};
  return scene;
}

TEST(SignedVolume, GeostaticStage) {
  for (const auto& s : states) {
    for (const bool elements : {false, true}) {
      const auto growth = [&](double pressure) {  // V/V₀ − 1
        Scene scene = hole(s.stress);
        scene.initial_pressure = pressure;
        if (elements) {
          scene.law = find_law("evans_marathe");
          scene.cohesive = granite::cohesive();
        }
        const Simulation simulation(scene);
        EXPECT_EQ(simulation.geostatic_slips(), 0);
        return simulation.state().fluid.cavities[0].volume / granite::hole_area(*scene.mesh) - 1.0;
      };
      const double p_low = 4e6, p_high = 7e6, shear = granite::stiffness().c66;
      const double low = growth(p_low), high = growth(p_high);
      const double crossing = p_low - low * (p_high - p_low) / (high - low);
      const double slope = (high - low) / ((p_high - p_low) / shear);
      std::printf("%s, %s: V = V0 at %.4f MPa (%+.3f %%), growth per pressure %+.3f %% off 1/G\n", s.name,
                  elements ? "elements" : "tied", crossing / 1e6, 100 * (crossing / s.mean - 1.0),
                  100 * (slope - 1.0));
      EXPECT_LT(low, 0.0);
      EXPECT_GT(high, 0.0);
      EXPECT_NEAR(crossing / s.mean, 1.0, 0.005);
      EXPECT_NEAR(slope, 1.0, 0.015);
    }
  }
}

TEST(SignedVolume, Pumping) {
  const Check check("D2 signed volume: pressure at which V = V_0, pumped");
  double worst = 0.0;
  for (const auto& s : states) {
    Scene scene = hole(s.stress);
    scene.damping.ratio = 0.3;
    scene.pump = Pump({{0.0, 1.0, 0.03}});
    Simulation simulation(scene);
    const double area = granite::hole_area(*scene.mesh), dt = 0.9 * simulation.stable().limit;
    double before = 0.0, crossing = 0.0;
    while (crossing == 0.0 && simulation.wellbore_pressure() < 2.0 * s.mean) {
      simulation.step(dt);
      const double miss = simulation.state().fluid.cavities[0].volume / area - 1.0;
      if (miss >= 0.0 && before < 0.0) crossing = simulation.wellbore_pressure();
      before = miss;
    }
    std::printf("%s, pumped: V = V0 at %.4f MPa (%+.3f %%)\n", s.name, crossing / 1e6,
                100 * (crossing / s.mean - 1.0));
    worst = std::max(worst, std::abs(crossing / s.mean - 1.0));
    EXPECT_NEAR(crossing / s.mean, 1.0, 0.005);
  }
  check.result(worst);
}

}  // namespace
}  // namespace crackle
