// SPDX-License-Identifier: GPL-3.0-or-later
//
// Patch tests (validation.md A1): a linear displacement of the boundary, and a uniform stress.
#include <gtest/gtest.h>

#include "../../result.hpp"
#include "crackle/solve/equilibrium.hpp"
#include "static_solve.hpp"

namespace crackle {
namespace {

using granite::at;

constexpr MeshPattern patterns[] = {MeshPattern::right, MeshPattern::cross, MeshPattern::shifted_rows};

std::shared_ptr<const Mesh> patch(MeshPattern pattern) {
  return std::make_shared<const Mesh>(
      jittered(structured_rectangle({-1, -1}, {1, 1}, 7, 6, pattern), 0.25, 11));
}

// Any displacement gradient gives the same deformation everywhere: inside follows the rim.
TEST(Patch, LinearDisplacementOfTheRim) {
  const Check check("A1 patch: linear displacement");
  double largest = 0.0;
  const double a = 1.3e-4, b = -0.7e-4, c = 2.1e-4, d = -1.9e-4;
  const auto linear = [&](Vec2 x) { return Vec2{a * x.x + b * x.y, c * x.x + d * x.y}; };
  for (const MeshPattern pattern : patterns) {
    const auto mesh = patch(pattern);
    State state = make_tied_state(mesh);
    set_mass(state, granite::density);
    fix_nodes(state, EdgeKind::outer);
    const Bulk bulk(*mesh, granite::stiffness(), granite::density, {}, {});
    for (Index n = 0; n < state.node_count(); ++n) {
      if (state.inverse_mass[at(n)] == 0.0) state.displacement[at(n)] = linear(state.node_reference(n));
    }
    solve_static(state, {bulk, nullptr, {}}, 1e-6);
    double worst = 0.0, spread = 0.0;
    for (Index n = 0; n < state.node_count(); ++n) {
      worst = std::max(worst, norm(state.displacement[at(n)] - linear(state.node_reference(n))) / 2.1e-4);
    }
    const Sym2 first = bulk.stress(state, 0);
    for (Index t = 0; t < mesh->triangle_count(); ++t) {
      spread = std::max(spread, granite::larger_part(granite::difference(bulk.stress(state, t), first)));
    }
    // Hooke's law of the linear strain, to the order of the strain
    const Sym2 hooke = granite::stiffness().stress({a, d, 0.5 * (b + c)});
    const double off = granite::larger_part(granite::difference(first, hooke)) / granite::larger_part(hooke);
    std::printf(
        "linear displacement: error %.1e, spread of stress %.1e, off Hooke's law by %.1e (strain 2e-4)\n",
        worst, spread / granite::larger_part(first), off);
    largest = std::max(largest, worst);
    EXPECT_LT(worst, 1e-12);
    EXPECT_LT(spread, 1e-10 * granite::larger_part(first));
    EXPECT_LT(off, 2e-3);
  }
  check.result(largest);
}

// A bar without Poisson effect, held at one end and pulled at the other: (1 + e) E (e + e²/2) = t.
TEST(Patch, BarPulledAtItsEnd) {
  const double modulus = 35e9, traction = 3.5e6;
  const auto mesh = std::make_shared<const Mesh>(
      jittered(structured_rectangle({0, 0}, {2, 0.5}, 12, 4, MeshPattern::cross), 0.25, 5));
  const Bulk bulk(*mesh, isotropic_plane_strain(modulus, 0.0), granite::density, {}, {});
  std::vector<char> fixed(mesh->vertices.size(), 0);
  for (std::size_t v = 0; v < fixed.size(); ++v) fixed[v] = mesh->vertices[v].x == 0.0;
  const auto pull = [&](const State&, std::span<Vec2> forces) {
    for (const Edge& edge : mesh->edges) {
      const Vec2 p = mesh->vertices[at(edge.vertex[0])], q = mesh->vertices[at(edge.vertex[1])];
      if (edge.kind != EdgeKind::outer || p.x != 2.0 || q.x != 2.0) continue;
      for (const Index side : {edge.side[0] + 0, (edge.side[0] + 1) % 3}) {
        forces[at(3 * edge.triangle[0] + side)] += {0.5 * traction * norm(q - p), 0.0};
      }
    }
  };
  const std::vector<Vec2> u = static_displacement(mesh, bulk, fixed, pull);
  double e = traction / modulus;
  for (int i = 0; i < 10; ++i) e -= ((1.0 + e) * (e + 0.5 * e * e) - traction / modulus) / (1.0 + 3.0 * e);
  double worst = 0.0;
  for (std::size_t v = 0; v < u.size(); ++v)
    worst = std::max(worst, norm(u[v] - Vec2{e * mesh->vertices[v].x, 0.0}) / (2.0 * e));
  std::printf("bar pulled at its end: error %.1e of the elongation\n", worst);
  EXPECT_LT(worst, 1e-11);
}

// In-situ stress with elements on all edges: nothing moves, every triangle keeps its stress.
TEST(Patch, UniformStressWithElements) {
  const Sym2 stress{-7.05e6, -4.9e6, 1.3e6};
  for (const MeshPattern pattern : patterns) {
    for (const bool absorbing : {false, true}) {
      Scene scene = granite::scene(patch(pattern));
      scene.stress = stress;
      scene.law = find_law("evans_marathe");
      scene.cohesive = granite::cohesive();
      scene.absorbing_boundary = absorbing;
      Simulation simulation(scene);
      EXPECT_EQ(simulation.geostatic_slips(), 0);
      const double imbalance = simulation.imbalance();
      for (int i = 0; i < 100; ++i) simulation.step(0.8 * simulation.stable().limit);
      double moved = 0.0, off = 0.0;
      for (const Vec2 u : simulation.state().displacement) moved = std::max(moved, norm(u));
      for (Index t = 0; t < scene.mesh->triangle_count(); ++t) {
        const Sym2 now = simulation.bulk().stress(simulation.state(), t);
        off = std::max(off,
                       granite::larger_part(granite::difference(now, stress)) / granite::larger_part(stress));
      }
      std::printf(
          "uniform stress, %s rim: imbalance %.1e; after 100 steps moved %.1e m, stress off by %.1e\n",
          absorbing ? "absorbing" : "fixed", imbalance, moved, off);
      EXPECT_LT(imbalance, 1e-12);
      EXPECT_LT(moved, 1e-15);
      EXPECT_LT(off, 1e-10);
    }
  }
}

// Stress that grows with depth, borne by the rock's weight: nothing moves.
TEST(Patch, StressThatGrowsWithDepth) {
  for (const MeshPattern pattern : patterns) {
    for (const bool on_demand : {false, true}) {
      Scene scene = granite::scene(patch(pattern));
      scene.stress = {-7.05e6, -4.9e6, 1.3e6};
      scene.stress_gradient = {-0.4e6, -0.7e6, 0.0};
      scene.law = find_law("evans_marathe");
      scene.cohesive = granite::cohesive();
      scene.insertion.on_demand = on_demand;
      Simulation simulation(scene);
      const double imbalance = simulation.imbalance();
      for (int i = 0; i < 100; ++i) simulation.step(0.8 * simulation.stable().limit);
      double moved = 0.0, off = 0.0;
      for (const Vec2 u : simulation.state().displacement) moved = std::max(moved, norm(u));
      for (Index t = 0; t < scene.mesh->triangle_count(); ++t) {
        const Sym2 there = scene.stress + -granite::centroid(*scene.mesh, t).y * scene.stress_gradient;
        const Sym2 now = simulation.bulk().stress(simulation.state(), t);
        off = std::max(off, granite::larger_part(granite::difference(now, there)) / 7.05e6);
      }
      std::printf(
          "growing stress, elements %s: imbalance %.1e; after 100 steps moved %.1e m, stress off by %.1e\n",
          on_demand ? "on demand" : "on all edges", imbalance, moved, off);
      EXPECT_LT(imbalance, 1e-12);
      EXPECT_LT(moved, 1e-15);
      EXPECT_LT(off, 1e-10);
    }
  }
}

// A column that is held at its top hangs and swings: with its weight in it the energy stays.
TEST(Patch, WeightIsInTheLedger) {
  const double gradient = -1e6;
  Mesh body = structured_rectangle({0, -2}, {1, 0}, 8, 16, MeshPattern::cross);
  Scene scene = granite::scene(granite::with_free_sides(std::move(body), [](Vec2 x) { return x.y < -1e-9; }));
  scene.stress_gradient = {0.0, gradient, 0.0};
  Simulation simulation(scene);
  State& state = simulation.state();
  Index foot = 0;
  for (Index n = 0; n < state.node_count(); ++n) {
    if (state.node_reference(n).y < state.node_reference(foot).y) foot = n;
  }
  // From standing, -w d at the depth d, to hanging, w (L - d): w L more everywhere.
  const double e = granite::young_modulus / (1.0 - granite::poisson_ratio * granite::poisson_ratio);
  const double expected = gradient * 2.0 * 2.0 / e, found = state.displacement[at(foot)].y;
  std::printf("column that hangs by its top: its foot %.4e m lower, %.4e by theory of slender ones\n", -found,
              -expected);
  EXPECT_NEAR(found / expected, 1.0, 0.05);
  for (std::size_t n = 0; n < state.velocity.size(); ++n) {
    if (state.inverse_mass[n] > 0.0) state.velocity[n] = {0.0, -0.1};
  }
  const auto total = [](const Energies& now) { return now.kinetic + now.strain; };
  const double at_first = total(simulation.step_and_account(0.5 * simulation.stable_limit()));
  double off = 0.0, lowest = 0.0;
  for (int i = 0; i < 2000; ++i) {
    off = std::max(
        off, std::abs(total(simulation.step_and_account(0.5 * simulation.stable_limit())) / at_first - 1.0));
    lowest = std::min(lowest, state.displacement[at(foot)].y - found);
  }
  std::printf("swings by %.2e m, energy off by %.1e\n", -lowest, off);
  EXPECT_LT(lowest, 0.2 * expected);
  EXPECT_LT(off, 1e-3);
}

}  // namespace
}  // namespace crackle
