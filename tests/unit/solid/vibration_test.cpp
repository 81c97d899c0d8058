// SPDX-License-Identifier: GPL-3.0-or-later
//
// Energy of a body that vibrates freely: kept without damping, all accounted for with it.
#include <gtest/gtest.h>

#include <string_view>

#include "../../granite.hpp"
#include "../../result.hpp"

namespace crackle {
namespace {

using granite::at;

struct Vibration {
  double worst = 0.0;       // largest change of the total energy over it
  double drift = 0.0;       // of its mean, from the first to the last tenth
  double viscous = 0.0;     // share of it that became heat
  double least_step = 0.0;  // smallest increment of viscous energy over the total
};

Vibration vibrate(const char* law, double damping_ratio, int steps) {
  Scene scene = granite::scene(granite::free_body(
      jittered(structured_rectangle({-0.05, -0.05}, {0.05, 0.05}, 8, 8, MeshPattern::cross), 0.2, 9)));
  scene.damping.ratio = damping_ratio;
  if (law != nullptr) {
    scene.law = find_law(law);
    scene.cohesive = granite::cohesive();
  }
  Simulation simulation(scene);
  State& state = simulation.state();
  for (Index n = 0; n < state.node_count(); ++n) {  // breathing, stretching and spinning
    const Vec2 x = state.node_reference(n);
    state.velocity[at(n)] = {0.5 * x.x + 0.2 * x.y, -0.3 * x.y + 0.1 * x.x};
  }
  const double dt = 0.7 * simulation.stable().limit;
  Vibration v;
  double first = 0.0, before = 0.0;
  for (int i = 0; i < steps; ++i) {
    const Energies e = simulation.step_and_account(dt);
    const double total = e.kinetic + e.strain + e.cohesive + e.viscous;
    if (i == 0) first = total;
    v.worst = std::max(v.worst, std::abs(total / first - 1.0));
    v.least_step = std::min(v.least_step, (e.viscous - before) / first);
    before = e.viscous;
    if (10 * i < steps) v.drift -= 10.0 * total / (first * steps);
    if (10 * i >= 9 * steps) v.drift += 10.0 * total / (first * steps);
    v.viscous = e.viscous / first;
  }
  EXPECT_EQ(state.dissipation.fracture, 0.0);
  return v;
}

TEST(Vibration, UndampedKeepsItsEnergy) {
  const Check check("A  undamped vibration, 100 000 steps: energy");
  double worst = 0.0;
  for (const char* law :
       {static_cast<const char*>(nullptr), "linear", "evans_marathe", "benzeggagh_kenane"}) {
    // Laws differ in nothing but the shape of what no element here comes to: one of them goes all the way.
    const int steps = law == nullptr || law == std::string_view("benzeggagh_kenane") ? 100000 : 20000;
    const Vibration v = vibrate(law, 0.0, steps);
    std::printf("undamped, %s: energy within %.1e over %d steps, drift %.1e\n", law == nullptr ? "tied" : law,
                v.worst, steps, v.drift);
    worst = std::max(worst, v.worst);
    EXPECT_LT(v.worst, 3e-6);
    EXPECT_LT(std::abs(v.drift), 1e-6);
    EXPECT_EQ(v.viscous, 0.0);
  }
  check.result(worst);
}

TEST(Vibration, DampedClosesItsBalance) {
  for (const char* law : {static_cast<const char*>(nullptr), "linear"}) {
    const Vibration v = vibrate(law, 0.1, 4000);
    std::printf("damped, %s: energy within %.1e while %.1f %% became heat, smallest increment %.0e\n",
                law == nullptr ? "tied" : law, v.worst, 100 * v.viscous, v.least_step);
    EXPECT_LT(v.worst, 1e-6);
    EXPECT_GT(v.viscous, 0.3);
    EXPECT_GE(v.least_step, 0.0);
  }
}

}  // namespace
}  // namespace crackle
