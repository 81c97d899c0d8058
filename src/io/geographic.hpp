// SPDX-License-Identifier: GPL-3.0-or-later
// From the plane of the run to the Earth. Private to io.
#pragma once

#include "crackle/core/vec2.hpp"
#include "crackle/io/case.hpp"

namespace crackle {

struct Geographic {
  double longitude = 0.0;  ///< [degree], -180 to 180
  double latitude = 0.0;   ///< [degree]
  double depth = 0.0;      ///< [m], positive down
};

/// The place on Earth of a point of the run, x east of the case's reference point and y north of it or,
/// with depth_axis "y", above it [m].
Geographic to_geographic(Vec2 place, const Case::Seismic& reference);

}  // namespace crackle
