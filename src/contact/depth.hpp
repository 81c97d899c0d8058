// SPDX-License-Identifier: GPL-3.0-or-later
//
// Depth of a point behind the surface that a free side is part of: the distance to the nearest place
// on it. Inside a convex corner the nearest side changes from one to the other, and with it the
// direction, all at once; there the distance is that to a corner rounded with radius ρ,
//   d = ρ − |x − c|,  c: the point ρ behind both sides,
// whose direction u = α n₁ + β n₂ turns gradually. Moving a side moves c by n_i·δc = n_i·δq_i with
// q_i the foot of c on it, so that exactly α of the force is borne by the one side at q₁, and β by
// the other at q₂.
#pragma once

#include <array>
#include <vector>

#include "free_sides.hpp"

namespace crackle {

/// Sides that meet with more rock between them (a notch, a crack's tip) are two surfaces, not one [rad].
inline constexpr double one_surface = 4.712388980384690;  // 270 degrees

/// A side's part in bearing a point: force there per force on the point.
struct Bearing {
  Index side = -1;
  double fraction = 0.0;  ///< place on the side: 0 its start, 1 its end
  Vec2 direction;
  double share = 0.0;  ///< of friction
};

/// Where a point lies with respect to a free side.
struct Depth {
  double value = 0.0;  ///< distance behind the surface [m]; negative: before it
  Vec2 normal;         ///< unit, out of the rock
  std::array<Bearing, 2> bearing;
  std::size_t bearings = 1;
};

/// Depth of point `x` [m] behind side `target`, if that is in reach and the nearest side of its surface.
/// @param self side that carries the point
/// @param before_too whether a point before the side is of interest; quicker if not
/// @return false: no contact of this point with this side
bool find_depth(const FreeSides& sides, const std::vector<PlacedSide>& placed, Index self, Index target,
                Vec2 x, bool before_too, Depth& depth);

}  // namespace crackle
