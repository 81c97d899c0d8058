// SPDX-License-Identifier: GPL-3.0-or-later
//
// Flow in a straight crack of given opening, against the solutions of lubrication; walls that do not move.
#include "crackle/fluid/viscous_flow.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "crackle/cohesive/cohesive.hpp"
#include "crackle/fluid/fluid.hpp"
#include "crackle/mesh/mesh.hpp"

namespace crackle {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

// Gauss with the largest pivots.
void solve_dense(std::span<const MatrixEntry> entries, std::span<double> b, bool) {
  const std::size_t n = b.size();
  std::vector<double> a(n * n, 0.0);
  for (const MatrixEntry& e : entries) a[at(e.row) * n + at(e.column)] += e.value;
  for (std::size_t k = 0; k < n; ++k) {
    std::size_t p = k;
    for (std::size_t i = k; i < n; ++i)
      if (std::abs(a[i * n + k]) > std::abs(a[p * n + k])) p = i;
    std::swap_ranges(&a[k * n], &a[k * n] + n, &a[p * n]);
    std::swap(b[k], b[p]);
    for (std::size_t i = k + 1; i < n; ++i) {
      const double f = a[i * n + k] / a[k * n + k];
      if (f == 0.0) continue;
      for (std::size_t j = k; j < n; ++j) a[i * n + j] -= f * a[k * n + j];
      b[i] -= f * b[k];
    }
  }
  for (std::size_t k = n; k-- > 0;) {
    for (std::size_t j = k + 1; j < n; ++j) b[k] -= a[k * n + j] * b[j];
    b[k] /= a[k * n + k];
  }
}

constexpr double length = 0.5, step = 0.0125, opening = 1e-4, viscosity = 1e-3, modulus = 2.2e9, rate = 1e-4;

/// A crack along y = 0 of 2 x `length`, opened evenly; pumped in its middle. `filled`: that far it holds
/// fluid at first [m]
struct Crack {
  std::shared_ptr<const Mesh> mesh = std::make_shared<const Mesh>(structured_rectangle(
      {-2.0 * length, -2.0 * step}, {2.0 * length, 2.0 * step}, 160, 4, MeshPattern::cross));
  State state = make_split_state(mesh);
  Cohesive cohesive{find_law("linear"), CohesiveMaterial{}};
  CompressibleFluid properties{modulus, 1000.0, 0.0};
  std::optional<Fluid> fluid;
  double mass = 0.0;

  explicit Crack(double filled) {
    insert_all(state);
    std::vector<Index> wet, rest;
    for (Index e = 0; e < mesh->edge_count(); ++e) {
      const Vec2 a = mesh->vertices[at(mesh->edges[at(e)].vertex[0])],
                 b = mesh->vertices[at(mesh->edges[at(e)].vertex[1])];
      const double far = std::max(std::abs(a.x), std::abs(b.x));
      if (std::abs(a.y) > 1e-12 || std::abs(b.y) > 1e-12 || far > length + 1e-9) continue;
      cohesive.cut(state, state.cohesive.of_edge[at(e)]);
      if (far < filled + 1e-9) {
        wet.push_back(e);
      } else {
        rest.push_back(state.cohesive.of_edge[at(e)]);
      }
    }
    for (std::size_t t = 0; t < mesh->triangles.size(); ++t) {
      double y = 0.0;
      for (const Index v : mesh->triangles[t]) y += mesh->vertices[at(v)].y;
      for (std::size_t i = 0; i < 3; ++i)
        state.displacement[at(state.node_of_corner[3 * t + i])] = {0.0, std::copysign(0.5 * opening, y)};
    }
    fluid.emplace(state, properties, Pump({{0.0, 1.0, rate}}));
    fluid->fill(state, wet, 0.0);
    fluid->flow(state, {FractureFluid{.viscosity = viscosity, .cavitation_pressure = 0.0}, solve_dense});
    fluid->connect(state, rest);
    mass = held();
  }
  double held() const {
    double sum = 0.0;
    for (const FlowCell& cell : state.fluid.cells) sum += cell.mass;
    return sum;
  }
  void run(double end, double dt) {
    while (state.time < end * (1.0 - 1e-9)) {
      fluid->advance(state, dt);
      state.time += dt;
    }
  }
  double middle(const FlowCell& cell) const {
    const auto& v = mesh->edges[at(cell.edge)].vertex;
    return 0.5 * (mesh->vertices[at(v[0])].x + mesh->vertices[at(v[1])].x);
  }
};

// All of it filled: p rises evenly, and falls from the middle by 12 μ q L/(2 w³) (1 − x/L)², q = Q/2.
TEST(ViscousFlow, FillsACrackOfGivenOpening) {
  Crack crack(length);
  constexpr double dt = 1e-5, end = 1e-3;
  crack.run(end, dt);
  const double w = opening + 1e-6, drop = 12.0 * viscosity * 0.5 * rate * length / (2.0 * w * w * w);
  const double mean = modulus * std::log1p(rate * end / (2.0 * length * w));
  double worst = 0.0;
  for (const FlowCell& cell : crack.state.fluid.cells) {
    const double x = 1.0 - std::abs(crack.middle(cell)) / length;
    worst = std::max(worst, std::abs(cell.pressure - mean - drop * (x * x - 1.0 / 3.0)) / drop);
  }
  const double limit = 6.0 * viscosity * step * step / (modulus * w * w);
  const double lost = crack.held() - crack.mass - rate * end * crack.properties.density;
  std::printf(
      "crack of given opening: pressure within %.2e of its fall of %.3f MPa, mass %.1e; steps %.0f times the "
      "explicit limit\n",
      worst, 1e-6 * drop, lost / crack.held(), dt / limit);
  EXPECT_LT(worst, 2e-3);
  EXPECT_LT(std::abs(lost), 1e-12 * crack.held());
  EXPECT_GT(dt, 100.0 * limit);
}

// A front: behind it the pressure falls evenly to 0, before it there is nothing.
TEST(ViscousFlow, FrontMovesIntoWhatIsEmpty) {
  Crack crack(0.1);
  constexpr double dt = 2e-5, end = 0.4;
  const double w = opening + 1e-6;
  crack.run(end, dt);
  const double front = 0.1 + 0.5 * rate * end / w, q = 0.5 * rate;
  double worst = 0.0, beyond = 0.0;
  for (const FlowCell& cell : crack.state.fluid.cells) {
    const double x = std::abs(crack.middle(cell)), exact = 12.0 * viscosity * q * (front - x) / (w * w * w);
    if (x < front - step) worst = std::max(worst, std::abs(cell.pressure - exact));
    if (x > front + step) beyond = std::max({beyond, std::abs(cell.pressure), cell.mass});
  }
  const double highest = 12.0 * viscosity * q * front / (w * w * w);
  // viscous: ∫ 12 μ q² x_f/w³ dt on both sides, from the middle of the edges that it is pumped into
  const double spent =
      2.0 * 12.0 * viscosity * q * q / (w * w * w) * (0.1 - 0.5 * step + 0.5 * (front - 0.1)) * end;
  std::printf("front at %.4f m: pressure within %.1e of %.4f MPa; beyond it %.1e; viscous %.4f of %.4f J/m\n",
              front, worst / highest, 1e-6 * highest, beyond, crack.state.dissipation.viscous, spent);
  EXPECT_GT(front, 0.25);
  EXPECT_LT(worst, 0.02 * highest);
  EXPECT_EQ(beyond, 0.0);
  EXPECT_NEAR(crack.state.dissipation.viscous / spent, 1.0, 5e-3);
  EXPECT_LT(std::abs(crack.held() - crack.mass - rate * end * crack.properties.density),
            1e-11 * crack.held());
}

}  // namespace
}  // namespace crackle
