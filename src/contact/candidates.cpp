// SPDX-License-Identifier: GPL-3.0-or-later
#include "candidates.hpp"

#include <algorithm>
#include <limits>

#include "box_tree.hpp"
#include "depth.hpp"

namespace crackle {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

constexpr double buffer_of_shortest = 0.25;
constexpr int neighbours_of_partner = 2;

// A matched face is borne by its own pair: neither its partner nor what lies beside that is for it.
bool lies_with_partner(const FreeSides& sides, Index matched, Index other,
                       const std::vector<Index>& partner) {
  return partner[at(matched)] >= 0 && sides.near(partner[at(matched)], other, neighbours_of_partner);
}

bool may_meet(const FreeSides& sides, Index s, Index target, const std::vector<Index>& partner) {
  const FreeSide& a = sides[s];
  const FreeSide& b = sides[target];
  if (a.corner / 3 == b.corner / 3) return false;
  if (a.matched && b.matched) return false;
  if (a.next == target && a.angle_at_end <= one_surface) return false;
  if (b.next == s && b.angle_at_end <= one_surface) return false;
  if (a.matched && lies_with_partner(sides, s, target, partner)) return false;
  if (b.matched && a.element < 0 && lies_with_partner(sides, target, s, partner)) return false;
  return true;
}

Box grown(const PlacedSide& side, double by) {
  const Vec2 lower{std::min(side.start.x, side.end.x), std::min(side.start.y, side.end.y)};
  const Vec2 upper{std::max(side.start.x, side.end.x), std::max(side.start.y, side.end.y)};
  return {lower - Vec2{by, by}, upper + Vec2{by, by}};
}

std::vector<Index> find_partners(const FreeSides& sides) {
  std::vector<std::pair<Index, Index>> faces;  // element, side
  for (Index s = 0; s < sides.count(); ++s) {
    if (sides[s].matched) faces.emplace_back(sides[s].element, s);
  }
  std::sort(faces.begin(), faces.end());
  std::vector<Index> partner(at(sides.count()), -1);
  for (std::size_t i = 0; i + 1 < faces.size(); i += 2) {
    partner[at(faces[i].second)] = faces[i + 1].second;
    partner[at(faces[i + 1].second)] = faces[i].second;
  }
  return partner;
}

}  // namespace

void Candidates::build(const FreeSides& sides, const std::vector<PlacedSide>& placed) {
  double shortest = std::numeric_limits<double>::infinity();
  for (Index s = 0; s < sides.count(); ++s) shortest = std::min(shortest, sides[s].length);
  buffer_ = buffer_of_shortest * shortest;
  const std::vector<Index> partner = find_partners(sides);
  std::vector<Box> boxes;
  boxes.reserve(placed.size());
  for (Index s = 0; s < sides.count(); ++s) boxes.push_back(grown(placed[at(s)], sides[s].reach + buffer_));
  const BoxTree tree(boxes);
  first_.assign(1, 0);
  targets_.clear();
  std::vector<Index> found;
  for (Index s = 0; s < sides.count(); ++s) {
    found.clear();
    tree.find(grown(placed[at(s)], 0.0), found);
    std::sort(found.begin(), found.end());
    for (const Index target : found) {
      if (target != s && may_meet(sides, s, target, partner)) targets_.push_back(target);
    }
    first_.push_back(targets_.size());
  }
}

}  // namespace crackle
