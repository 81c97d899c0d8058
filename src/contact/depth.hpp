// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "free_sides.hpp"

namespace crackle {

/// Sides that meet with more rock between them (a notch, a crack's tip) are two surfaces, not one [rad].
inline constexpr double one_surface = 4.712388980384690;  // 270 degrees

/// Where a point lies with respect to a free side.
struct Depth {
  double value = 0.0;     ///< distance behind the side [m]; negative: before it
  double fraction = 0.0;  ///< nearest place on the side: 0 its start, 1 its end
  Vec2 normal;            ///< unit, out of the side's rock, from the nearest place or to it
};

/// Depth of point `x` [m] behind side `target`, if that is in reach and the nearest side of its surface.
/// @param self side that carries the point
/// @return false: no contact of this point with this side
bool find_depth(const FreeSides& sides, const std::vector<PlacedSide>& placed, Index self, Index target,
                Vec2 x, Depth& depth);

}  // namespace crackle
