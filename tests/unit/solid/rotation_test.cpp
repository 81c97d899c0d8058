// SPDX-License-Identifier: GPL-3.0-or-later
//
// Rigid rotation through 360 degrees: no stress, no forces, and in-situ stress turns with the body.
#include <gtest/gtest.h>

#include "../../result.hpp"
#include "static_solve.hpp"

namespace crackle {
namespace {

using granite::at;

std::shared_ptr<const Mesh> patch() {
  return std::make_shared<const Mesh>(
      jittered(structured_rectangle({0, 0}, {1, 0.7}, 6, 5, MeshPattern::cross), 0.25, 2));
}

void rotate(State& state, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  for (Index n = 0; n < state.node_count(); ++n) {
    const Vec2 x = state.node_reference(n);
    state.displacement[at(n)] = Vec2{c * x.x - s * x.y, s * x.x + c * x.y} - x;
  }
}

TEST(Rotation, MakesNoStressAndNoForces) {
  const Check check("A1 rigid rotation: stress over E");
  const auto mesh = patch();
  const Bulk bulk(*mesh, granite::stiffness(), granite::density, {}, {});
  State tied = make_tied_state(mesh), split = make_split_state(mesh);
  insert_all(split);
  Cohesive cohesive(find_law("evans_marathe"), granite::cohesive());
  double stress = 0.0, tied_force = 0.0, split_force = 0.0;
  for (int degree = 0; degree <= 360; ++degree) {
    const double angle = degree * std::numbers::pi / 180.0;
    rotate(tied, angle);
    rotate(split, angle);
    for (Index t = 0; t < mesh->triangle_count(); ++t) {
      stress = std::max(stress, granite::larger_part(bulk.stress(tied, t)) / granite::young_modulus);
    }
    for (const Vec2 f : NodalForces{bulk, nullptr, {}}(tied))
      tied_force = std::max(tied_force, norm(f) / granite::young_modulus);
    for (const Vec2 f : NodalForces{bulk, &cohesive, {}}(split))
      split_force = std::max(split_force, norm(f) / granite::young_modulus);
  }
  std::printf("rotation: stress %.1e E, forces %.1e E m tied, %.1e E m with elements\n", stress, tied_force,
              split_force);
  check.result(stress);
  EXPECT_LT(stress, 1e-10);
  EXPECT_LT(tied_force, 1e-12);
  EXPECT_LT(split_force, 1e-12);
  EXPECT_TRUE(split.cohesive.histories.empty());
}

TEST(Rotation, InSituStressTurnsWithTheBody) {
  const auto mesh = patch();
  const Sym2 s{-7e6, -4e6, 1e6};
  const Bulk bulk(*mesh, granite::stiffness(), granite::density, s, {});
  State state = make_tied_state(mesh);
  double worst = 0.0;
  for (const double angle : {0.3, 1.2, 2.9, 5.0}) {
    rotate(state, angle);
    const double c = std::cos(angle), w = std::sin(angle);
    const Sym2 turned{c * c * s.xx + w * w * s.yy - 2 * c * w * s.xy,
                      w * w * s.xx + c * c * s.yy + 2 * c * w * s.xy,
                      c * w * (s.xx - s.yy) + (c * c - w * w) * s.xy};
    for (Index t = 0; t < mesh->triangle_count(); ++t) {
      worst = std::max(worst, granite::larger_part(granite::difference(bulk.stress(state, t), turned)) / 7e6);
    }
  }
  std::printf("in-situ stress turned with the body: error %.1e\n", worst);
  EXPECT_LT(worst, 1e-10);
}

}  // namespace
}  // namespace crackle
