// SPDX-License-Identifier: GPL-3.0-or-later
//
// A nearly rigid fluid in a closed crack, pumped slowly at the dry time step (methods.md 3.3): the
// pressure follows the crack's stiffness, whatever the bulk modulus. Griffith: V = 2π p a²/E'.
#include <gtest/gtest.h>

#include "../granite.hpp"
#include "crackle/solve/estimates.hpp"

namespace crackle {
namespace {

using granite::at;

constexpr double half = 0.04, side = 0.4;  // of the crack, of the block [m]
constexpr double rate = 1.5e-4;            // [m2/s]

struct Result {
  double pressure = 0.0, griffith = 0.0;  // [Pa]
  double fastest = 0.0;                   // [m/s]
  double stored = 0.0;                    // over what was injected
};

// @param cells over the side of the block
Result pump(int cells, double bulk_modulus, double end) {
  const double penalty = 20.0 * granite::young_modulus;
  const auto mesh = std::make_shared<const Mesh>(structured_rectangle(
      {-0.5 * side, -0.5 * side}, {0.5 * side, 0.5 * side}, cells, cells, MeshPattern::right));
  Scene scene = granite::scene(mesh);
  scene.damping.ratio = 0.3;
  scene.law = find_law("linear");
  scene.cohesive = granite::unbreakable(penalty);
  Simulation simulation(scene);
  State& state = simulation.state();
  std::vector<Index> crack;
  for (Index i = 0; i < state.cohesive.count(); ++i) {
    const Edge& edge = mesh->edges[at(state.cohesive.edge[at(i)])];
    const auto outside = [&](Index v) {
      const Vec2 x = mesh->vertices[at(v)];
      return std::abs(x.y) > 1e-9 || std::abs(x.x) > half + 1e-9;
    };
    if (outside(edge.vertex[0]) || outside(edge.vertex[1])) continue;
    simulation.cohesive()->cut(state, i);
    crack.push_back(state.cohesive.edge[at(i)]);
    // ajar, so that there is fluid in it from the start
    const Index upper = edge.triangle[granite::centroid(*mesh, edge.triangle[0]).y > 0.0 ? 0 : 1];
    for (Index c = 3 * upper; c < 3 * upper + 3; ++c) {
      if (std::abs(state.reference(c).y) < 1e-9) state.displacement[at(c)].y = 1e-10;
    }
  }
  Fluid fluid(state, {bulk_modulus, 1000.0, 0.0}, Pump({{0.0, 1.0, rate}}));
  fluid.fill(state, crack, 0.0);
  const double first = state.fluid.cavities[0].mass / 1000.0, dt = 0.9 * simulation.stable().limit;
  Result r;
  while (state.time < end) {
    const double now = state.time;
    simulation.step(dt);
    state.time = now;
    fluid.advance(state, dt);
    state.time = now + dt;
    for (const Vec2 v : state.velocity) r.fastest = std::max(r.fastest, norm(v));
  }
  const double stiff = plane_strain_modulus(scene.stiffness);
  const double modulus = stiff * artificial_modulus_ratio(stiff, scene.stiffness.c66, penalty,
                                                          measure_mesh(*mesh).sum_length2_over_area)
                                     .young;
  r.pressure = state.fluid.cavities[0].pressure;
  r.griffith = rate * state.time * modulus / (2.0 * std::numbers::pi * half * half);
  r.stored = (state.fluid.cavities[0].mass / 1000.0 - first) / (rate * state.time);
  std::printf(
      "%zu edges, K_f %.1e Pa: pressure %.4f MPa (Griffith %+.1f %%), fastest %.4f m/s, stored / injected - "
      "1 = %.0e\n",
      crack.size(), bulk_modulus, r.pressure / 1e6, 100 * (r.pressure / r.griffith - 1.0), r.fastest,
      r.stored - 1.0);
  return r;
}

TEST(ThinCrack, TakesANearlyRigidFluid) {
  double first = 0.0;
  for (const double bulk_modulus : {2.2e9, 2.2e10, 2.2e11, 2.2e12, 2.2e13, 2.2e14}) {
    const Result r = pump(40, bulk_modulus, 0.5e-3);
    if (first == 0.0) first = r.pressure;
    EXPECT_NEAR(r.pressure / first, 1.0, 0.01);
    EXPECT_NEAR(r.stored, 1.0, 1e-10);
    EXPECT_LT(r.fastest, 0.05);
  }
}

TEST(ThinCrack, ComesToGriffithsPressure) {
  double coarse = 0.0, fine = 0.0;
  for (const int cells : {40, 80}) {
    const Result r = pump(cells, 2.2e14, 0.4e-3);
    (cells == 40 ? coarse : fine) = r.pressure / r.griffith - 1.0;
  }
  std::printf("Griffith: %.1f %% and %.1f %%, order %.2f\n", 100 * coarse, 100 * fine,
              std::log2(coarse / fine));
  EXPECT_LT(coarse, 0.3);
  EXPECT_LT(std::abs(fine), 0.15);
  EXPECT_GT(std::log2(coarse / fine), 0.6) << "first order, and the box";
}

}  // namespace
}  // namespace crackle
