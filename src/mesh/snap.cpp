// SPDX-License-Identifier: GPL-3.0-or-later
// Joints that nearly touch become joints that touch. A joint network has gaps, crossings and angles
// of any smallness, and each would become a triangle of that size, which sets the time step of a
// whole run. So, as in iterated snap rounding (Halperin and Packer 2002) but with the element size in
// place of a pixel: a point nearer to another one than `closest` element sizes moves onto it, and a
// point that near to a line moves onto the line, which it then splits. Two joints that meet at a sharp
// angle so run as one up to where they are `closest` apart. The nearest pairs go first; after every
// round crossings are looked for again, exactly.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include "crackle/core/errors.hpp"
#include "draft.hpp"
#include "wellbore.hpp"

namespace crackle::meshing {
namespace {

constexpr double closest = 0.4;  ///< of the wanted edge length
constexpr int most_rounds = 200;

/// How firmly a point is held: of two that meet, the looser one moves.
enum class Hold : std::int8_t { end, line, junction, boundary, corner };

/// A point that is too near to another one, or to a segment.
struct Pair {
  double distance = 0.0;  ///< in wanted edge lengths; below 0: has to go whatever the distance
  Index point = -1;       ///< moves
  Index other = -1;       ///< a point; -1: the segment
  Index segment = -1;
};

class Snapper {
 public:
  Snapper(Draft& draft, const MeshRecipe& recipe, const SizeField& size)
      : draft_(draft), wall_(wellbore_polygon(recipe)) {
    const double a = 0.5 * recipe.width, b = 0.5 * recipe.height;
    corners_ = wall_;
    corners_.insert(corners_.end(), {{-a, -b}, {a, -b}, {a, b}, {-a, b}});
    std::sort(corners_.begin(), corners_.end(), before);
    for (const Vec2 p : draft.points) reach_.push_back(closest * size(p));
    hold_points();
    by_x_.resize(draft.points.size());
    std::iota(by_x_.begin(), by_x_.end(), 0);
    std::sort(by_x_.begin(), by_x_.end(), [&](Index u, Index v) {
      return draft.points[u].x != draft.points[v].x ? draft.points[u].x < draft.points[v].x : u < v;
    });
  }

  /// Makes the moves that do not disturb one another. @returns how many
  Index round() {
    find_points_on_the_wall();
    find_near_points();
    find_points_near_segments();
    std::sort(pairs_.begin(), pairs_.end(), [](const Pair& p, const Pair& q) {
      return std::tie(p.distance, p.point, p.other, p.segment) <
             std::tie(q.distance, q.point, q.other, q.segment);
    });
    moved_.assign(draft_.points.size(), false);
    anchor_.assign(draft_.points.size(), false);
    split_.assign(draft_.segments.size(), false);
    Index made = 0;
    for (const Pair& pair : pairs_) {
      if (pair.segment < 0 ? merge(pair.point, pair.other) : put_on(pair.point, pair.segment)) ++made;
    }
    return made;
  }

 private:
  static bool before(Vec2 p, Vec2 q) { return p.x != q.x ? p.x < q.x : p.y < q.y; }

  void hold_points() {
    const std::size_t n = draft_.points.size();
    std::vector<Index> joints(n, 0);
    hold_.assign(n, Hold::end);
    on_wall_.assign(n, false);
    for (const Segment& segment : draft_.segments) {
      for (const Index v : segment.end) {
        if (segment.line == Line::joint) ++joints[v];
        if (segment.line == Line::outer) hold_[v] = Hold::boundary;
        if (segment.line == Line::wellbore) on_wall_[v] = true;
      }
    }
    on_joint_.resize(n);
    for (std::size_t v = 0; v < n; ++v) {
      on_joint_[v] = joints[v] > 0;
      if (hold_[v] == Hold::end && joints[v] > 1) hold_[v] = joints[v] > 2 ? Hold::junction : Hold::line;
      if (std::binary_search(corners_.begin(), corners_.end(), draft_.points[v], before))
        hold_[v] = Hold::corner;
    }
  }

  /// The wall keeps its edges: a joint meets it at a corner.
  void find_points_on_the_wall() {
    for (Index v = 0; v < count(); ++v) {
      if (!on_wall_[v] || hold_[v] == Hold::corner) continue;
      const Vec2 p = draft_.points[v];
      const auto nearest = std::min_element(
          wall_.begin(), wall_.end(), [&](Vec2 q, Vec2 r) { return dot(q - p, q - p) < dot(r - p, r - p); });
      pairs_.push_back({-1.0, v, find(*nearest), -1});
    }
  }

  void find_near_points() {
    for (std::size_t i = 0; i < by_x_.size(); ++i) {
      const Index u = by_x_[i];
      for (std::size_t k = i + 1; k < by_x_.size(); ++k) {
        const Index v = by_x_[k];
        const Vec2 apart = draft_.points[v] - draft_.points[u];
        if (apart.x >= 2.0 * reach_[u]) break;  // size does not double over that
        if (!touch(u, v) || (!on_joint_[u] && !on_joint_[v])) continue;
        if (hold_[u] == Hold::corner && hold_[v] == Hold::corner) continue;
        const bool first = hold_[u] != hold_[v] ? hold_[u] < hold_[v] : u > v;
        pairs_.push_back({norm(apart) / reach_[u], first ? u : v, first ? v : u, -1});
      }
    }
  }

  void find_points_near_segments() {
    for (std::size_t s = 0; s < draft_.segments.size(); ++s) {
      const Segment& segment = draft_.segments[s];
      const Vec2 p = draft_.points[segment.end[0]], q = draft_.points[segment.end[1]];
      const Vec2 along = q - p;
      if (p == q) continue;  // two crossings that are rounded to one place: they will be one point
      const double most = std::max(reach_[segment.end[0]], reach_[segment.end[1]]);
      const double low = std::min(p.x, q.x) - most, high = std::max(p.x, q.x) + most;
      auto at = std::lower_bound(by_x_.begin(), by_x_.end(), low,
                                 [&](Index v, double x) { return draft_.points[v].x < x; });
      for (; at != by_x_.end() && draft_.points[*at].x <= high; ++at) {
        const Index v = *at;
        if (v == segment.end[0] || v == segment.end[1]) continue;
        if (segment.line == Line::joint ? false : !on_joint_[v] || hold_[v] >= Hold::boundary) continue;
        const Vec2 here = draft_.points[v] - p;
        const double share = dot(here, along) / dot(along, along);
        const double distance = std::abs(cross(here, along)) / norm(along);
        if (share <= 0.0 || share >= 1.0 || distance >= reach_[v]) continue;
        if (near_end(v, segment) || wide_angle(v, segment)) continue;
        pairs_.push_back({distance / reach_[v], v, -1, static_cast<Index>(s)});
      }
    }
  }

  bool touch(Index u, Index v) const {
    return norm(draft_.points[u] - draft_.points[v]) < 0.5 * (reach_[u] + reach_[v]);
  }

  /// The point will become one with an end of the segment.
  bool near_end(Index v, const Segment& segment) const {
    for (const Index end : segment.end) {
      const bool both_firm = hold_[v] == Hold::corner && hold_[end] == Hold::corner;
      if (!both_firm && touch(v, end)) return true;
    }
    return false;
  }

  /// The segment leaves the boundary (or wall) near the point, but at a wide angle. To lead it over the
  /// point would only turn the triangle of the two and its far end round, and then back again.
  bool wide_angle(Index v, const Segment& segment) const {
    if (hold_[v] < Hold::boundary) return false;
    for (int i = 0; i < 2; ++i) {
      const Vec2 end = draft_.points[segment.end[i]], along = draft_.points[segment.end[1 - i]] - end;
      const Vec2 here = draft_.points[v] - end;
      if (hold_[segment.end[i]] >= Hold::boundary && std::abs(cross(along, here)) >= dot(along, here))
        return true;
    }
    return false;
  }

  bool merge(Index u, Index v) {
    if (moved_[u] || anchor_[u] || moved_[v]) return false;
    moved_[u] = anchor_[v] = true;
    draft_.points[u] = draft_.points[v];  // split_crossings() makes one point of them
    return true;
  }

  /// A loose point goes onto the segment, to a firm one the segment comes.
  bool put_on(Index v, Index s) {
    Segment& segment = draft_.segments[s];
    const auto [i, k] = segment.end;
    if (split_[s] || moved_[v] || moved_[i] || moved_[k]) return false;
    if (hold_[v] < Hold::boundary) {
      if (anchor_[v]) return false;
      const Vec2 p = draft_.points[i], q = draft_.points[k], here = draft_.points[v];
      const double share = dot(here - p, q - p) / dot(q - p, q - p), length = norm(q - p);
      const double from_end = std::min(share, 1.0 - share) * length;
      if (segment.line == Line::wellbore || from_end < reach_[v]) return merge(v, share < 0.5 ? i : k);
      draft_.points[v] = p + share * (q - p);
      moved_[v] = true;
    }
    anchor_[v] = anchor_[i] = anchor_[k] = true;
    split_[s] = true;
    const Segment rest{{v, k}, segment.line, segment.joint};
    segment.end[1] = v;
    draft_.segments.push_back(rest);
    split_.push_back(true);
    return true;
  }

  Index count() const { return static_cast<Index>(draft_.points.size()); }

  Index find(Vec2 place) const {
    auto at = std::lower_bound(by_x_.begin(), by_x_.end(), place.x,
                               [&](Index v, double x) { return draft_.points[v].x < x; });
    while (draft_.points[*at] != place) ++at;
    return *at;
  }

  Draft& draft_;
  std::vector<Vec2> wall_, corners_;
  std::vector<double> reach_;  ///< of each point: nearer ones touch [m]
  std::vector<Hold> hold_;
  std::vector<bool> on_wall_, on_joint_;
  std::vector<Index> by_x_;
  std::vector<Pair> pairs_;
  std::vector<bool> moved_, anchor_, split_;
};

}  // namespace

Index snap(Draft& draft, const MeshRecipe& recipe, const SizeField& size) {
  Index moves = 0;
  for (int round = 0; round < most_rounds; ++round) {
    const Index made = Snapper(draft, recipe, size).round();
    if (made == 0) {
      drop_outside(draft, recipe);
      return moves;
    }
    moves += made;
    split_crossings(draft, recipe);
  }
  throw MeshError("the joints lie too densely to be told apart: take fewer of them or smaller elements");
}

Draft draw_lines(const MeshRecipe& recipe, const SizeField& size, NetworkReport& report) {
  Draft draft = arrange(recipe);
  if (recipe.joints.empty()) {
    subdivide(draft, size);
    return draft;
  }
  count_sharp_angles(draft, report);
  report.snapped = snap(draft, recipe, size);  // whole lines first: they stay straight
  subdivide(draft, size);
  report.snapped += snap(draft, recipe, size);
  check_lines(draft, recipe, size, report);
  return draft;
}

}  // namespace crackle::meshing
