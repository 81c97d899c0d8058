// SPDX-License-Identifier: GPL-3.0-or-later
//
// The granite wellbore (AbuAisha et al. 2016, 6.3, anisotropic) on a coarse mesh, through breakdown.
#include <gtest/gtest.h>

#include "../granite.hpp"

namespace crackle {
namespace {

Scene wellbore(double size) {
  MeshRecipe recipe;
  recipe.width = recipe.height = 8.0;
  recipe.wellbore_diameter = 0.1;
  recipe.size_fine = size;
  recipe.fine_radius = 0.1;
  recipe.size_coarse = 0.6;
  Scene scene = granite::scene(std::make_shared<const Mesh>(excavate(generate_mesh(recipe))));
  scene.stress = granite::anisotropic;
  scene.damping.ratio = 0.1;
  scene.law = find_law("evans_marathe");
  scene.cohesive = granite::cohesive();
  scene.cohesive.calibration = Calibration::y_geo;
  scene.contact = {250e9, 30e9, scene.cohesive.tan_residual};
  scene.fluid = CompressibleFluid{1.45e9, 1000.0, 0.0};
  scene.pump = Pump({{0.0, 1.0, 0.065}});
  return scene;
}

TEST(Wellbore, ReducedAnisotropicRun) {
  const Scene scene = wellbore(8e-3);
  Simulation simulation(scene);
  double breakdown = 0.0, onset = 0.0, residual = 0.0, injected = 0.0;
  Energies before;
  std::size_t events = 0;
  while (simulation.state().time < 1.4e-3) {
    const Energies e = simulation.step_and_account(0.8 * simulation.stable_limit());
    residual = std::max(residual, e.residual);
    EXPECT_GE(e.fracture, before.fracture);
    EXPECT_GE(e.friction, before.friction);
    EXPECT_GE(e.viscous, before.viscous);
    before = e;
    events += simulation.new_events().size();
    const double pressure = simulation.wellbore_pressure();
    if (pressure > breakdown) breakdown = pressure, onset = simulation.state().time;
    injected =
        std::abs(simulation.state().fluid.cavities[0].injected / (0.065 * simulation.state().time) - 1.0);
  }
  std::printf(
      "8 mm, %d triangles, %lld steps: breakdown %.2f MPa at %.3f ms, then %.2f MPa; %zu broken; residual "
      "%.1e\n",
      scene.mesh->triangle_count(), static_cast<long long>(simulation.state().step), breakdown / 1e6,
      onset * 1e3, simulation.wellbore_pressure() / 1e6, events, residual);
  EXPECT_LT(residual, 1e-3);
  EXPECT_GT(breakdown, 10.65e6);
  EXPECT_LT(breakdown, 15e6);
  EXPECT_LT(simulation.wellbore_pressure(), 0.8 * breakdown);
  EXPECT_GT(events, 20u);
  EXPECT_LT(injected, 1e-10);
}

// What flow loses is booked a step before the rock's leapfrog knows all of the work that the fluid did on it,
// and the first push on faces that the fluid has just reached acts for half of the step before.
TEST(Wellbore, WorkOfFallingPressureIsWorkOnTheRock) {
  for (const double viscosity : {1e-6, 1e-3}) {
    Scene scene = wellbore(16e-3);
    scene.insertion.on_demand = true;
    FractureFluid flow;
    flow.viscosity = viscosity;
    flow.cavitation_pressure = 0.0;
    scene.flow = flow;
    Simulation simulation(scene);
    double residual = 0.0;
    std::size_t events = 0;
    while (simulation.state().time < 2.4e-3) {
      residual = std::max(residual, simulation.step_and_account(0.8 * simulation.stable_limit()).residual);
      events += simulation.new_events().size();
    }
    std::printf("16 mm, %.0e Pa s: %zu broken; residual %.1e\n", viscosity, events, residual);
    EXPECT_GT(events, 10u);
    EXPECT_LT(residual, 2e-4);
  }
}

}  // namespace
}  // namespace crackle
