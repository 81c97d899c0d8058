// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "free_sides.hpp"

namespace crackle {

/// For every free side the sides that its points may come to lie behind before the rock has moved on
/// by the buffer.
class Candidates {
 public:
  void build(const FreeSides& sides, const std::vector<PlacedSide>& placed);

  /// Ascending.
  std::span<const Index> of(Index side) const {
    const std::size_t s = static_cast<std::size_t>(side);
    return {targets_.data() + first_[s], first_[s + 1] - first_[s]};
  }
  /// Motion of two points against one another that the lists allow for [m].
  double buffer() const { return buffer_; }

 private:
  std::vector<std::size_t> first_;
  std::vector<Index> targets_;
  double buffer_ = 0.0;
};

}  // namespace crackle
