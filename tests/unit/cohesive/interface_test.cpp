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

TEST(Interface, StrengthThatTheMeshResolves) {
  EXPECT_NEAR(resolved_strength(10.75e6, 43.76e9, 100.0, 0.5, 8.0), std::sqrt(43.76e9 * 100.0 / 4.0), 1.0);
  EXPECT_EQ(resolved_strength(1e5, 43.76e9, 100.0, 0.5, 8.0), 1e5);
}

}  // namespace
}  // namespace crackle
