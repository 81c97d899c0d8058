// SPDX-License-Identifier: GPL-3.0-or-later
// After snapping: is every joint still there, and what had to give?
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "crackle/core/errors.hpp"
#include "draft.hpp"

namespace crackle::meshing {
namespace {

constexpr double sharp_deg = 20.0;
/// Edges stand for a joint within this many edge lengths of it: moves add up where joints are bundled.
constexpr double reach = 1.5;
constexpr double degree = std::numbers::pi / 180.0;

/// A part of a joint, as distances from its first end [m].
struct Part {
  double from, to;
};

/// Part of the line from p in a unit direction that lies in the wellbore; the whole wall counts as in it.
Part in_wellbore(Vec2 p, Vec2 along, double radius) {
  const double middle = -dot(p, along), off = cross(along, p);
  const double half = std::sqrt(std::max(0.0, radius * radius - off * off));
  return {middle - half, middle + half};
}

/// Part of the line that lies in the domain; from > to: none.
Part in_domain(Vec2 p, Vec2 along, double a, double b) {
  Part part{-1e300, 1e300};
  const auto cut = [&](double at, double rate, double bound) {
    if (rate == 0.0) {
      if (std::abs(at) > bound) part = {1e300, -1e300};
      return;
    }
    const double in = (-bound - at) / rate, out = (bound - at) / rate;
    part.from = std::max(part.from, std::min(in, out));
    part.to = std::min(part.to, std::max(in, out));
  };
  cut(p.x, along.x, a);
  cut(p.y, along.y, b);
  return part;
}

/// Holds one joint against the segments that may show it.
class JointCheck {
 public:
  JointCheck(const Draft& draft, const MeshRecipe& recipe, const SizeField& size, NetworkReport& report)
      : draft_(draft), recipe_(recipe), size_(size), report_(report), order_(draft.segments.size()) {
    for (std::size_t s = 0; s < order_.size(); ++s) order_[s] = {left(s), static_cast<Index>(s)};
    std::sort(order_.begin(), order_.end());
    for (std::size_t s = 0; s < order_.size(); ++s) {
      widest_ = std::max(widest_, std::abs(end(s, 0).x - end(s, 1).x));
    }
  }

  void operator()(Index j) {
    const auto [from, to, set] = recipe_.joints[j];
    const double length = norm(to - from);
    const Vec2 along = (1.0 / length) * (to - from);
    std::vector<Part> parts = outside_rock(from, along, length);
    double rock = length;
    for (const Part& part : parts) rock -= part.to - part.from;
    const std::size_t hidden = parts.size();
    const bool own = add_shown(j, from, along, length, parts);
    if (own) {
      ++report_.shown;
    } else if (rock <= 1e-9 * length) {
      ++report_.outside;
    } else if (parts.size() > hidden) {
      ++report_.merged;
    } else if (rock <= reach * size_(from + 0.5 * length * along)) {
      ++report_.too_short;
      return;
    }
    require_no_gap(j, from, along, length, parts);
  }

 private:
  Vec2 end(std::size_t s, int i) const { return draft_.points[draft_.segments[s].end[i]]; }
  double left(std::size_t s) const { return std::min(end(s, 0).x, end(s, 1).x); }

  std::vector<Part> outside_rock(Vec2 from, Vec2 along, double length) const {
    std::vector<Part> parts;
    const auto add = [&](double p, double q) {
      p = std::clamp(p, 0.0, length);
      q = std::clamp(q, 0.0, length);
      if (q > p) parts.push_back({p, q});
    };
    const Part domain = in_domain(from, along, 0.5 * recipe_.width, 0.5 * recipe_.height);
    if (domain.from > domain.to) return {{0.0, length}};
    add(0.0, domain.from);
    add(domain.to, length);
    if (recipe_.wellbore_diameter > 0.0) {
      const Part hole = in_wellbore(from, along, 0.5 * recipe_.wellbore_diameter);
      add(hole.from, hole.to);
    }
    return parts;
  }

  /// Adds what segments near the joint show of it. @returns whether any is its own
  bool add_shown(Index j, Vec2 from, Vec2 along, double length, std::vector<Part>& parts) {
    bool own = false;
    const Vec2 to = from + length * along;
    const double most = reach * std::max(size_(from), size_(to));
    const double low = std::min(from.x, to.x) - most - widest_, high = std::max(from.x, to.x) + most;
    for (auto at = std::lower_bound(order_.begin(), order_.end(), std::pair(low, Index{-1}));
         at != order_.end() && at->first <= high; ++at) {
      const Segment& segment = draft_.segments[at->second];
      std::array<double, 2> places{};
      double off = 0.0;
      Vec2 off_at;
      for (int i = 0; i < 2; ++i) {
        const Vec2 p = end(at->second, i);
        places[i] = dot(p - from, along);
        const double distance = norm(p - from - std::clamp(places[i], 0.0, length) * along);
        if (distance >= off) {
          off = distance;
          off_at = p;
        }
      }
      if (segment.joint == j) {
        own = true;
        if (off > report_.largest_move) {
          report_.largest_move = off;
          report_.largest_move_at = off_at;
        }
      } else if (off > reach * size_(off_at)) {
        continue;
      }
      const auto [first, last] = std::minmax(places[0], places[1]);
      parts.push_back({std::clamp(first, 0.0, length), std::clamp(last, 0.0, length)});
    }
    return own;
  }

  void require_no_gap(Index j, Vec2 from, Vec2 along, double length, std::vector<Part>& parts) const {
    parts.push_back({length, length});
    std::sort(parts.begin(), parts.end(), [](const Part& p, const Part& q) { return p.from < q.from; });
    double shown = 0.0;
    for (const Part& part : parts) {
      const Vec2 gap = from + 0.5 * (shown + part.from) * along;
      if (part.from - shown > reach * size_(gap)) {
        throw MeshError(fmt::format(
            "joint {} is not in the mesh round ({:.6g}, {:.6g}) m, over {:.3g} m: take smaller elements "
            "there, or move it away from its neighbours",
            j, gap.x, gap.y, part.from - shown));
      }
      shown = std::max(shown, part.to);
    }
  }

  const Draft& draft_;
  const MeshRecipe& recipe_;
  const SizeField& size_;
  NetworkReport& report_;
  std::vector<std::pair<double, Index>> order_;  ///< segments by their left end
  double widest_ = 0.0;
};

/// Directions in which joints leave each point.
std::vector<std::vector<Vec2>> joint_directions(const Draft& draft) {
  std::vector<std::vector<Vec2>> directions(draft.points.size());
  for (const Segment& segment : draft.segments) {
    if (segment.joint < 0) continue;
    const Vec2 along = draft.points[segment.end[1]] - draft.points[segment.end[0]];
    directions[segment.end[0]].push_back(along);
    directions[segment.end[1]].push_back(-along);
  }
  return directions;
}

double angle_deg(Vec2 u, Vec2 v) { return std::atan2(std::abs(cross(u, v)), dot(u, v)) / degree; }

}  // namespace

void count_sharp_angles(const Draft& draft, NetworkReport& report) {
  const auto directions = joint_directions(draft);
  for (std::size_t v = 0; v < directions.size(); ++v) {
    for (std::size_t i = 0; i < directions[v].size(); ++i) {
      for (std::size_t k = 0; k < i; ++k) {
        const double angle = angle_deg(directions[v][i], directions[v][k]);
        if (angle < sharp_deg) ++report.sharp;
        if (angle < report.sharpest_deg) {
          report.sharpest_deg = angle;
          report.sharpest_at = draft.points[v];
        }
      }
    }
  }
}

void check_lines(const Draft& draft, const MeshRecipe& recipe, const SizeField& size, NetworkReport& report) {
  report.joints = static_cast<Index>(recipe.joints.size());
  JointCheck check(draft, recipe, size, report);
  for (Index j = 0; j < report.joints; ++j) check(j);

  const auto directions = joint_directions(draft);
  for (std::size_t v = 0; v < directions.size(); ++v) {
    if (directions[v].size() > 2) ++report.junctions;
    for (std::size_t i = 0; i < directions[v].size(); ++i) {
      for (std::size_t k = 0; k < i; ++k) {
        report.smallest_angle_deg =
            std::min(report.smallest_angle_deg, angle_deg(directions[v][i], directions[v][k]));
      }
    }
  }
  for (const Segment& segment : draft.segments) {
    if (segment.joint < 0) continue;
    const double length = norm(draft.points[segment.end[1]] - draft.points[segment.end[0]]);
    report.length += length;
    report.shortest_edge = report.shortest_edge > 0.0 ? std::min(report.shortest_edge, length) : length;
  }
}

}  // namespace crackle::meshing
