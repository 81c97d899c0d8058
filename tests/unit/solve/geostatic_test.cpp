// SPDX-License-Identifier: GPL-3.0-or-later
//
// Geostatic stage of rock that is too weak for its stress: it relaxes to rest, or says that it cannot.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "../../pumped_crack.hpp"
#include "crackle/core/errors.hpp"
#include "crackle/solve/estimates.hpp"

namespace crackle {
namespace {

Scene weak_rock(double tensile_strength, double cohesion, int segments = 12) {
  Scene scene = granite::scene(
      granite::make({.segments = segments, .width = 0.4, .fine_radius = 0.06, .size_coarse = 0.08}));
  scene.stress = {-9e6, -4e6, 0.0};  // hoop stress from −3 to −23 MPa
  scene.damping.ratio = 0.1;
  scene.law = find_law("evans_marathe");
  scene.cohesive = granite::cohesive();
  scene.cohesive.calibration = Calibration::y_geo;
  scene.cohesive.tensile_strength = tensile_strength;
  scene.cohesive.cohesion = cohesion;
  scene.contact = {120e9, 30e9, scene.cohesive.tan_residual};
  return scene;
}

TEST(Geostatic, StrongRockNeedsNoRelaxation) {
  Simulation simulation(weak_rock(3e6, 24e6));
  EXPECT_EQ(simulation.geostatic_slips(), 0);
  EXPECT_LT(simulation.imbalance(), 1e-12);
}

// By edges everywhere, on demand, and by smeared damage: what the excavation crushes does so before the run.
class WeakWall : public testing::TestWithParam<const char*> {};

TEST_P(WeakWall, ComesToRest) {
  Scene scene = weak_rock(3e6, 2e6);
  scene.insertion.on_demand = std::string(GetParam()) == "on_demand";
  if (std::string(GetParam()) == "damage") {
    scene.law = nullptr;
    scene.damage.law = find_softening("linear");
    DamageMaterial rock{3e6, 2e6, 0.0, 0.0, 5.0, 80.0};
    rock.apply(DamagePreset::recommended);
    scene.damage.materials = {rock};
  }
  Simulation simulation(scene);
  const double imbalance = simulation.imbalance();
  double fastest = 0.0;
  const double dt = 0.8 * simulation.stable().limit;
  for (int i = 0; i < 500; ++i) simulation.step(dt);
  for (const Vec2 v : simulation.state().velocity) fastest = std::max(fastest, norm(v));
  std::printf(
      "weak wall: %d elements beyond their strength, imbalance %.1e after relaxing, then at most %.1e m/s\n",
      simulation.geostatic_slips(), imbalance, fastest);
  EXPECT_GT(simulation.geostatic_slips(), 0);
  EXPECT_LT(imbalance, 1e-3);
  EXPECT_LT(fastest, 1e-3);
  EXPECT_NEAR(simulation.state().time, 500 * dt, 1e-9 * dt) << "relaxing takes no time";
}
INSTANTIATE_TEST_SUITE_P(By, WeakWall, testing::Values("all", "on_demand", "damage"));

// Cracks in rock without stress: nothing moves, which is rest.
TEST(Geostatic, CracksWithoutStressAreAtRest) {
  Scene scene = weak_rock(3e6, 24e6);
  scene.stress = {};
  scene.cracks = {granite::edges_of_kind(*scene.mesh, EdgeKind::interior).front()};
  Simulation simulation(scene);
  EXPECT_EQ(simulation.imbalance(), 0.0);
}

// A crack that the stress of the rock holds closed, away from the wellbore: at rest but for round-off.
TEST(Geostatic, ClosedCrackIsAtRest) {
  Scene scene = weak_rock(3e6, 24e6);
  scene.stress = granite::isotropic;
  const auto& edges = granite::edges_of_kind(*scene.mesh, EdgeKind::interior);
  scene.cracks = {*std::max_element(edges.begin(), edges.end(), [&](Index a, Index b) {
    const auto place = [&](Index e) {
      return norm(scene.mesh->vertices[granite::at(scene.mesh->edges[granite::at(e)].vertex[0])]);
    };
    return place(a) < place(b);
  })};
  Simulation simulation(scene);
  EXPECT_LT(simulation.imbalance(), 1e-6);
}

// With elements on all edges it comes to rest with masses of its own, which are taken back: a crack held open
// by a fluid opens as the rock of elements on demand lets it, but for the compliance of the elements round
// it.
TEST(Geostatic, PressedCrackOpensAlikeByAllEdgesAndOnDemand) {
  MeshRecipe recipe;
  recipe.width = recipe.height = 1.0;
  recipe.size_fine = 10e-3;
  recipe.fine_radius = 0.06;
  recipe.size_coarse = 0.1;
  recipe.joints = {{{-0.05, 0.0}, {0.05, 0.0}, 0}};
  recipe.joint_sets = {"notch"};
  const auto mesh = std::make_shared<const Mesh>(generate_mesh(recipe));
  std::array<double, 2> volume{};
  for (const bool on_demand : {true, false}) {
    Scene scene = granite::pumped_crack(mesh, "linear", 1e6, 0.0);
    scene.initial_pressure = 0.3e6;
    scene.insertion.on_demand = on_demand;
    Simulation simulation(scene);
    const State& state = simulation.state();
    volume.at(on_demand ? 0 : 1) = simulation.fluid()->volume(0);
    EXPECT_LT(simulation.imbalance(), 1e-3);
    EXPECT_EQ(simulation.geostatic_slips(), 0) << "nothing breaks";
    if (on_demand) continue;
    State own = state;
    set_mass(own, granite::density);
    fix_nodes(own, EdgeKind::outer);
    EXPECT_EQ(state.inverse_mass, own.inverse_mass);
  }
  const double sneddon =
      2.0 * std::numbers::pi * 0.3e6 * 0.05 * 0.05 / plane_strain_modulus(granite::stiffness());
  std::printf("volume over Sneddon's: on demand %.3f, all edges %.3f\n", volume[0] / sneddon,
              volume[1] / sneddon);
  EXPECT_NEAR(volume[0] / sneddon, 1.0, 0.1);
  EXPECT_NEAR(volume[1] / volume[0], 1.0, 0.15);
}

TEST(Geostatic, RockThatCannotStandSaysSo) {
  try {
    Simulation simulation(weak_rock(1e3, 1e3, 8));
    std::printf("no strength: came to rest, imbalance %.1e, %d slips\n", simulation.imbalance(),
                simulation.geostatic_slips());
  } catch (const NumericalError& error) {
    std::printf("no strength: %s\n", error.what());
    EXPECT_THAT(error.what(), testing::HasSubstr("the geostatic stage does not come to rest"));
    EXPECT_THAT(error.what(), testing::HasSubstr("is the rock too weak for this stress?"));
    return;
  }
}

}  // namespace
}  // namespace crackle
