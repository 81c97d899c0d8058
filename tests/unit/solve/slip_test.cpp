// SPDX-License-Identifier: GPL-3.0-or-later
//
// A joint across a compressed plate whose halves are pushed past one another: it slides, stops, and is one
// event. Where it parts the plate, the halves slide on past their partners and it still is one.
#include <gtest/gtest.h>

#include <algorithm>
#include <optional>

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

struct Halves {
  Scene scene;
  double height = 0.1;  // of each [m]
};

// Two blocks on one another, 0.4 m long, pressed by 1 MPa, edges of 20 mm between them.
Halves halves() {
  Halves two;
  Mesh mesh = structured_rectangle({-0.2, -two.height}, {0.2, two.height}, 20, 10, MeshPattern::cross);
  for (Index e = 0; e < mesh.edge_count(); ++e) {
    Edge& edge = mesh.edges[at(e)];
    const double y =
        std::abs(mesh.vertices[at(edge.vertex[0])].y) + std::abs(mesh.vertices[at(edge.vertex[1])].y);
    if (y > 1e-9) continue;
    edge.joint = 0;
    two.scene.cracks.push_back(e);
  }
  auto cracks = two.scene.cracks;
  two.scene = granite::scene(std::make_shared<const Mesh>(std::move(mesh)));
  two.scene.cracks = std::move(cracks);
  two.scene.law = find_law("evans_marathe");
  two.scene.cohesive = granite::cohesive();
  two.scene.cohesive.tensile_strength = two.scene.cohesive.cohesion = 1e9;
  two.scene.cohesive.fracture_energy_mode1 = two.scene.cohesive.fracture_energy_mode2 = 1e6;
  two.scene.cohesive.tan_residual = 0.3;
  two.scene.contact = {250e9, 30e9, 0.3};
  two.scene.stress = {0.0, -1e6, 0.0};
  two.scene.damping.viscosity = 2e4;
  two.scene.free_boundary = true;
  two.scene.insertion.on_demand = true;
  return two;
}

TEST(SlipInGeneralContact, IsOneEventFarBeyondThePartners) {
  const Halves two = halves();
  Simulation simulation(two.scene);
  State& state = simulation.state();
  const auto upper = [&](Index n) {
    const Index triangle = state.node_corners[at(state.node_first[at(n)])] / 3;
    double height = 0.0;
    for (Index i = 0; i < 3; ++i) height += state.reference(3 * triangle + i).y;
    return height > 0.0;
  };
  const double speed = 8.0;
  for (Index n = 0; n < state.node_count(); ++n) state.velocity[at(n)] = {upper(n) ? speed : -speed, 0.0};
  const double before = state.dissipation.friction;
  const double dt = 0.4 * simulation.stable_limit();
  std::vector<SeismicEvent> events, resumed_events;
  std::optional<Simulation> resumed;
  const auto step = [&](Simulation& s, std::vector<SeismicEvent>& all) {
    s.step(dt);
    all.insert(all.end(), s.new_events().begin(), s.new_events().end());
  };
  const int last = static_cast<int>(9e-3 / dt);
  for (int i = 0; i < last; ++i) {
    if (i == last / 2) {
      ASSERT_FALSE(state.slips.edges.empty());
      resumed.emplace(two.scene, state, simulation.memory());
      resumed_events = events;
    }
    step(simulation, events);
    if (resumed) step(*resumed, resumed_events);
  }
  for (const SeismicEvent& e : simulation.end_slips()) events.push_back(e);
  for (const SeismicEvent& e : resumed->end_slips()) resumed_events.push_back(e);
  EXPECT_EQ(events, resumed_events);

  double friction = 0.0;
  for (const SeismicEvent& e : events) {
    ASSERT_EQ(e.kind, EventKind::slip);
    friction += e.friction_energy;
    if (e.length * std::abs(e.slip) > 1e-5) {
      std::printf(
          "slip of %d at %.2f ms for %.2f ms: %.3e m over %.3f m, drop %.2e Pa, dissipated %.4e J/m\n",
          e.edges, 1e3 * e.time, 1e3 * e.duration, e.slip, e.length, e.stress_drop, e.friction_energy);
    }
  }
  double moved[2] = {0.0, 0.0}, mass[2] = {0.0, 0.0};
  for (Index n = 0; n < state.node_count(); ++n) {
    const double m = 1.0 / state.inverse_mass[at(n)];
    moved[upper(n)] += m * state.displacement[at(n)].x;
    mass[upper(n)] += m;
  }
  const double apart = moved[1] / mass[1] - moved[0] / mass[0];
  const double all = state.dissipation.friction - before;
  Index released = 0;
  for (const CohesiveStatus s : state.cohesive.status) released += s == CohesiveStatus::released;
  std::printf("apart by %.2f edges, %d of 20 edges released; friction of the %zu events %.5e of %.5e J/m\n",
              apart / 0.02, released, events.size(), friction, all);
  EXPECT_GT(apart, 0.04);
  EXPECT_EQ(released, 20);
  EXPECT_NEAR(friction / all, 1.0, 0.02);
  const SeismicEvent& main = *std::ranges::max_element(events, {}, &SeismicEvent::friction_energy);
  EXPECT_GT(main.friction_energy, 0.95 * all);
  EXPECT_NEAR(main.stress_drop, 0.0, 0.3e6);
  EXPECT_GT(moment_shares(main.moment).dc, 0.9);
}

}  // namespace
}  // namespace crackle
