// SPDX-License-Identifier: GPL-3.0-or-later
//
// Elements inserted on demand carry on what their edges bore: T6 of the stability list.
#include <gtest/gtest.h>

#include "../../granite.hpp"

namespace crackle {
namespace {

using granite::at;

constexpr double h = 3e-3;

// A bar under uniform tension, ends held, whose edges all come to the threshold in the first step.
Scene pulled_bar(double share) {
  Mesh mesh = jittered(structured_rectangle({0, 0}, {40 * h, 8 * h}, 40, 8, MeshPattern::cross), 0.2, 2);
  Scene scene = granite::scene(std::make_shared<const Mesh>(std::move(mesh)));
  scene.law = find_law("linear");
  scene.cohesive = granite::cohesive();
  scene.insertion.on_demand = true;
  scene.stress = {share * scene.cohesive.tensile_strength, 0.0, 0.0};
  return scene;
}

TEST(Insertion, UnderUniformStressNothingMoves) {
  Simulation simulation(pulled_bar(0.8));
  const State& state = simulation.state();
  const double dt = 0.5 * simulation.stable_limit();
  double fastest = 0.0, residual = 0.0;
  for (int i = 0; i < 2000; ++i) {
    residual = std::max(residual, simulation.step_and_account(dt).residual);
    for (const Vec2 v : state.velocity) fastest = std::max(fastest, norm(v));
  }
  const WaveSpeeds c = wave_speeds(simulation.scene().stiffness, simulation.scene().density);
  const double wave = simulation.scene().density * c.p * fastest / simulation.scene().stress.xx;
  std::printf("%d of %d edges inserted, %d roughly; waves of %.1e of the stress, residual %.1e\n",
              state.cohesive.count(), state.mesh->edge_count(), simulation.rough_insertions(), wave,
              residual);
  EXPECT_GT(state.cohesive.count(), 300);
  EXPECT_EQ(simulation.rough_insertions(), 0);
  EXPECT_LT(wave, 1e-9);
}

// With the same values on all planes bedding changes nothing: on demand, and with elements on all edges,
// which then are evaluated one by one.
TEST(Insertion, BeddingWithEqualValuesChangesNothing) {
  for (const bool demand : {true, false}) {
    std::array<std::vector<Vec2>, 2> displacement;
    for (const bool bedded : {false, true}) {
      Scene scene = pulled_bar(0.6);
      scene.insertion.on_demand = demand;
      CohesiveMaterial& m = scene.cohesive;
      if (bedded)
        m.bedding = {{0.6, 0.8},
                     1.0,
                     m.tensile_strength,
                     m.cohesion,
                     m.fracture_energy_mode1,
                     m.fracture_energy_mode2};
      Simulation simulation(scene);
      State& state = simulation.state();
      for (Index n = 0; n < state.node_count(); ++n) {
        if (state.inverse_mass[at(n)] > 0.0)
          state.velocity[at(n)] = {0.002 * state.node_reference(n).x / h, 0.0};
      }
      const double dt = 0.5 * simulation.stable_limit();
      for (int i = 0; i < 300; ++i) simulation.step(dt);
      EXPECT_GT(state.cohesive.count(), 100);
      displacement[bedded ? 1 : 0] = state.displacement;
    }
    ASSERT_EQ(displacement[0].size(), displacement[1].size());
    double worst = 0.0, largest = 0.0;
    for (std::size_t n = 0; n < displacement[0].size(); ++n) {
      worst = std::max(worst, norm(displacement[0][n] - displacement[1][n]));
      largest = std::max(largest, norm(displacement[0][n]));
    }
    std::printf("%s: displacements differ by %.1e\n", demand ? "on demand" : "all edges", worst / largest);
    EXPECT_LT(worst, 1e-9 * largest);
  }
}

// A wave runs through the bar and meets the edges that it brings to the threshold. No energy comes or
// goes; what it changes is the compliance of their springs, and the less the stiffer they are (at a
// smaller step).
TEST(Insertion, AWaveGoesOn) {
  const auto run = [](bool demand, double step) {
    Scene scene = pulled_bar(0.6);
    scene.cohesive.penalty = scene.cohesive.tangential_penalty = 1e14;
    scene.insertion.step = step;
    scene.insertion.threshold = demand ? 0.7 : 1e6;
    Simulation simulation(scene);
    State& state = simulation.state();
    const WaveSpeeds c = wave_speeds(scene.stiffness, scene.density);
    const double v0 = 0.3 * scene.cohesive.tensile_strength / (scene.density * c.p);
    for (Index n = 0; n < state.node_count(); ++n) {
      const double s = (state.node_reference(n).x - 10 * h) / (6 * h);
      const double pulse = std::abs(s) < 1.0 ? 0.5 * (1.0 + std::cos(std::numbers::pi * s)) : 0.0;
      if (state.inverse_mass[at(n)] > 0.0) state.velocity[at(n)] = {-v0 * pulse, 0.0};
    }
    const double end = 15 * h / c.p;
    const double dt = end / std::ceil(end / (0.5 * simulation.stable().limit));
    double first = 0.0, worst = 0.0;
    while (state.time < end - 0.5 * dt) {
      EXPECT_LT(dt, simulation.stable_limit());
      const Energies e = simulation.step_and_account(dt);
      const double total = e.kinetic + e.strain + e.cohesive + e.fracture + e.viscous;
      if (first == 0.0) first = total;
      worst = std::max(worst, std::abs(total / first - 1.0));
    }
    if (demand) {
      std::printf("step %.2f: %d inserted, %d roughly, ledger within %.1e\n", step, state.cohesive.count(),
                  simulation.rough_insertions(), worst);
      EXPECT_GT(state.cohesive.count(), 20);
      EXPECT_LT(worst, 1e-4);
    }
    std::vector<Vec2> velocity;
    for (const Index n : state.node_of_corner) velocity.push_back(state.velocity[at(n)]);
    return velocity;
  };
  const auto difference = [&](double step) {
    const auto whole = run(false, step), inserted = run(true, step);
    double miss = 0.0, sum = 0.0;
    for (std::size_t k = 0; k < whole.size(); ++k) {
      miss += dot(inserted[k] - whole[k], inserted[k] - whole[k]);
      sum += dot(whole[k], whole[k]);
    }
    std::printf("velocities differ by %.2f %%\n", 100.0 * std::sqrt(miss / sum));
    return std::sqrt(miss / sum);
  };
  const double soft = difference(0.6), stiff = difference(0.1);
  EXPECT_LT(stiff, 0.02);
  EXPECT_LT(stiff, 0.2 * soft);
}

}  // namespace
}  // namespace crackle
