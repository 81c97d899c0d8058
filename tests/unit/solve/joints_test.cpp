// SPDX-License-Identifier: GPL-3.0-or-later
//
// Joints in the geostatic stage and in the fluid, with elements on all edges and on demand.
#include <gtest/gtest.h>

#include <array>
#include <cstdio>

#include "../../granite.hpp"

namespace crackle {
namespace {

using granite::at;

/// A square of 1 m with a joint of half length 0.1 m in its middle at an angle of 45 degrees.
std::shared_ptr<const Mesh> jointed_square() {
  MeshRecipe recipe;
  recipe.width = recipe.height = 1.6;
  recipe.size_fine = 0.01;
  recipe.fine_radius = 0.12;
  recipe.size_coarse = 0.1;
  const Vec2 half = (0.1 / std::sqrt(2.0)) * Vec2{1.0, 1.0};
  recipe.joints = {{-half, half}};
  return std::make_shared<const Mesh>(generate_mesh(recipe));
}

Scene jointed(bool on_demand, double tan_residual, bool bonded = false) {
  Scene scene = granite::scene(jointed_square());
  scene.law = find_law("evans_marathe");
  scene.cohesive = granite::cohesive();
  scene.cohesive.penalty = scene.cohesive.tangential_penalty = on_demand ? 20 * granite::young_modulus : 4e12;
  scene.cohesive.calibration = Calibration::y_geo;
  scene.insertion.on_demand = on_demand;
  CohesiveMaterial joint = scene.cohesive;
  joint.tan_residual = tan_residual;
  scene.joint_materials = {joint};
  for (Index e = 0; e < scene.mesh->edge_count(); ++e) {
    if (scene.mesh->edges[at(e)].joint >= 0) scene.joints.push_back({e, 1, bonded});
  }
  scene.stress = {-10e6, -4e6, 0.0};  // across the joint -7 MPa, along it 3 MPa
  return scene;
}

double largest_off(const Simulation& simulation, Sym2 stress) {
  double most = 0.0;
  for (Index t = 0; t < simulation.state().mesh->triangle_count(); ++t) {
    most = std::max(most, granite::larger_part(
                              granite::difference(simulation.bulk().stress(simulation.state(), t), stress)));
  }
  return most;
}

class Joint : public testing::TestWithParam<bool> {};

/// Friction holds: the joint bears the in-situ stress from the start, nothing moves, by whatever spring a law
/// has its faces rub.
TEST_P(Joint, ThatFrictionHoldsChangesNothing) {
  for (const char* law : {"evans_marathe", "linear", "benzeggagh_kenane"}) {
    Scene scene = jointed(GetParam(), 0.5);  // 3.5 MPa
    scene.law = find_law(law);
    scene.joint_materials.front().tangential_penalty *= 0.25;
    Simulation simulation(scene);
    const double off = largest_off(simulation, scene.stress);
    std::printf("%s: imbalance %.2e, stress off by %.2e Pa\n", law, simulation.imbalance(), off);
    EXPECT_EQ(simulation.geostatic_slips(), 0);
    EXPECT_LT(simulation.imbalance(), 1e-9);
    EXPECT_LT(off, 1e-2);
    for (int i = 0; i < 50; ++i) simulation.step(0.5 * simulation.stable().limit);
    EXPECT_LT(largest_off(simulation, scene.stress), 1e-1);
  }
}

TEST_P(Joint, ThatIsBondedChangesNothing) {
  const Scene scene = jointed(GetParam(), 0.0, true);
  Simulation simulation(scene);
  EXPECT_EQ(simulation.geostatic_slips(), 0);
  EXPECT_LT(simulation.imbalance(), 1e-9);
  EXPECT_LT(largest_off(simulation, scene.stress), 1e-2);
}

/// Friction does not hold: the joint slips in the geostatic stage until it bears what friction allows. The
/// slip of a crack under a uniform drop of shear stress: 4 (1 − ν²)/E Δτ √(a² − x²) (Starr 1928; Pollard and
/// Segall 1987, Eq. 8.35).
TEST_P(Joint, SlipsToEquilibriumBeforeTheRun) {
  const Scene scene = jointed(GetParam(), 0.2);  // 1.4 MPa of 3 MPa
  Simulation simulation(scene);
  const State& state = simulation.state();
  EXPECT_GT(simulation.geostatic_slips(), 0);
  EXPECT_LT(simulation.imbalance(), 1e-3);
  double largest = 0.0;
  for (const JointEdge& joint : scene.joints) {
    const Index element = state.cohesive.of_edge[at(joint.edge)];
    const auto& p = state.cohesive.histories[at(state.cohesive.history_of[at(element)])].point[2];
    largest = std::max(largest, std::abs(p.plastic_slip));
    EXPECT_LE(std::abs(p.friction), -0.2 * p.normal * (1.0 + 1e-9));
    if (norm(Cohesive::place(state, element)) > 0.08) continue;  // the stress at its tips has no bound
    EXPECT_NEAR(p.normal, -7e6, 0.5e6);
  }
  const double nu = granite::poisson_ratio;
  const double theory = 4.0 * (1.0 - nu * nu) / granite::young_modulus * 1.6e6 * 0.1;
  std::printf("%s: slip %.4e m, theory %.4e m (%+.1f %%)\n", GetParam() ? "on demand" : "all", largest,
              theory, 100.0 * (largest / theory - 1.0));
  EXPECT_NEAR(largest / theory, 1.0, 0.08);
}

/// A wellbore with a joint from its wall outward, one that crosses that, and one on its own.
Scene jointed_wellbore(bool on_demand, bool edge_by_edge) {
  MeshRecipe recipe;
  recipe.width = recipe.height = 1.0;
  recipe.wellbore_diameter = 0.1;
  recipe.size_fine = 0.012;
  recipe.fine_radius = 0.15;
  recipe.size_coarse = 0.08;
  recipe.joints = {{{0.04, 0.0}, {0.15, 0.0}}, {{0.12, -0.03}, {0.12, 0.03}}, {{-0.1, 0.05}, {-0.1, 0.15}}};
  Scene scene = granite::scene(std::make_shared<const Mesh>(excavate(generate_mesh(recipe))));
  scene.law = find_law("benzeggagh_kenane");
  scene.cohesive = granite::cohesive();
  scene.cohesive.tensile_strength = scene.cohesive.cohesion = 1e9;  // the rock holds
  scene.cohesive.fracture_energy_mode1 = scene.cohesive.fracture_energy_mode2 = 1e6;
  scene.insertion.on_demand = on_demand;
  scene.joint_materials = {granite::cohesive()};
  for (Index e = 0; e < scene.mesh->edge_count(); ++e) {
    const Edge& edge = scene.mesh->edges[at(e)];
    if (edge.joint >= 0 && edge.kind == EdgeKind::interior) scene.joints.push_back({e, 1, false});
  }
  scene.joints_edge_by_edge = edge_by_edge;
  scene.stress = {-5e6, -5e6, 0.0};
  scene.damping.ratio = 0.1;
  scene.fluid = CompressibleFluid{2.2e9, 1000.0, 0.0};
  scene.pump = Pump({{0.0, 1.0, 0.065}});
  return scene;
}

/// Wet edges of each joint, of all it has.
std::array<std::pair<int, int>, 3> wet_edges(const Simulation& simulation) {
  std::array<std::pair<int, int>, 3> count{};
  const State& state = simulation.state();
  for (const JointEdge& joint : simulation.scene().joints) {
    auto& [wet, all] = count[at(state.mesh->edges[at(joint.edge)].joint)];
    wet += state.fluid.cavity_of_edge[at(joint.edge)] >= 0 ? 1 : 0;
    ++all;
  }
  return count;
}

TEST_P(Joint, AWholeJointIsWetOnceReachedAndThoseThatCrossIt) {
  const Simulation simulation(jointed_wellbore(GetParam(), false));
  const auto joints = wet_edges(simulation);
  EXPECT_EQ(joints[0].first, joints[0].second);
  EXPECT_EQ(joints[1].first, joints[1].second);
  EXPECT_EQ(joints[2].first, 0);
  EXPECT_GT(joints[0].second, 5);
  EXPECT_NEAR(simulation.wellbore_pressure(), 0.0, 1e5);
}

TEST_P(Joint, EdgeByEdgeItIsWetAsItOpens) {
  Simulation simulation(jointed_wellbore(GetParam(), true));
  int before = wet_edges(simulation)[0].first, most_at_once = 0, steps_with_more = 0;
  const int all = wet_edges(simulation)[0].second;
  EXPECT_LT(before, all);
  double residual = 0.0;
  for (int i = 0; simulation.state().time < 1.0e-3; ++i) {
    const double dt = 0.7 * simulation.stable_limit();
    if (i % 20 == 0) {
      residual = std::max(residual, simulation.step_and_account(dt).residual);
    } else {
      simulation.step(dt);
    }
    const int wet = wet_edges(simulation)[0].first;
    EXPECT_GE(wet, before);
    most_at_once = std::max(most_at_once, wet - before);
    steps_with_more += wet > before ? 1 : 0;
    before = wet;
  }
  std::printf("%s: %d of %d edges wet at %.2f MPa, in %d advances; energy residual %.1e\n",
              GetParam() ? "on demand" : "all", before, all, 1e-6 * simulation.wellbore_pressure(),
              steps_with_more, residual);
  EXPECT_GE(steps_with_more, 3);
  EXPECT_LE(most_at_once, 2);
  EXPECT_EQ(wet_edges(simulation)[2].first, 0);
  EXPECT_LT(residual, 1e-3);
}

INSTANTIATE_TEST_SUITE_P(OnDemand, Joint, testing::Bool());

}  // namespace
}  // namespace crackle
