// SPDX-License-Identifier: GPL-3.0-or-later
//
// Magnitudes (validation.md G), modes, and events of a state made by hand.
#include "crackle/seismic/listener.hpp"

#include <gtest/gtest.h>

#include "../../granite.hpp"

namespace crackle {
namespace {

TEST(Seismic, MagnitudesOfGutenbergAndRichter) {
  double worst = 0.0;
  for (const auto& [energy, magnitude] :
       {std::pair{15e-3, -4.416}, {240e-3, -3.613}, {30e-3, -4.215}, {0.3, -3.549}}) {
    worst = std::max(worst, std::abs(magnitude_of_energy(energy) - magnitude));
  }
  std::printf("magnitudes: largest error %.1e\n", worst);
  EXPECT_LT(worst, 5e-4);
  EXPECT_NEAR(magnitude_of_energy(1.0), -3.2, 1e-12);
  EXPECT_NEAR(magnitude_of_energy(1e3) - magnitude_of_energy(1.0), 2.0, 1e-12);
}

TEST(Seismic, NoEnergyHasAFiniteMagnitude) {
  EXPECT_NEAR(magnitude_of_energy(0.0), (-12.0 - 4.8) / 1.5, 1e-12);
  EXPECT_EQ(magnitude_of_energy(-1.0), magnitude_of_energy(0.0));
}

TEST(Seismic, ModeByTheShareOfSliding) {
  EXPECT_EQ(failure_mode(0.0), FailureMode::tensile);
  EXPECT_EQ(failure_mode(0.249), FailureMode::tensile);
  EXPECT_EQ(failure_mode(0.251), FailureMode::mixed);
  EXPECT_EQ(failure_mode(0.749), FailureMode::mixed);
  EXPECT_EQ(failure_mode(0.751), FailureMode::shear);
  EXPECT_EQ(failure_mode(1.0), FailureMode::shear);
  EXPECT_EQ(to_string(FailureMode::mixed), "mixed");
}

TEST(Seismic, ListensToTheElementsThatBroke) {
  State state = make_split_state(
      std::make_shared<const Mesh>(structured_rectangle({0, 0}, {2, 1}, 2, 1, MeshPattern::right)));
  insert_all(state);
  state.time = 3e-4;
  for (Vec2& u : state.displacement) u = {0.25, -0.5};
  const Index element = 1;
  CohesiveHistory h;
  h.element = element;
  h.fracture_energy = 0.02;
  h.sliding_work = 0.018;
  h.friction_energy = 0.003;
  h.yield_time = 2e-4;
  h.kinetic_rise = 15e-3;
  h.point[2].opening = 4e-6;
  h.point[2].slip = -7e-6;
  state.cohesive.histories = {CohesiveHistory{}, h};
  state.cohesive.history_of[1] = 1;
  const Index broken[] = {element};
  const auto events = listen(state, broken, {{16e9, 14e9}, 2.0});
  ASSERT_EQ(events.size(), 1u);
  const SeismicEvent& e = events.front();
  const Edge& edge = state.mesh->edges[granite::at(state.cohesive.edge[1])];
  const Vec2 a = state.mesh->vertices[granite::at(edge.vertex[0])],
             b = state.mesh->vertices[granite::at(edge.vertex[1])];
  EXPECT_EQ(e.edge, state.cohesive.edge[1]);
  EXPECT_EQ(e.time, 3e-4);
  EXPECT_LT(norm(e.place - (0.5 * (a + b) + Vec2{0.25, -0.5})), 1e-14);
  EXPECT_EQ(e.mode, FailureMode::shear);
  EXPECT_EQ(e.energy, 15e-3);
  EXPECT_NEAR(e.magnitude, -4.215, 5e-4) << "of 15 mJ/m over 2 m";
  EXPECT_EQ(e.fracture_energy, 0.02);
  EXPECT_EQ(e.friction_energy, 0.003);
  EXPECT_NEAR(e.duration, 1e-4, 1e-18);
  EXPECT_EQ(e.length, norm(b - a));
  EXPECT_EQ(e.opening, 4e-6);
  EXPECT_EQ(e.slip, -7e-6);
  const MomentTensor m = moment_of_jump({16e9, 14e9}, state.cohesive.direction[1], e.length, 4e-6, -7e-6);
  EXPECT_NEAR(e.moment.xx, m.xx, 1e-9 * std::abs(m.xx));
  EXPECT_NEAR(e.moment.xy, m.xy, 1e-9 * std::abs(m.xx));
  EXPECT_NEAR(e.moment_magnitude, moment_magnitude(2.0 * scalar_moment(m)), 1e-9);
  EXPECT_TRUE(listen(state, {}, {}).empty());
}

}  // namespace
}  // namespace crackle
