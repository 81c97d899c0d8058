// SPDX-License-Identifier: GPL-3.0-or-later
//
// A joint across a compressed plate whose halves are pushed past one another: it slides, stops, and is one
// event.
#include <gtest/gtest.h>

#include "../../granite.hpp"

namespace crackle {
namespace {

using granite::at;

TEST(SlipOfAJoint, IsOneEventAndItsFrictionIsTheLedgers) {
  const double h = 0.02;
  Mesh mesh = structured_rectangle({-0.2, -0.1}, {0.2, 0.1}, 20, 10, MeshPattern::cross);
  std::vector<Index> joint;
  for (Index e = 0; e < mesh.edge_count(); ++e) {
    Edge& edge = mesh.edges[at(e)];
    const Vec2 a = mesh.vertices[at(edge.vertex[0])], b = mesh.vertices[at(edge.vertex[1])];
    if (std::abs(a.y) + std::abs(b.y) > 1e-9 || std::abs(a.x + b.x) > 0.2) continue;
    edge.joint = 0;
    joint.push_back(e);
  }
  ASSERT_EQ(joint.size(), 10u);
  Scene scene = granite::scene(std::make_shared<const Mesh>(std::move(mesh)));
  scene.law = find_law("evans_marathe");
  scene.cohesive = granite::cohesive();
  scene.cohesive.tensile_strength = scene.cohesive.cohesion = 1e9;  // the rock holds
  scene.cohesive.fracture_energy_mode1 = scene.cohesive.fracture_energy_mode2 = 1e6;
  scene.cohesive.tan_residual = 0.3;
  scene.stress = {-5e6, -5e6, 1e6};
  scene.damping.viscosity = 2e4;
  scene.cracks = joint;
  Simulation simulation(scene);
  State& state = simulation.state();
  const double before = state.dissipation.friction;
  // the upper half to the right, the lower to the left, fading towards the fixed boundary
  for (Index n = 0; n < state.node_count(); ++n) {
    const Vec2 x = state.node_reference(n);
    const Index triangle = state.node_corners[at(state.node_first[at(n)])] / 3;
    double height = 0.0;
    for (Index i = 0; i < 3; ++i) height += state.reference(3 * triangle + i).y;
    const double side = height > 0.0 ? 1.0 : -1.0;
    const double fade = (1.0 - std::abs(x.x) / 0.2) * (1.0 - std::abs(x.y) / 0.1);
    if (state.inverse_mass[at(n)] > 0.0) state.velocity[at(n)] = {side * 1.0 * fade, 0.0};
  }
  const double dt = 0.5 * simulation.stable().limit;
  std::vector<SeismicEvent> events;
  for (int i = 0; i < 1500; ++i) {
    simulation.step(dt);
    events.insert(events.end(), simulation.new_events().begin(), simulation.new_events().end());
  }
  for (const SeismicEvent& e : simulation.end_slips()) events.push_back(e);
  double friction = 0.0;
  for (const SeismicEvent& e : events) {
    EXPECT_EQ(e.kind, EventKind::slip);
    friction += e.friction_energy;
    std::printf(
        "slip of %d edges at %.1f us for %.1f us: %.2e m, drop %.2e Pa, radiated %.2e, dissipated %.3e J/m\n",
        e.edges, 1e6 * e.time, 1e6 * e.duration, e.slip, e.stress_drop, e.energy, e.friction_energy);
  }
  const double all = state.dissipation.friction - before;
  std::printf("friction of the events %.4e of %.4e J/m\n", friction, all);
  ASSERT_GT(events.size(), 1u);
  const SeismicEvent& first = events.front();
  EXPECT_EQ(first.edges, 10);
  EXPECT_NEAR(first.length, 10 * h, 1e-12);
  EXPECT_EQ(first.energy, 0.0) << "its motion was there before it slid";
  EXPECT_GT(events[1].energy, 0.0) << "what the waves that it sent out make slip";
  EXPECT_GE(first.time, 0.0);
  EXPECT_NEAR(friction / all, 1.0, 0.01) << "slower slip than an event's is left out";
  EXPECT_GT(moment_shares(first.moment).dc, 0.9);
  EXPECT_GT(std::abs(first.slip), 1e-7);
}

}  // namespace
}  // namespace crackle
