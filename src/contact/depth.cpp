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

Vec2 unit(Vec2 v) { return (1.0 / norm(v)) * v; }

enum class Corner { beside, inside, flat };

// Depth in the rounded corner where side `a` ends and `b` starts. Corner::beside: the point is not
// in it; flat: there is no corner to round.
Corner corner_depth(const PlacedSide& a, const PlacedSide& b, double radius, Vec2 x, Depth& depth) {
  const Vec2 ta = unit(a.end - a.start), tb = unit(b.end - b.start);
  const double turn = cross(ta, tb);
  if (radius == 0.0 || turn <= 0.0) return Corner::flat;
  const Vec2 na = right_normal(ta), nb = right_normal(tb);
  const Vec2 pa = a.end - radius * na, pb = b.start - radius * nb;
  const Vec2 c = pa + (cross(pb - pa, tb) / turn) * ta;
  const Vec2 r = x - c;
  if (dot(r, ta) <= 0.0 || dot(r, tb) >= 0.0) return Corner::beside;
  const double distance = norm(r);
  const Vec2 u = (1.0 / distance) * r;
  depth.value = radius - distance;
  depth.normal = u;
  const double alpha = cross(u, nb) / turn, beta = cross(na, u) / turn;
  depth.bearings = 2;
  depth.bearing[0] = {-1, dot(c - a.start, ta) / norm(a.end - a.start), alpha * na, alpha / (alpha + beta)};
  depth.bearing[1] = {-1, dot(c - b.start, tb) / norm(b.end - b.start), beta * nb, beta / (alpha + beta)};
  return Corner::inside;
}

}  // namespace

bool find_depth(const FreeSides& sides, const std::vector<PlacedSide>& placed, Index self, Index target,
                Vec2 x, bool before_too, Depth& depth) {
  const FreeSide& side = sides[target];
  const PlacedSide& here = placed[at(target)];
  bool inside = behind(here, x);
  if (!inside && !before_too) return false;
  const Foot nearest = foot(here, x);
  if (nearest.distance2 > side.reach * side.reach) return false;
  for (const bool end : {false, true}) {
    const bool at_vertex = nearest.fraction == (end ? 1.0 : 0.0);
    const Index other = end ? side.next : side.previous;
    const FreeSide& first = end ? side : sides[other];  // of the two, in the order of the surface
    if (first.angle_at_end > one_surface || other == self) {
      if (at_vertex) return false;
      continue;
    }
    const PlacedSide& there = placed[at(other)];
    const PlacedSide& a = end ? here : there;
    const PlacedSide& b = end ? there : here;
    const Corner corner = corner_depth(a, b, first.radius_at_end, x, depth);
    if (corner == Corner::inside) {
      depth.bearing[end ? 0 : 1].side = target;
      depth.bearing[end ? 1 : 0].side = other;
      return target < other;  // the other side would say the same
    }
    const double distance2 = foot(there, x).distance2;
    if (distance2 < nearest.distance2 || (distance2 == nearest.distance2 && other < target)) return false;
    if (!at_vertex) continue;
    if (corner == Corner::beside) return false;
    const bool convex = cross(a.end - a.start, b.end - b.start) > 0.0;
    inside = convex ? inside && behind(there, x) : inside || behind(there, x);
  }
  const double distance = std::sqrt(nearest.distance2);
  depth.value = inside ? distance : -distance;
  if ((nearest.fraction == 0.0 || nearest.fraction == 1.0) && distance > 0.0) {
    depth.normal = (-1.0 / depth.value) * nearest.from;
  } else {
    depth.normal = unit(right_normal(here.end - here.start));
  }
  depth.bearings = 1;
  depth.bearing[0] = {target, nearest.fraction, depth.normal, 1.0};
  return true;
}

}  // namespace crackle
