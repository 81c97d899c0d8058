// SPDX-License-Identifier: GPL-3.0-or-later
//
// A tree of boxes rather than a grid: sides from 3 mm to 0.3 m lie in one scene, and no cell size
// suits both.
#pragma once

#include <vector>

#include "crackle/core/vec2.hpp"

namespace crackle {

struct Box {
  Vec2 lower, upper;
  bool overlaps(const Box& b) const {
    return lower.x <= b.upper.x && b.lower.x <= upper.x && lower.y <= b.upper.y && b.lower.y <= upper.y;
  }
};

/// Finds the boxes that overlap a given one.
class BoxTree {
 public:
  explicit BoxTree(const std::vector<Box>& boxes);

  /// Appends the indices of all boxes that overlap `box`, in no particular order.
  void find(const Box& box, std::vector<Index>& found) const;

 private:
  void grow(const std::vector<Box>& boxes, std::size_t node, std::size_t begin, std::size_t end);

  std::vector<Index> order_;
  std::vector<Box> nodes_;  // of order_[begin, end): itself, its first half's tree, its second half's
};

}  // namespace crackle
