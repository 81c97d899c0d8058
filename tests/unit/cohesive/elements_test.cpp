// SPDX-License-Identifier: GPL-3.0-or-later
//
// Cohesive elements between triangles: energy to pull one edge apart, balance of a split mesh,
// exchange of the faces.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "crackle/cohesive/cohesive.hpp"
#include "crackle/mesh/mesh.hpp"
#include "crackle/solid/bulk.hpp"

namespace crackle {
namespace {

std::shared_ptr<const Mesh> one_edge(double h) {
  Mesh mesh;
  mesh.vertices = {{0, 0}, {h, 0}, {0.5 * h, 0.9 * h}, {0.5 * h, -0.9 * h}};
  mesh.triangles = {{0, 1, 2}, {1, 0, 3}};
  mesh.regions = {Region::rock, Region::rock};
  build_edges(mesh);
  return std::make_shared<const Mesh>(mesh);
}

CohesiveMaterial granite() {
  const double tan_phi = std::tan(38.0 * std::numbers::pi / 180.0);
  return {3e6, 24e6, tan_phi, tan_phi, 5.0, 80.0, 120e9, 120e9, Calibration::exact};
}

// Moves the upper triangle (0) away from the lower one along a unit vector and returns the work done
// on it per length of the edge [J/m2], and the peak force per length [Pa].
struct Pull {
  double work = 0.0, peak = 0.0, booked = 0.0;
  bool broken = false;
};
Pull pull(const std::string& law, Vec2 along, double reach, double turn) {
  const double h = 3e-3;
  State state = make_split_state(one_edge(h));
  insert_all(state);
  Cohesive cohesive(find_law(law), granite());
  const double c = std::cos(turn), s = std::sin(turn);
  const auto rotate = [&](Vec2 v) { return Vec2{c * v.x - s * v.y, s * v.x + c * v.y}; };
  Pull result;
  const auto force = [&] {  // on the upper triangle
    const EndForces& f = state.cohesive.force[0];
    const bool upper_is_a =
        state.mesh->edges[static_cast<std::size_t>(state.cohesive.edge[0])].triangle[0] == 0;
    return (upper_is_a ? 1.0 : -1.0) * (f.end0 + f.end1);
  };
  const int n = 100000;
  Vec2 before;
  for (int i = 0; i <= n; ++i) {
    const Vec2 d = rotate((reach * i / n) * along);
    for (Index corner = 0; corner < 6; ++corner) {
      const Vec2 x = state.reference(corner);
      state.displacement[static_cast<std::size_t>(corner)] = rotate(x) - x + (corner < 3 ? d : Vec2{});
    }
    cohesive.add_tractions(state);
    const Vec2 f = force();
    const Vec2 step = (1.0 * reach / n) * rotate(along);
    if (i > 0) result.work -= 0.5 * dot(f + before, step) / h;
    result.peak = std::max(result.peak, norm(f) / h);
    before = f;
  }
  result.booked = state.dissipation.fracture / h;
  result.broken = state.cohesive.status[0] == CohesiveStatus::broken;
  return result;
}

TEST(CohesiveElement, PulledApartInModeOneGivesItsFractureEnergy) {
  for (const char* law : {"evans_marathe", "linear", "benzeggagh_kenane"}) {
    for (const double turn : {0.0, 1.1}) {
      const Pull p = pull(law, {0, 1}, 2e-5, turn);
      std::printf("%s, turned %.1f rad: work %.5f, booked %.5f of 5 J/m2, peak %.4f of 3 MPa\n", law, turn,
                  p.work, p.booked, p.peak / 1e6);
      EXPECT_TRUE(p.broken);
      EXPECT_NEAR(p.work, 5.0, 5e-3);
      EXPECT_NEAR(p.booked, 5.0, 5e-3);
      EXPECT_NEAR(p.peak, 3e6, 3e3);
    }
  }
}

TEST(CohesiveElement, SlidInModeTwoGivesItsFractureEnergy) {
  for (const char* law : {"evans_marathe", "linear", "benzeggagh_kenane"}) {
    const Pull p = pull(law, {1, 0}, 6e-5, 0.0);
    std::printf("%s: work %.5f, booked %.5f of 80 J/m2, peak %.4f of 24 MPa\n", law, p.work, p.booked,
                p.peak / 1e6);
    EXPECT_TRUE(p.broken);
    EXPECT_NEAR(p.work, 80.0, 8e-2);
    EXPECT_NEAR(p.booked, 80.0, 8e-2);
    EXPECT_NEAR(p.peak, 24e6, 24e3);
  }
}

// An edge of granite of a length [m] under 20 MPa of shear, its element just inserted; both triangles are
// held, so that the element bears what the stress asks.
struct Loaded {
  Loaded(const char* law, double h)
      : mesh(one_edge(h)), state(make_tied_state(mesh)), cohesive(find_law(law), granite()) {
    set_mass(state, 2500);
    const Bulk bulk(*mesh, isotropic_plane_strain(35e9, 0.27), 2500, Sym2{0, 0, 20e6}, {});
    const auto rock = [&](Index corner) {
      return bulk.triangle_forces(state, corner / 3)[static_cast<std::size_t>(corner % 3)];
    };
    Index edge = 0;
    while (mesh->edges[static_cast<std::size_t>(edge)].triangle[1] < 0) ++edge;
    upper_is_a = mesh->edges[static_cast<std::size_t>(edge)].triangle[0] == 0;
    for (double& m : state.inverse_mass) m = 0.0;
    cohesive.insert(state, {{edge}}, {{120e9}}, {{0}}, rock, [](Index) { return Vec2{}; });
    cohesive.add_tractions(state);
  }
  // On the upper triangle [N/m].
  Vec2 force() const {
    const EndForces& f = state.cohesive.force[0];
    return (upper_is_a ? 1.0 : -1.0) * (f.end0 + f.end1);
  }

  std::shared_ptr<const Mesh> mesh;
  State state;
  Cohesive cohesive;
  bool upper_is_a = false;
};

// An edge under 20 MPa of shear gets a spring that holds 5 J/m2. It unloads, which the rock gains, and is
// pulled apart: that is paid back, the fracture energy dissipated, and nothing made on the way.
TEST(CohesiveElement, WhatInsertionGaveIsPaidBackByBreaking) {
  const double h = 3e-3;
  for (const char* law : {"linear", "benzeggagh_kenane"}) {
    Loaded edge(law, h);
    State& state = edge.state;
    Cohesive& cohesive = edge.cohesive;
    Vec2 before = edge.force();
    const double given = state.cohesive.histories[0].point[2].inserted;
    const double back = before.x / 120e9;  // [m]
    double work = 0.0, booked = 0.0, worst = 0.0;
    const int n = 20000;
    Vec2 moved;
    for (int i = 1; i <= 2 * n; ++i) {
      const Vec2 d{back * std::min(i, n) / n, 2e-5 * std::max(i - n, 0) / n};
      for (const Index corner : {0, 1, 2})
        state.displacement[static_cast<std::size_t>(state.node_of_corner[static_cast<std::size_t>(corner)])] =
            d;
      cohesive.add_tractions(state);
      work -= 0.5 * dot(edge.force() + before, d - moved) / h;
      moved = d;
      before = edge.force();
      EXPECT_GE(state.dissipation.fracture, booked * h);
      booked = state.dissipation.fracture / h;
      worst = std::max(worst, std::abs(cohesive.stored_energy(state) / h + booked - work));
    }
    std::printf("%s: given %.2f J/m2, booked %.4f of 5 J/m2, ledger within %.1e J/m2\n", law, given, booked,
                worst);
    EXPECT_EQ(state.cohesive.status[0], CohesiveStatus::broken);
    EXPECT_GT(given, 4.0);
    EXPECT_NEAR(booked, 5.0, 5e-3);
    EXPECT_LT(worst, 5e-3);
  }
}

// Work that moves the nodes of the only element by hand have done since it was last asked [J/m].
class HandWork {
 public:
  double until_now(const State& state) {
    const auto& n = state.cohesive.nodes[0];
    const EndForces& f = state.cohesive.force[0];
    std::array<Vec2, 4> x;
    for (std::size_t k = 0; k < 4; ++k) x[k] = state.displacement[static_cast<std::size_t>(n[k])];
    if (known_) {
      sum_ -= 0.5 * dot(f.end0 + force_.end0, (x[0] - x[2]) - (place_[0] - place_[2]));
      sum_ -= 0.5 * dot(f.end1 + force_.end1, (x[1] - x[3]) - (place_[1] - place_[3]));
    }
    known_ = true;
    force_ = f;
    place_ = x;
    return sum_;
  }

 private:
  EndForces force_;
  std::array<Vec2, 4> place_;
  double sum_ = 0.0;
  bool known_ = false;
};

// The same, but the edge opens as a hinge: two points fail, and the third breaks with its debt. That has its
// own entry, with which the ledger closes.
TEST(CohesiveElement, WhatAHingeDoesNotPayBackIsCounted) {
  const double h = 3e-3;
  for (const char* law : {"linear", "benzeggagh_kenane"}) {
    Loaded edge(law, h);
    State& state = edge.state;
    Cohesive& cohesive = edge.cohesive;
    HandWork work;
    work.until_now(state);
    const double given = state.cohesive.histories[0].point[2].inserted;
    const double back = edge.force().x / 120e9;
    double worst = 0.0, made = 0.0;
    const int n = 20000;
    for (int i = 1; i <= 2 * n; ++i) {
      const double turn = 2e-5 / h * std::max(i - n, 0) / n;
      for (const Index corner : {0, 1, 2}) {
        const Vec2 x = state.reference(corner);
        state.displacement[static_cast<std::size_t>(state.node_of_corner[static_cast<std::size_t>(corner)])] =
            {back * std::min(i, n) / n + turn * x.y, turn * (h - x.x)};
      }
      cohesive.add_tractions(state);
      made = state.dissipation.inserted / h;
      worst = std::max(worst, std::abs(cohesive.stored_energy(state) / h + state.dissipation.fracture / h -
                                       made - work.until_now(state) / h));
    }
    std::printf("%s: given %.3f J/m2, not paid back %.4f of a sixth of it, ledger within %.1e J/m2\n", law,
                given, 6.0 * made / given, worst);
    EXPECT_EQ(state.cohesive.status[0], CohesiveStatus::broken);
    EXPECT_NEAR(6.0 * made / given, 1.0, 0.05);
    EXPECT_LT(worst, 5e-3);
  }
}

// Slid under little compression, slid back under much: the parabola of Y bears more on the way back, and the
// rock has to work. dE = t^3 (1/f_0 - 1/f_1)/(12 k) of a cycle is what law.hpp says; a straight branch takes
// nothing.
TEST(CohesiveElement, CurvedElasticBranchGivesWhatIsBooked) {
  const double h = 3e-3, k = 120e9 / h, pressed = 8e6;
  for (const char* law : {"evans_marathe", "linear"}) {
    State state = make_split_state(one_edge(h));
    insert_all(state);
    Cohesive cohesive(find_law(law), granite());
    const double slide = (cohesive.law().curvature() > 0.0 ? 1.95 : 0.97) * 24e6 / k;
    const auto go = [&](Vec2 from, Vec2 to, HandWork& work) {
      double sum = 0.0;
      for (int i = 0; i <= 1000; ++i) {
        for (const std::size_t corner : {0U, 1U, 2U})
          state.displacement[corner] = from + (i / 1000.0) * (to - from);
        cohesive.add_tractions(state);
        sum = work.until_now(state);
      }
      return sum;
    };
    const Vec2 rest{}, slid{slide, 0.0}, both{slide, -pressed / k}, closed{0.0, -pressed / k};
    HandWork work;
    go(rest, slid, work);  // near its strength: it gets its history
    const double before = work.until_now(state), booked_before = state.dissipation.path;
    go(slid, both, work);
    go(both, closed, work);
    go(closed, rest, work);
    const double done = (go(rest, slid, work) - before) / h;
    const double booked = (state.dissipation.path - booked_before) / h;
    const double t = k * slide, tan_phi = std::tan(38.0 * std::numbers::pi / 180.0);
    const double theory =
        cohesive.law().curvature() * t * t * t / (12.0 * k) * (1.0 / 24e6 - 1.0 / (24e6 + pressed * tan_phi));
    std::printf("%s: work of a cycle %.5f, booked as given %.5f, theory %.5f J/m2\n", law, done, booked,
                theory);
    EXPECT_EQ(state.cohesive.histories[0].point[2].damage, 0.0);
    EXPECT_NEAR(booked, -done, 1e-6 * theory + 1e-12);  // of the steps
    EXPECT_NEAR(std::abs(booked), theory, 1e-4 * theory + 1e-12);
  }
}

TEST(CohesiveElement, RepelsOverlap) {
  const Pull p = pull("evans_marathe", {0, -1}, 1e-6, 0.0);
  EXPECT_GT(p.work, 0.0);
  EXPECT_EQ(p.booked, 0.0);
}

TEST(CohesiveElement, BalanceHoldsASplitMeshUnderAnyStress) {
  auto mesh = std::make_shared<const Mesh>(
      jittered(structured_rectangle({0, 0}, {1, 1}, 12, 12, MeshPattern::cross), 0.2, 7));
  const Sym2 stress{-7.05e6, -4.9e6, 1.3e6};
  for (const char* law : {"evans_marathe", "linear", "benzeggagh_kenane"}) {
    State state = make_split_state(mesh);
    set_mass(state, 2500);
    insert_all(state);
    Bulk bulk(*mesh, isotropic_plane_strain(35e9, 0.27), 2500, stress, {});
    std::vector<Vec2> forces(3 * mesh->triangles.size());
    bulk.corner_forces(state, 0, mesh->triangle_count(), forces.data());
    // the boundary bears its traction
    for (const Edge& edge : mesh->edges) {
      if (edge.kind != EdgeKind::outer) continue;
      const auto i = static_cast<std::size_t>(3 * edge.triangle[0] + edge.side[0]);
      const auto j = static_cast<std::size_t>(3 * edge.triangle[0] + (edge.side[0] + 1) % 3);
      const Vec2 t = 0.5 * (stress * right_normal(state.reference(static_cast<Index>(j)) -
                                                  state.reference(static_cast<Index>(i))));
      forces[i] += t;
      forces[j] += t;
    }
    Cohesive cohesive(find_law(law), granite());
    EXPECT_TRUE(cohesive.balance(state, forces).empty());
    cohesive.add_tractions(state);
    double worst = 0.0, traction_error = 0.0;
    for (Index e = 0; e < state.cohesive.count(); ++e) {
      const Edge& edge =
          mesh->edges[static_cast<std::size_t>(state.cohesive.edge[static_cast<std::size_t>(e)])];
      const EndForces& f = state.cohesive.force[static_cast<std::size_t>(e)];
      for (int end = 0; end < 2; ++end) {
        const Vec2 g = end == 0 ? f.end0 : f.end1;
        forces[static_cast<std::size_t>(3 * edge.triangle[0] + (edge.side[0] + end) % 3)] += g;
        forces[static_cast<std::size_t>(3 * edge.triangle[1] + (edge.side[1] + 1 - end) % 3)] -= g;
      }
      // uniform stress: the traction on every edge is σ·n (patch test)
      const Vec2 d = state.cohesive.direction[static_cast<std::size_t>(e)];
      const Vec2 t = 0.5 * (stress * right_normal(d));
      traction_error = std::max({traction_error, norm(f.end0 - t) / norm(t), norm(f.end1 - t) / norm(t)});
    }
    for (const Vec2 f : forces) worst = std::max(worst, norm(f));
    std::printf("%s: unbalanced %.1e N/m of about 1e6, traction error %.1e\n", law, worst, traction_error);
    EXPECT_LT(worst, 1e-8);
    EXPECT_LT(traction_error, 1e-10);
  }
}

}  // namespace
}  // namespace crackle
