// SPDX-License-Identifier: GPL-3.0-or-later
#include "release.hpp"

#include <algorithm>
#include <cmath>

namespace crackle {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

constexpr double cos_most_turned = 0.984807753012208;  // 10 degrees
constexpr double most_slip = 0.5, most_opening = 1.0;  // of the length

CohesiveHistory& history(State& state, Index element) {
  return state.cohesive.histories[at(state.cohesive.history_of[at(element)])];
}

}  // namespace

bool has_parted(const State& state, Index element) {
  const CohesiveElements& c = state.cohesive;
  const auto& n = c.nodes[at(element)];
  const Vec2 a0 = state.displacement[at(n[0])], a1 = state.displacement[at(n[1])];
  const Vec2 b0 = state.displacement[at(n[2])], b1 = state.displacement[at(n[3])];
  const Vec2 direction = c.direction[at(element)];
  const Vec2 a = direction + (a1 - a0), b = direction + (b1 - b0);
  const Vec2 gap = 0.5 * ((b0 - a0) + (b1 - a1));
  const Vec2 t = (1.0 / norm(a + b)) * (a + b);
  const double length = norm(direction);
  return std::abs(dot(gap, t)) > most_slip * length || cross(gap, t) > most_opening * length ||
         dot(a, b) < cos_most_turned * norm(a) * norm(b);
}

std::array<BornTraction, 3> born_by_face(const State& state, Index element, bool face_b) {
  const auto& p = state.cohesive.histories[at(state.cohesive.history_of[at(element)])].point;
  std::array<BornTraction, 3> born;
  for (std::size_t q = 0; q < 3; ++q) born[q] = {std::max(0.0, -p[q].normal), p[q].shear + p[q].friction};
  if (face_b) std::swap(born[0], born[1]);  // a side starts where the element's face b ends
  return born;
}

double release(State& state, Index element) {
  CohesiveElements& c = state.cohesive;
  const double length = norm(c.direction[at(element)]);
  auto& p = history(state, element).point;
  const double stored = length / 6.0 * (p[0].stored + p[1].stored + 4.0 * p[2].stored);
  for (CohesivePoint& point : p) point.normal = point.shear = point.friction = point.stored = 0.0;
  c.force[at(element)] = {};
  c.status[at(element)] = CohesiveStatus::released;
  return stored;
}

}  // namespace crackle
