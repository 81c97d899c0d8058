// SPDX-License-Identifier: GPL-3.0-or-later
#include "depth.hpp"

#include <algorithm>
#include <cmath>

namespace crackle {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

struct Foot {
  double fraction, distance2;
  Vec2 from;  // nearest place to the point
};

Foot foot(const PlacedSide& side, Vec2 x) {
  const Vec2 along = side.end - side.start;
  const Vec2 to = x - side.start;
  const double fraction = std::clamp(dot(to, along) / dot(along, along), 0.0, 1.0);
  // Taken from the nearer end, so that the same vertex gives the same bits on either of its sides.
  const Vec2 from = fraction == 1.0 ? x - side.end : to - fraction * along;
  return {fraction, dot(from, from), from};
}

bool behind(const PlacedSide& side, Vec2 x) { return cross(side.end - side.start, x - side.start) > 0.0; }

}  // namespace

bool find_depth(const FreeSides& sides, const std::vector<PlacedSide>& placed, Index self, Index target,
                Vec2 x, Depth& depth) {
  const FreeSide& side = sides[target];
  const PlacedSide& here = placed[at(target)];
  const Foot nearest = foot(here, x);
  if (nearest.distance2 > side.reach * side.reach) return false;
  const bool at_start = nearest.fraction == 0.0, at_end = nearest.fraction == 1.0;
  bool inside = behind(here, x);
  for (const bool end : {false, true}) {
    const bool at_vertex = end ? at_end : at_start;
    const Index other = end ? side.next : side.previous;
    const double angle = end ? side.angle_at_end : sides[other].angle_at_end;
    if (angle > one_surface || other == self) {
      if (at_vertex) return false;
      continue;
    }
    const PlacedSide& there = placed[at(other)];
    const double distance2 = foot(there, x).distance2;
    if (distance2 < nearest.distance2 || (distance2 == nearest.distance2 && other < target)) return false;
    if (!at_vertex) continue;
    const Vec2 e = here.end - here.start, f = there.end - there.start;
    const bool convex = (end ? cross(e, f) : cross(f, e)) > 0.0;
    inside = convex ? inside && behind(there, x) : inside || behind(there, x);
  }
  const double distance = std::sqrt(nearest.distance2);
  depth.fraction = nearest.fraction;
  depth.value = inside ? distance : -distance;
  if ((at_start || at_end) && distance > 0.0) {
    depth.normal = (-1.0 / depth.value) * nearest.from;
  } else {
    const Vec2 e = here.end - here.start;
    depth.normal = (1.0 / norm(e)) * right_normal(e);
  }
  return true;
}

}  // namespace crackle
