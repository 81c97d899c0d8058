// SPDX-License-Identifier: GPL-3.0-or-later
//
// Each guard finds what it is there for, names the place, and finds nothing in a run as it should be.
#include "crackle/solve/guards.hpp"

#include <gmock/gmock.h>

#include "../../granite.hpp"

namespace crackle {
namespace {

using granite::at;
using testing::HasSubstr;

constexpr double h = 5e-3;

// A free block of rock, elements on all edges.
Scene block() {
  Scene scene = granite::scene(
      granite::free_body(structured_rectangle({0, 0}, {10 * h, 10 * h}, 10, 10, MeshPattern::cross)));
  scene.law = find_law("benzeggagh_kenane");
  scene.cohesive = granite::cohesive();
  return scene;
}

// Stretched across by a share of its strength, at rest: it rings when it is let go.
void stretch(Simulation& simulation, double share) {
  State& state = simulation.state();
  const double strain =
      share * simulation.scene().cohesive.tensile_strength / simulation.scene().stiffness.c11;
  for (Index n = 0; n < state.node_count(); ++n)
    state.displacement[at(n)].y = strain * state.node_reference(n).y;
}

std::vector<Finding> run(Simulation& simulation, Guards& guards, double dt, int steps) {
  std::vector<Finding> all;
  for (int i = 0; i < steps; ++i) {
    Energies e = simulation.step_and_account(dt);
    e.residual = 0.0;  // the ledger knows nothing of the stretch
    for (const Finding& f : guards.after_step(simulation, e)) all.push_back(f);
  }
  return all;
}

bool has(const std::vector<Finding>& findings, Alarm alarm) {
  return std::any_of(findings.begin(), findings.end(), [&](const Finding& f) { return f.alarm == alarm; });
}

TEST(Guards, FindNothingInASoundRun) {
  Simulation simulation(block());
  stretch(simulation, 0.3);
  Guards guards(simulation);
  for (const Finding& f : run(simulation, guards, 0.8 * simulation.stable_limit(), 2000))
    ADD_FAILURE() << f.text;
  EXPECT_EQ(guards.memory().alarms, 0);
}

TEST(Guards, FindAStepThatIsTooLong) {
  Simulation simulation(block());
  stretch(simulation, 0.3);
  Guards guards(simulation);
  const auto found = run(simulation, guards, 1.4 * simulation.stable_limit(), 400);
  ASSERT_FALSE(found.empty());
  for (const Finding& f : found) std::printf("%s\n", f.text.c_str());
  EXPECT_EQ(found.front().alarm, Alarm::grid_oscillation);
  EXPECT_TRUE(found.front().stops);
  EXPECT_THAT(found.front().text, testing::AllOf(HasSubstr("step"), HasSubstr("1.4 times the stable one")));
  EXPECT_TRUE(has(found, Alarm::made_energy));
  EXPECT_GT(guards.memory().alarms, static_cast<std::int64_t>(found.size())) << "counted, said once";
}

TEST(Guards, FindRockThatBreaksWhereNothingPulls) {
  Simulation simulation(block());
  Guards guards(simulation);
  State& state = simulation.state();
  // Elements far from one another and from the sides, each pulled open by itself, its neighbours by less than
  // half.
  std::vector<Index> pulled;
  for (Index e = 0; e < state.cohesive.count(); ++e) {
    const Vec2 x = Cohesive::place(state, e);
    const bool inside = std::min({x.x, x.y, 10 * h - x.x, 10 * h - x.y}) > 1.5 * h;
    const bool alone = std::all_of(pulled.begin(), pulled.end(), [&](Index other) {
      return norm(Cohesive::place(state, other) - x) > 1.6 * h;
    });
    if (!inside || !alone) continue;
    pulled.push_back(e);
    for (std::size_t k = 0; k < 4; ++k) {
      const Vec2 along = state.cohesive.direction[at(e)];
      const Vec2 away = (3e-6 / norm(along)) * right_normal(along);
      state.displacement[at(state.cohesive.nodes[at(e)][k])] += k < 2 ? -away : away;
    }
  }
  // In the first step they are found near their strength, in the second they break.
  for (int i = 0; i < 2; ++i) simulation.step(0.001 * simulation.stable_limit());
  const auto found = guards.after_step(simulation);
  std::printf("%zu pulled, %ld stray\n", pulled.size(), static_cast<long>(guards.memory().stray));
  ASSERT_TRUE(has(found, Alarm::stray_breaks));
  std::printf("%s\n", found.front().text.c_str());
  EXPECT_THAT(found.front().text, testing::AllOf(HasSubstr("element"), HasSubstr(") m, at step 2,")));
}

TEST(Guards, FindLargeMotionAndCrushedTriangles) {
  Scene scene = block();
  scene.law = nullptr;
  Simulation simulation(scene);
  Guards guards(simulation);
  State& state = simulation.state();
  const double dt = 0.01 * simulation.stable_limit();
  std::vector<Finding> found;
  for (int i = 0; i < 256; ++i) {
    if (i == 31) state.velocity[at(state.node_of_corner[3 * 57])] = {0.0, 0.1 * h / dt};
    if (i == 255) {
      for (Index n = 0; n < state.node_count(); ++n)
        state.displacement[at(n)].x = -0.9 * state.node_reference(n).x;
    }
    simulation.step(dt);
    for (const Finding& f : guards.after_step(simulation)) found.push_back(f);
  }
  ASSERT_TRUE(has(found, Alarm::large_motion));
  EXPECT_THAT(found.front().text, HasSubstr("of its edge in one step, at step 32,"));
  EXPECT_TRUE(has(found, Alarm::crushed_triangle));
}

TEST(Guards, FindWhatTheLedgerSays) {
  Simulation simulation(block());
  Guards guards(simulation);
  simulation.state().time = 1.0;
  Energies e;
  e.external = e.strain = 10.0;
  e.residual = 2e-3;
  auto found = guards.after_step(simulation, e);
  ASSERT_TRUE(has(found, Alarm::energy_residual));
  EXPECT_FALSE(found.front().stops);
  EXPECT_THAT(found.front().text, HasSubstr("warning: energy residual 0.002"));
  EXPECT_TRUE(guards.after_step(simulation, e).empty()) << "said once";
  e.residual = 2e-2;
  found = guards.after_step(simulation, e);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_TRUE(found.front().stops);
  e.residual = 0.0;
  e.kinetic = 6.0;
  found = guards.after_step(simulation, e);
  ASSERT_TRUE(has(found, Alarm::shaking));
  EXPECT_FALSE(found.front().stops);
  EXPECT_EQ(guards.memory().alarms, 1);
}

}  // namespace
}  // namespace crackle
