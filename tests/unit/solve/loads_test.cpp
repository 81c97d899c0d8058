// SPDX-License-Identifier: GPL-3.0-or-later
//
// Loads and supports: a bar against E' ε, a body under in-situ stress with a free boundary, nodes that part
// under a load, the same bits after a resume; smeared damage beside cut edges.
#include <gtest/gtest.h>

#include "../../granite.hpp"
#include "crackle/core/errors.hpp"
#include "crackle/solve/estimates.hpp"

namespace crackle {
namespace {

using granite::at;

constexpr double length = 0.1, height = 0.025;

std::shared_ptr<const Mesh> bar() {
  return std::make_shared<const Mesh>(
      structured_rectangle({0, 0}, {length, height}, 20, 5, MeshPattern::cross));
}

Load roller(Load::Side side) {
  Load load;
  load.side = side;
  load.motion[side == Load::Side::left || side == Load::Side::right ? 0 : 1] = GivenMotion{0.0, true};
  return load;
}

Scene pulled_bar(const Load& end) {
  Scene s = granite::scene(bar());
  s.damping.ratio = 0.1;
  s.free_boundary = true;
  s.loads = {roller(Load::Side::left), roller(Load::Side::bottom), end};
  return s;
}

struct Outcome {
  double residual = 0.0;
  std::vector<LoadRecord> loads;
};
Outcome step_to(Simulation& s, double end) {
  Outcome r;
  while (s.state().time < end) {
    if (end - s.state().time < 0.2 * end && r.loads.empty()) s.take_loads(), r.loads.resize(1);
    const double dt = 0.8 * s.stable_limit();
    if (s.state().step % 20 == 0) {
      r.residual = std::max(r.residual, s.step_and_account(dt).residual);
    } else {
      s.step(dt);
    }
  }
  r.loads = s.take_loads();
  return r;
}

TEST(Loads, BarUnderATractionAndAGivenDisplacement) {
  const double stress = 1e6, modulus = plane_strain_modulus(granite::stiffness());
  Load traction, displacement, velocity;
  traction.side = displacement.side = velocity.side = Load::Side::right;
  traction.traction = {stress, 0.0};
  displacement.motion[0] = GivenMotion{stress / modulus * length, false};
  velocity.motion[0] = GivenMotion{stress / modulus * length / 1.5e-3, true};
  traction.ramp = displacement.ramp = velocity.ramp = 1e-3;  // the velocity's part of 2 ms: 1.5 ms
  for (const Load& load : {traction, displacement, velocity}) {
    Simulation s(pulled_bar(load));
    const Outcome r = step_to(s, 2e-3);
    const LoadRecord end = r.loads[2];
    const bool moves =
        load.motion[0] && load.motion[0]->is_velocity;  // the mean over the last 0.4 ms is earlier
    const double force = end.force.x / (height * stress) - (moves ? 1.0 - 0.2e-3 / 1.5e-3 : 1.0);
    const double moved = end.displacement.x / (stress / modulus * length) - 1.0;
    const double opposite = r.loads[0].force.x / end.force.x + 1.0;
    std::printf("bar: force %+.1e, displacement %+.1e, the other end's force %+.1e, ledger %.1e\n", force,
                moved, opposite, r.residual);
    EXPECT_LT(std::abs(force), 2e-3);
    EXPECT_LT(std::abs(moved), 2e-3);
    EXPECT_LT(std::abs(opposite), 2e-3);
    EXPECT_LT(r.residual, 1e-6);
  }
}

TEST(Loads, AFreeBoundaryBearsTheInSituStress) {
  for (const bool split : {false, true}) {
    Scene s = granite::scene(bar());
    s.stress = granite::anisotropic;
    s.law = find_law("benzeggagh_kenane");
    s.cohesive = granite::cohesive();
    s.insertion.on_demand = !split;
    s.free_boundary = true;
    Simulation simulation(s);
    const double imbalance = simulation.imbalance();
    for (int i = 0; i < 200; ++i) simulation.step(0.8 * simulation.stable_limit());
    double moved = 0.0;
    for (const Vec2 u : simulation.state().displacement) moved = std::max(moved, norm(u));
    std::printf("free under stress: imbalance %.1e, moved %.1e m in 200 steps\n", imbalance, moved);
    EXPECT_LT(imbalance, 1e-12);
    EXPECT_LT(moved, 1e-15);
  }
}

std::vector<Index> edges_up_from(const Mesh& mesh, double x, double to) {
  std::vector<Index> edges;
  for (Index e = 0; e < mesh.edge_count(); ++e) {
    const Vec2 a = mesh.vertices[at(mesh.edges[at(e)].vertex[0])],
               b = mesh.vertices[at(mesh.edges[at(e)].vertex[1])];
    if (std::abs(a.x - x) + std::abs(b.x - x) < 1e-9 && std::max(a.y, b.y) < to + 1e-9) edges.push_back(e);
  }
  return edges;
}

Scene notched_bar(bool damaged) {
  Load pull;
  pull.side = Load::Side::right;
  pull.motion[0] = GivenMotion{2e-3, true};
  pull.ramp = 1e-4;
  Scene s = pulled_bar(pull);
  s.law = find_law("benzeggagh_kenane");
  s.cohesive = granite::cohesive();
  s.insertion.on_demand = true;
  s.cracks = s.dry_cracks = edges_up_from(*s.mesh, 0.5 * length, 0.4 * height);
  if (damaged) {
    s.damage.law = find_softening("linear");
    s.damage.materials = {DamageMaterial{3e6, 24e6, 0.0, 0.0, 5.0, 80.0}};
  }
  return s;
}

TEST(Loads, HoldWhatParts) {
  for (const bool damaged : {false, true}) {
    Simulation s(notched_bar(damaged));
    const Outcome r = step_to(s, 3e-4);
    double mouth = 0.0, off = 0.0;
    int nodes = 0;
    for (Index n = 0; n < s.state().node_count(); ++n) {
      if (norm(s.state().node_reference(n) - Vec2{0.5 * length, 0.0}) > 1e-9) continue;
      mouth += (nodes++ == 0 ? -1.0 : 1.0) * s.state().displacement[at(n)].x;
      off = std::max(off, std::abs(s.state().displacement[at(n)].y));
    }
    std::printf("notch on rollers, %s: open %.3f um, off the roller by %.1e m, ledger %.1e\n",
                damaged ? "damage" : "elements", 1e6 * std::abs(mouth), off, r.residual);
    EXPECT_EQ(nodes, 2);
    EXPECT_GT(std::abs(mouth), 2e-8);
    EXPECT_LT(off, 1e-18);
    EXPECT_LT(r.residual, 1e-3);
  }
}

TEST(Loads, ResumeToTheSameBits) {
  for (const bool damaged : {false, true}) {
    const Scene scene = notched_bar(damaged);
    Simulation first(scene);
    const auto go = [](Simulation& s) {
      for (int i = 0; i < 300; ++i) s.step(0.8 * s.stable_limit());
    };
    go(first);
    Simulation second(scene, first.state(), first.memory());
    go(first);
    go(second);
    EXPECT_TRUE(first.state().displacement == second.state().displacement);
    const auto a = first.take_loads(), b = second.take_loads();
    for (std::size_t l = 0; l < a.size(); ++l) EXPECT_TRUE(a[l].force == b[l].force);
  }
}

TEST(Loads, RefuseATractionWithoutAnEdge) {
  Load load;
  load.traction = {1e6, 0.0};
  load.from = 0.001;
  load.to = 0.002;
  EXPECT_THROW(Simulation(pulled_bar(load)), MeshError);
}

}  // namespace
}  // namespace crackle
