// SPDX-License-Identifier: GPL-3.0-or-later
#include "box_tree.hpp"

#include <algorithm>
#include <array>
#include <numeric>

namespace crackle {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

}  // namespace

BoxTree::BoxTree(const std::vector<Box>& boxes) : order_(boxes.size()) {
  if (boxes.empty()) return;
  std::iota(order_.begin(), order_.end(), 0);
  nodes_.resize(2 * boxes.size() - 1);
  grow(boxes, 0, 0, boxes.size());
}

void BoxTree::grow(const std::vector<Box>& boxes, std::size_t node, std::size_t begin, std::size_t end) {
  Box all = boxes[at(order_[begin])];
  for (std::size_t i = begin + 1; i < end; ++i) {
    const Box& b = boxes[at(order_[i])];
    all.lower = {std::min(all.lower.x, b.lower.x), std::min(all.lower.y, b.lower.y)};
    all.upper = {std::max(all.upper.x, b.upper.x), std::max(all.upper.y, b.upper.y)};
  }
  nodes_[node] = all;
  if (end - begin == 1) return;
  const bool wide = all.upper.x - all.lower.x > all.upper.y - all.lower.y;
  const auto centre = [&](Index i) {
    const Box& b = boxes[at(i)];
    return wide ? b.lower.x + b.upper.x : b.lower.y + b.upper.y;
  };
  const std::size_t middle = begin + (end - begin) / 2;
  const auto first = order_.begin();
  std::nth_element(first + static_cast<std::ptrdiff_t>(begin), first + static_cast<std::ptrdiff_t>(middle),
                   first + static_cast<std::ptrdiff_t>(end), [&](Index i, Index j) {
                     const double a = centre(i), b = centre(j);
                     return a < b || (a == b && i < j);
                   });
  grow(boxes, node + 1, begin, middle);
  grow(boxes, node + 2 * (middle - begin), middle, end);
}

void BoxTree::find(const Box& box, std::vector<Index>& found) const {
  if (nodes_.empty()) return;
  struct Range {
    std::size_t node, begin, end;
  };
  std::array<Range, 64> todo;  // a balanced tree of 2³¹ boxes is 31 deep
  std::size_t size = 0;
  todo[size++] = {0, 0, order_.size()};
  while (size > 0) {
    const auto [node, begin, end] = todo[--size];
    if (!nodes_[node].overlaps(box)) continue;
    if (end - begin == 1) {
      found.push_back(order_[begin]);
      continue;
    }
    const std::size_t middle = begin + (end - begin) / 2;
    todo[size++] = {node + 1, begin, middle};
    todo[size++] = {node + 2 * (middle - begin), middle, end};
  }
}

}  // namespace crackle
