// SPDX-License-Identifier: GPL-3.0-or-later
//
// Wetted loops of a wellbore with fractures, and the force of the fluid: p ∂V/∂x, outward.
#include <gtest/gtest.h>

#include <random>

#include "fractures.hpp"

namespace crackle {
namespace {

using granite::at;

struct Fractured {
  std::shared_ptr<const Mesh> mesh =
      granite::make({.segments = 24, .width = 0.6, .fine_radius = 0.1, .size_coarse = 0.05});
  State state = make_split_state(mesh);
  Cohesive cohesive{find_law("linear"), granite::cohesive()};
  Fluid fluid;
  std::size_t broken = 0;

  Fractured()
      : fluid((insert_all(state), set_mass(state, granite::density), state), {2.2e9, 1000.0, 0.0}, Pump{}) {
    fluid.fill(state, granite::edges_of_kind(*mesh, EdgeKind::wellbore), 5e6);
    for (const double angle : {0.1, 2.0, 4.4}) {
      const auto path =
          cut_ray(state, cohesive,
                  {granite::wellbore_radius * std::cos(angle), granite::wellbore_radius * std::sin(angle)},
                  {std::cos(angle), std::sin(angle)}, 5);
      fluid.connect(state, path);
      broken += path.size();
    }
  }
};

TEST(Loops, CloseAndCountBothLips) {
  Fractured f;
  const std::size_t bore = granite::edges_of_kind(*f.mesh, EdgeKind::wellbore).size();
  std::size_t sides = 0;
  for (const Fluid::Loop& loop : f.fluid.loops()) {
    sides += loop.corners.size() / 2;
    for (std::size_t k = 0; k < loop.corners.size(); k += 2) {
      const Index start = loop.corners[k], end = loop.corners[k + 1];
      EXPECT_EQ(end, 3 * (start / 3) + (start % 3 + 1) % 3) << "a side of one triangle";
      const Index next = loop.corners[k + 2 < loop.corners.size() ? k + 2 : 0];
      EXPECT_EQ(f.mesh->triangles[at(end / 3)][at(end % 3)], f.mesh->triangles[at(next / 3)][at(next % 3)])
          << "the next side begins at the same vertex";
    }
  }
  f.fluid.refill(f.state, 5e6);
  const double area = granite::hole_area(*f.mesh);
  const double error = std::abs(f.state.fluid.cavities[0].volume / area - 1.0);
  std::printf("loops: %zu, sides %zu = %zu of the bore + 2 x %zu broken; volume of closed fractures %.0e\n",
              f.fluid.loops().size(), sides, bore, f.broken, error);
  EXPECT_EQ(sides, bore + 2 * f.broken);
  EXPECT_EQ(f.fluid.loops().size(), 1u);
  EXPECT_FALSE(f.fluid.leaks());
  EXPECT_LT(error, 1e-12);
}

TEST(Force, IsPressureTimesGradientOfVolume) {
  Fractured f;
  std::mt19937 random(5);
  std::uniform_real_distribution<double> shake(-2e-4, 2e-4);
  for (Vec2& u : f.state.displacement) u = {shake(random), shake(random)};
  const double p = 5e6, step = 1e-5;
  f.fluid.refill(f.state, p);
  std::vector<Vec2> corner(3 * f.mesh->triangles.size());
  f.fluid.add_corner_forces(f.state, corner);
  const auto volume = [&] {
    f.fluid.refill(f.state, p);
    return f.state.fluid.cavities[0].volume;
  };
  double worst = 0.0, largest = 0.0;
  Vec2 sum;
  for (Index n = 0; n < f.state.node_count(); ++n) {
    Vec2 force;
    for (Index k = 0; k < f.state.node_size[at(n)]; ++k)
      force += corner[at(f.state.node_corners[at(f.state.node_first[at(n)] + k)])];
    sum += force;
    if (force == Vec2{}) continue;
    const Vec2 u = f.state.displacement[at(n)];
    const auto slope = [&](Vec2 along) {
      f.state.displacement[at(n)] = u + step * along;
      const double more = volume();
      f.state.displacement[at(n)] = u - step * along;
      const double less = volume();
      f.state.displacement[at(n)] = u;
      return p * (more - less) / (2 * step);
    };
    const Vec2 expected{slope({1, 0}), slope({0, 1})};
    largest = std::max(largest, norm(expected));
    worst = std::max(worst, norm(force - expected));
  }
  std::printf("force against p dV/dx: error %.1e, sum of all %.1e of the largest\n", worst / largest,
              norm(sum) / largest);
  EXPECT_LT(worst, 1e-8 * largest);
  EXPECT_LT(norm(sum), 1e-10 * largest);
}

// Signed: what advance() does to nodes at rest is Δt p ∂V/∂x / m, and the volume grows.
TEST(Force, PushesTheWallsApart) {
  for (const double p : {5e6, -5e6}) {
    Fractured f;
    f.fluid.refill(f.state, p);
    std::vector<Vec2> corner(3 * f.mesh->triangles.size());
    f.fluid.add_corner_forces(f.state, corner);
    const double before = f.state.fluid.cavities[0].volume, dt = 1e-9;
    f.fluid.advance(f.state, dt);
    double worst = 0.0, largest = 0.0, outward = 0.0;  // the bore's wall
    for (std::size_t c = 0; c < corner.size(); ++c) {
      const std::size_t n = at(f.state.node_of_corner[c]);
      const Vec2 kick = (dt * f.state.inverse_mass[n]) * corner[c];
      worst = std::max(worst, norm(f.state.velocity[n] - kick));
      largest = std::max(largest, norm(kick));
      const Vec2 x = f.state.node_reference(static_cast<Index>(n));
      if (norm(x) < 1.0001 * granite::wellbore_radius) outward += dot(x, f.state.velocity[n]);
    }
    f.fluid.refill(f.state, p);
    std::printf("pressure %+.0f MPa: volume grows by %+.1e m2 in a step, kicks within %.0e\n", p / 1e6,
                f.state.fluid.cavities[0].volume - before, worst / largest);
    EXPECT_GT((f.state.fluid.cavities[0].volume - before) * p, 0.0);
    EXPECT_GT(outward * p, 0.0);
    EXPECT_LT(worst, 1e-5 * largest);
  }
}

}  // namespace
}  // namespace crackle
