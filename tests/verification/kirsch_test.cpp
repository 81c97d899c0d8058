// SPDX-License-Identifier: GPL-3.0-or-later
//
// Excavation and pressure against Kirsch's solution on three meshes (validation.md A2): the paper's
// wellbore in 8 x 8 m, outer boundary fixed. That box is off an infinite plane by (R/b)² = 1.6e-4.
#include "kirsch.hpp"

#include <gtest/gtest.h>

#include "../granite.hpp"
#include "../result.hpp"

namespace crackle {
namespace {

using granite::at;

// validation.md's table for −7.05 and −4.9 MPa and 11.47 MPa inside.
TEST(Kirsch, FormulasGiveTheTable) {
  const Kirsch k{0.05, granite::stiffness().c66, 0.27, granite::anisotropic, 11.47e6};
  const double s = std::sqrt(0.5);
  EXPECT_NEAR(k.displacement({0.05, 0}).x, 6.22481e-6, 1e-11);
  EXPECT_NEAR(k.displacement({0, 0.05}).y, 13.7142e-6, 1e-10);
  const Vec2 x{0.1 * s, 0.1 * s};
  EXPECT_NEAR(dot(k.displacement(x), x) / 0.1, 4.98475e-6, 1e-11);
  EXPECT_NEAR(cross(x, k.displacement(x)) / 0.1, 1.14096e-6, 1e-11);
  EXPECT_NEAR(k.polar_stress({0.05, 0}).yy, 3.82e6, 1.0);
  EXPECT_NEAR(k.polar_stress(x).xx, -7.34875e6, 10.0);
  EXPECT_NEAR(k.polar_stress(x).yy, -4.60125e6, 10.0);
  EXPECT_NEAR(k.polar_stress(x).xy, 1.41094e6, 10.0);
}

// A constant-strain triangle at the wall has the hoop strain of the wall itself, not of its centroid:
// stresses at centroids are off by the order of h, their means over pairs of triangles, at the edge
// between them, by less.
struct Errors {
  double displacement = 0.0;  // RMS over the wall, relative to the RMS there
  double radial = 0.0;        // largest of u_r at the wall over the largest u_r
  double stress = 0.0;        // RMS over centroids within 2 R, relative to the RMS there
  double pairs = 0.0;         // the same of the mean over two triangles, at the middle of their edge
  double hoop = 0.0;          // RMS of σ_θθ in triangles with a side on the wall, over 2 |S|
  double imbalance = 0.0;
};

Errors errors(const std::shared_ptr<const Mesh>& mesh, Sym2 far, double pressure) {
  Scene scene = granite::scene(mesh);
  scene.stress = far;
  scene.fluid = CompressibleFluid{1.45e9, 1000.0, 0.0};
  scene.initial_pressure = pressure;
  Simulation simulation(scene);
  const State& state = simulation.state();
  const Kirsch exact{granite::wellbore_radius, scene.stiffness.c66, granite::poisson_ratio, far, pressure};
  Errors e;
  e.imbalance = simulation.imbalance();
  double miss = 0.0, all = 0.0, radial = 0.0;
  std::vector<char> at_wall(mesh->triangles.size(), 0);
  for (const Index edge : granite::edges_of_kind(*mesh, EdgeKind::wellbore)) {
    at_wall[at(mesh->edges[at(edge)].triangle[0])] = 1;
    const Index v = mesh->edges[at(edge)].vertex[0];
    const Vec2 x = mesh->vertices[at(v)], want = exact.displacement(x),
               off = state.displacement[at(v)] - want;
    miss += dot(off, off);
    all += dot(want, want);
    e.radial = std::max(e.radial, std::abs(dot(off, x)) / norm(x));
    radial = std::max(radial, std::abs(dot(want, x)) / norm(x));
  }
  e.displacement = std::sqrt(miss / all);
  e.radial /= radial;
  const auto square = [](Sym2 q) { return q.xx * q.xx + q.yy * q.yy + 2 * q.xy * q.xy; };
  const auto stress = [&](Index t) { return simulation.bulk().stress(state, t); };
  double stress_miss = 0.0, stress_all = 0.0, hoop_miss = 0.0;
  int hoops = 0;
  for (Index t = 0; t < mesh->triangle_count(); ++t) {
    const Vec2 x = granite::centroid(*mesh, t);
    if (norm(x) > 2.0 * granite::wellbore_radius) continue;
    stress_miss += square(granite::difference(stress(t), exact.stress(x)));
    stress_all += square(exact.stress(x));
    if (!at_wall[at(t)]) continue;
    const Vec2 tangent = (1.0 / norm(x)) * Vec2{-x.y, x.x};
    const double wall = exact.polar_stress((granite::wellbore_radius / norm(x)) * x).yy;
    hoop_miss += std::pow(dot(tangent, stress(t) * tangent) - wall, 2);
    ++hoops;
  }
  e.stress = std::sqrt(stress_miss / stress_all);
  e.hoop = std::sqrt(hoop_miss / hoops) / (2.0 * std::abs(exact.mean()));
  double pair_miss = 0.0, pair_all = 0.0;
  for (const Index i : granite::edges_of_kind(*mesh, EdgeKind::interior)) {
    const Edge& edge = mesh->edges[at(i)];
    const Vec2 x = 0.5 * (mesh->vertices[at(edge.vertex[0])] + mesh->vertices[at(edge.vertex[1])]);
    if (norm(x) > 2.0 * granite::wellbore_radius) continue;
    const Sym2 mean = 0.5 * (stress(edge.triangle[0]) + stress(edge.triangle[1]));
    pair_miss += square(granite::difference(mean, exact.stress(x)));
    pair_all += square(exact.stress(x));
  }
  e.pairs = std::sqrt(pair_miss / pair_all);
  return e;
}

TEST(Kirsch, ExcavationWithAndWithoutPressure) {
  std::vector<std::shared_ptr<const Mesh>> meshes;
  for (const int segments : {26, 52, 105}) {
    const double h = 2.0 * std::numbers::pi * granite::wellbore_radius / segments;
    meshes.push_back(
        granite::make({.segments = segments, .width = 8.0, .fine_radius = 0.12, .size_coarse = 100.0 * h}));
  }
  for (const double pressure : {0.0, 11.47e6}) {
    const char* name = pressure > 0.0 ? "A2 Kirsch, excavated and pressurised" : "A2 Kirsch, excavated";
    const Check displacement(std::string(name) + ": displacement of the wall"),
        stress(std::string(name) + ": stress");
    std::vector<Errors> all;
    for (const auto& mesh : meshes) {
      const Errors e = errors(mesh, granite::anisotropic, pressure);
      std::printf(
          "p %5.2f MPa, %6d triangles: wall displacement %.3f %%, u_r %.3f %%, stress within 2 R %.2f %%, of "
          "pairs %.2f %%, "
          "wall hoop %.2f %%, imbalance %.0e\n",
          pressure / 1e6, mesh->triangle_count(), 100 * e.displacement, 100 * e.radial, 100 * e.stress,
          100 * e.pairs, 100 * e.hoop, e.imbalance);
      EXPECT_LT(e.imbalance, 1e-10);
      all.push_back(e);
    }
    const double halvings = std::log2(105.0 / 26.0);
    const double order_u = std::log2(all[0].displacement / all[2].displacement) / halvings;
    const double order_s = std::log2(all[0].stress / all[2].stress) / halvings;
    const double order_p = std::log2(all[0].pairs / all[2].pairs) / halvings;
    std::printf("p %5.2f MPa: order %.2f of displacement, %.2f of stress, %.2f of pairs\n", pressure / 1e6,
                order_u, order_s, order_p);
    displacement.result(all[2].displacement, order_u);
    stress.result(all[2].stress, order_s);
    EXPECT_GT(order_u, 1.6);
    EXPECT_GT(order_s, 0.85);
    EXPECT_GT(order_p, 0.85);
    EXPECT_LT(all[2].radial, 0.01);
    EXPECT_LT(all[2].stress, 0.025);
    EXPECT_LT(all[2].pairs, 0.01);
    EXPECT_LT(all[2].hoop, 0.05);
  }
}

}  // namespace
}  // namespace crackle
