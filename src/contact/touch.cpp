// SPDX-License-Identifier: GPL-3.0-or-later
#include "touch.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "crackle/state/coulomb.hpp"

namespace crackle {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

// Where a point may lie whose side has just been taken over, before what it touches [of the length]:
// pairs in rock under stress bear without overlap.
constexpr double widest_gap = 0.05;
// A point first seen deeper than this share of the reach lies in its own rock's far side.
constexpr double deepest_first = 0.5;
constexpr double slack = 1.5;  // of the bound of a point's motion in a step
constexpr int neighbours = 2;  // sides that a point may go on to in a step

struct Found {
  Index target;
  Depth depth;
  const ContactPoint* old;
};

struct Point {
  Index place;
  Vec2 x, velocity;
  std::array<double, 2> share;  // of the ends of its side
};

Point make_point(const State& state, const FreeSide& side, const PlacedSide& placed, Index place) {
  const Vec2 v0 = state.velocity[at(side.node[0])], v1 = state.velocity[at(side.node[1])];
  if (place == 0) return {place, placed.start, v0, {1.0, 0.0}};
  if (place == 1) return {place, placed.end, v1, {0.0, 1.0}};
  return {place, 0.5 * (placed.start + placed.end), 0.5 * (v0 + v1), {0.5, 0.5}};
}

// Motion of the place that bears a point [m/s].
struct Motion {
  Vec2 velocity;
  double relative = 0.0;  // of any place near it against the point, at most
};

Motion motion_of(const State& state, const FreeSides& sides, const Depth& depth, Vec2 point_velocity) {
  Motion motion;
  for (std::size_t j = 0; j < depth.bearings; ++j) {
    const Bearing& b = depth.bearing[j];
    const auto& node = sides[b.side].node;
    const Vec2 v0 = state.velocity[at(node[0])], v1 = state.velocity[at(node[1])];
    motion.velocity += b.share * ((1.0 - b.fraction) * v0 + b.fraction * v1);
    motion.relative = std::max({motion.relative, norm(point_velocity - v0), norm(point_velocity - v1)});
  }
  return motion;
}

// Half, as the points of the other face look as well; Simpson's rule.
double weight(Index place, double length) { return 0.5 * length * (place == 2 ? 4.0 : 1.0) / 6.0; }

double friction_traction(const ContactMaterial& m, double length, const ContactPoint& p) {
  return m.tangential_penalty / length * (p.slip - p.plastic_slip);
}

// Dissipation [J/m2] of a step in which the traction went from `before` to `after`.
double rubbed(double before, double after, double plastic) {
  return std::max(0.0, 0.5 * (before + after) * plastic);
}

// Sets the depth of a known point; what it changes beyond the motion of the step goes to the offset.
void follow(ContactPoint& p, double depth, double motion, bool taken_over) {
  const double change = depth - p.depth;
  if (taken_over) {
    p.offset += change;
  } else if (std::abs(change) > motion) {
    p.offset += change - std::copysign(motion, change);
  }
  p.depth = depth;
}

}  // namespace

bool comes_first(const ContactPoint& a, const ContactPoint& b) {
  return std::tie(a.side, a.place, a.target) < std::tie(b.side, b.place, b.target);
}

double side_length(const State& state, Index corner) {
  return norm(state.reference(corner % 3 == 2 ? corner - 2 : corner + 1) - state.reference(corner));
}

double energy(const ContactMaterial& m, double length, const ContactPoint& p) {
  const double overlap = std::max(0.0, p.depth - p.offset);
  const double elastic = p.slip - p.plastic_slip;
  return 0.5 * weight(p.place, length) / length *
         (m.normal_penalty * overlap * overlap + m.tangential_penalty * elastic * elastic);
}

ContactPoint take_over(const ContactMaterial& m, double length, const BornTraction& born, Index side,
                       Index place, Index target) {
  ContactPoint p;
  p.side = side;
  p.place = place;
  p.target = target;
  p.depth = born.pressure * length / m.normal_penalty;
  if (m.tangential_penalty > 0.0) p.slip = born.friction * length / m.tangential_penalty;
  return p;
}

void touch(const State& state, const ContactMaterial& m, const FreeSides& sides,
           const std::vector<PlacedSide>& placed, Index s, std::span<const Index> targets,
           std::span<const ContactPoint> known, bool first_look, Touches& touches) {
  const FreeSide& side = sides[s];
  const double length = side.length;
  const double k_n = m.normal_penalty / length, k_t = m.tangential_penalty / length;
  const double dt = state.time_step;
  const Vec2 chord = placed[at(s)].end - placed[at(s)].start, own = (1.0 / norm(chord)) * chord;
  SideSlip slip{side.corner};
  for (Index place = 0; place < 3; ++place) {
    const Point point = make_point(state, side, placed[at(s)], place);
    const bool touched =
        std::any_of(known.begin(), known.end(), [&](const ContactPoint& p) { return p.place == place; });
    std::array<Found, 8> found;
    std::size_t count = 0;
    for (const Index target : targets) {
      const FreeSide& other = sides[target];
      // A node that both share is no contact, wherever it goes.
      if (place < 2 && (other.node[0] == side.node[at(place)] || other.node[1] == side.node[at(place)]))
        continue;
      Depth depth;
      if (count == found.size() || !find_depth(sides, placed, s, target, point.x, touched, depth)) continue;
      found[count++] = {target, depth, nullptr};
    }
    // Which of them it touched before: the same side, or else one beside it.
    for (const bool same : {true, false}) {
      for (const ContactPoint& p : known) {
        if (p.place != point.place) continue;
        const Index target = sides.find(p.target);
        const auto taken = [&](const Found& f) { return f.old == &p; };
        if (target < 0 ||
            std::any_of(found.begin(), found.begin() + static_cast<std::ptrdiff_t>(count), taken))
          continue;
        for (std::size_t i = 0; i < count; ++i) {
          if (found[i].old != nullptr ||
              !(same ? found[i].target == target : sides.near(target, found[i].target, neighbours))) {
            continue;
          }
          found[i].old = &p;
          break;
        }
      }
    }
    double lost = 0.0;
    for (const ContactPoint& p : known) {
      if (p.place == point.place) lost += energy(m, length, p);
    }
    for (std::size_t i = 0; i < count; ++i) {
      const Found& f = found[i];
      const FreeSide& other = sides[f.target];
      const Motion target = motion_of(state, sides, f.depth, point.velocity);
      const double motion = slack * dt * target.relative + 1e-12 * length;
      const bool taken_over = f.old != nullptr && side.taken_over;
      ContactPoint p;
      if (f.old == nullptr) {
        if (f.depth.value <= 0.0 || f.depth.value - motion > deepest_first * other.reach) continue;
        p.side = side.corner;
        p.place = place;
        p.depth = f.depth.value;
        p.offset = first_look ? f.depth.value : std::max(0.0, f.depth.value - motion);
      } else {
        p = *f.old;
        lost -= energy(m, length, p);
        if (taken_over && f.depth.value < -widest_gap * length) {
          lost += energy(m, length, p);
          continue;
        }
        follow(p, f.depth.value, motion, taken_over);
      }
      p.target = other.corner;
      if (p.offset > 0.0) p.offset = std::min(p.offset, std::max(0.0, p.depth));

      const double overlap = std::max(0.0, p.depth - p.offset);
      const Vec2 along{-f.depth.normal.y, f.depth.normal.x};
      const double before = friction_traction(m, length, p);
      const double plastic = p.plastic_slip;
      if (f.old != nullptr && !taken_over) p.slip += dt * dot(point.velocity - target.velocity, along);
      const double friction =
          k_t > 0.0 ? coulomb_traction(k_t, p.slip, m.tan_friction * k_n * overlap, p.plastic_slip) : 0.0;
      const double w = weight(place, length);
      const double slid = p.plastic_slip - plastic, work = w * rubbed(before, friction, slid);
      touches.friction += work;
      if (k_t > 0.0 && overlap > 0.0) {
        const double cosine = -dot(along, own), share = std::copysign(2.0 * w / length, cosine);
        slip.cosine = std::max(slip.cosine, std::abs(cosine));
        slip.target = other.corner;
        slip.slid += share * slid;
        slip.traction += share * friction;
      }
      slip.work += work;
      if (overlap == 0.0 && !(p.offset > 0.0 && p.depth > 0.0)) continue;  // parted
      touches.points.push_back(p);
      if (taken_over) touches.taken_over += energy(m, length, p);
      if (overlap == 0.0) continue;
      const double push = w * k_n * overlap;
      touches.forces.push_back({push * f.depth.normal - (w * friction) * along, side.node, point.share});
      for (std::size_t j = 0; j < f.depth.bearings; ++j) {
        const Bearing& b = f.depth.bearing[j];
        touches.forces.push_back({(w * friction * b.share) * along - push * b.direction,
                                  sides[b.side].node,
                                  {1.0 - b.fraction, b.fraction}});
      }
    }
    if (!side.taken_over) touches.friction += std::max(0.0, lost);  // gone out of reach under load
  }
  if (slip.target >= 0) touches.slips.push_back(slip);
}

}  // namespace crackle
