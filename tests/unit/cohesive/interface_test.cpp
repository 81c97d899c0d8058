// SPDX-License-Identifier: GPL-3.0-or-later
#include "crackle/cohesive/interface.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

namespace crackle {
namespace {

TEST(Interface, DissipatesTheFractureEnergyAndNoMore) {
  for (const char* name : {"linear", "evans_marathe"}) {
    const InterfaceLaw law(find_law(name), 2e6, 100.0, {1e-4, 30e6});
    double work = 0.0;
    const int steps = 20000;
    const double end = law.broken_opening();
    for (int i = 0; i < steps; ++i) {
      const double a = end * i / steps, b = end * (i + 1) / steps;
      work += 0.5 * (b - a) * (law.traction(a, a, 0.0).traction + law.traction(b, b, 0.0).traction);
    }
    std::printf("%s: work to break %.5f of G, dissipated() %.5f\n", name, work / 100.0,
                law.dissipated(end) / 100.0);
    EXPECT_NEAR(work / 100.0, 1.0, 1e-3);
    EXPECT_NEAR(law.dissipated(end) / 100.0, 1.0, 1e-4);
    // Closing and opening again costs nothing, from half way and from a broken state.
    for (const double most : {0.3 * end, 2.0 * end}) {
      double there = 0.0, back = 0.0;
      for (int i = 0; i < steps; ++i) {
        const double a = most * (1.0 - 0.9 * i / steps), b = most * (1.0 - 0.9 * (i + 1) / steps);
        there += 0.5 * (b - a) * (law.traction(a, most, 0.0).traction + law.traction(b, most, 0.0).traction);
        back -= 0.5 * (b - a) * (law.traction(a, most, 0.0).traction + law.traction(b, most, 0.0).traction);
      }
      EXPECT_NEAR(there + back, 0.0, 1e-12);
    }
  }
}

TEST(Interface, ClosedFacesFollowTheHyperbola) {
  const Closure closure{1e-4, 30e6};
  for (const double compression : {0.0, 1e6, 9.44e6, 30e6}) {
    const double w = closure.opening(compression);
    EXPECT_NEAR(closure.traction(w, 1e-3).traction, -compression, 1e-6 * 30e6);
    const double step = 1e-10;
    if (compression == 0.0) continue;
    const double slope =
        (closure.traction(w + step, 1e-3).traction - closure.traction(w - step, 1e-3).traction) /
        (2.0 * step);
    EXPECT_NEAR(closure.traction(w, 1e-3).slope / slope, 1.0, 1e-6);
  }
  EXPECT_NEAR(closure.opening(30e6), 1e-5, 1e-12);
  // A crack that never opened by w0 is not pushed open by asperities.
  EXPECT_EQ(closure.traction(2e-5, 2e-5).traction, 0.0);
  // Intact: the bond bears the in-situ stress at no opening.
  const InterfaceLaw law(find_law("linear"), 2e6, 100.0, closure);
  EXPECT_EQ(law.traction(0.0, 0.0, -9e6).traction, -9e6);
  EXPECT_NEAR(law.traction(law.elastic_opening(), 0.0, -9e6).traction, 2e6, 1e-3);
}

// Opened while it is sheared, slid closed there and back, half open and shut again: the work of the tractions
// is what is kept and what is dissipated.
TEST(Interface, WorkOfOpeningAndSlipIsKeptOrDissipated) {
  const InterfaceLaw law(find_law("linear"), 2e6, 100.0, {1e-5, 30e6}, {2.0, 0.6});
  constexpr double in_situ = -5e6, in_situ_shear = 1e6;
  const double wide = law.broken_opening();
  const Vec2 stations[] = {{0.0, 0.0},          {0.5 * wide, 2e-5}, {1e-6, 2e-5}, {1e-6, 8e-5},
                           {2e-6, -3e-5},       {1.2 * wide, 1e-5}, {1e-6, 1e-5}, {-1e-7, 6e-5},
                           {1.5 * wide, -2e-5}, {5e-7, 0.0}};
  double most = 0.0, plastic = 0.0, work = 0.0, friction = 0.0, by_slip = 0.0;
  MixedTraction before = law.traction(0.0, 0.0, most, plastic, in_situ, in_situ_shear);
  double stiffness = law.shear_stiffness(0.0);
  Vec2 was{0.0, 0.0};
  constexpr int steps = 20000;
  for (std::size_t k = 1; k < std::size(stations); ++k) {
    for (int i = 1; i <= steps; ++i) {
      const Vec2 d = stations[k - 1] + (static_cast<double>(i) / steps) * (stations[k] - stations[k - 1]);
      const MixedTraction t = law.traction(d.x, d.y, most, plastic, in_situ, in_situ_shear);
      work +=
          0.5 * (before.normal + t.normal) * (d.x - was.x) + 0.5 * (before.shear + t.shear) * (d.y - was.y);
      friction += 0.5 * (before.friction + t.friction) * (t.plastic_slip - plastic);
      most = std::max(most, d.x);
      const double now = law.shear_stiffness(most);
      by_slip += 0.5 * was.y * d.y * (stiffness - now);
      plastic = t.plastic_slip;
      stiffness = now;
      before = t;
      was = d;
    }
    const double kept = law.stored(was.x, most, in_situ) +
                        law.stored_by_slip(was.x, was.y, most, before.friction, in_situ_shear);
    const double left = work - kept - law.dissipated(most) - by_slip - friction;
    std::printf("station %zu: work %.3f, kept %.3f, fracture %.3f and %.3f, friction %.3f: left %.4f J/m2\n",
                k, work, kept, law.dissipated(most), by_slip, friction, left);
    EXPECT_LT(std::abs(left), 0.2) << "of G = 100 J/m2";
    EXPECT_GE(friction, 0.0);
  }
  EXPECT_GT(friction, 10.0);
  EXPECT_GT(by_slip, 0.1);
}

TEST(Interface, StrengthThatTheMeshResolves) {
  EXPECT_NEAR(resolved_strength(10.75e6, 43.76e9, 100.0, 0.5, 8.0), std::sqrt(43.76e9 * 100.0 / 4.0), 1.0);
  EXPECT_EQ(resolved_strength(1e5, 43.76e9, 100.0, 0.5, 8.0), 1e5);
}

}  // namespace
}  // namespace crackle
