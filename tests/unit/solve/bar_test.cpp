// SPDX-License-Identifier: GPL-3.0-or-later
//
// A bar whose halves fly apart, held by one edge: it breaks there, and the ledger closes.
#include <gtest/gtest.h>

#include "../../granite.hpp"

namespace crackle {
namespace {

using granite::at;

TEST(Bar, BreaksAtOneEdgeAndTheLedgerCloses) {
  for (const char* law : {"evans_marathe", "linear", "benzeggagh_kenane"}) {
    const double h = 3e-3;
    Scene scene = granite::scene(granite::free_body(
        structured_rectangle({-10 * h, -2.5 * h}, {10 * h, 2.5 * h}, 20, 5, MeshPattern::cross)));
    scene.law = find_law(law);
    scene.cohesive = granite::cohesive();
    Simulation simulation(scene);
    State& state = simulation.state();
    int cuts = 0;
    for (Index i = 0; i < state.cohesive.count();
         ++i) {  // all edges across the middle but the one at the axis
      const Edge& edge = scene.mesh->edges[at(state.cohesive.edge[at(i)])];
      const Vec2 a = scene.mesh->vertices[at(edge.vertex[0])], b = scene.mesh->vertices[at(edge.vertex[1])];
      if (std::abs(a.x) > 1e-9 || std::abs(b.x) > 1e-9 || std::abs(a.y + b.y) < 1e-9) continue;
      simulation.cohesive()->cut(state, i);
      ++cuts;
    }
    ASSERT_EQ(cuts, 4);
    for (Index n = 0; n < state.node_count(); ++n)
      state.velocity[at(n)] = {0.35 * state.node_reference(n).x / (10 * h), 0.0};
    const double dt = 0.5 * simulation.stable().limit;
    double first = 0.0, worst = 0.0, before = 0.0, least = 0.0;
    std::vector<SeismicEvent> events;
    for (int i = 0; i < 6000; ++i) {
      const Energies e = simulation.step_and_account(dt);
      events.insert(events.end(), simulation.new_events().begin(), simulation.new_events().end());
      const double spent = e.fracture + e.friction + e.viscous;
      const double total = e.kinetic + e.strain + e.cohesive + spent;
      if (i == 0) first = total;
      worst = std::max(worst, std::abs(total / first - 1.0));
      least = std::min(least, spent - before);
      before = spent;
    }
    const double energy = state.dissipation.fracture / h;
    std::printf(
        "%s: %zu broken, fracture energy %.4f of 5 J/m2, ledger within %.1e of the total, friction %.1e J/m, "
        "M %.2f\n",
        law, events.size(), energy, worst, state.dissipation.friction,
        events.empty() ? 0.0 : events.front().magnitude);
    ASSERT_EQ(events.size(), 1u);
    EXPECT_LT(norm(events[0].place), 1e-4);
    EXPECT_EQ(events[0].mode, FailureMode::tensile);
    EXPECT_NEAR(events[0].fracture_energy / h, 5.0, 0.05);
    EXPECT_NEAR(energy, 5.0, 0.05) << "nothing is dissipated elsewhere";
    EXPECT_LT(worst, 1e-3);
    EXPECT_GE(least, 0.0);
  }
}

}  // namespace
}  // namespace crackle
