// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "crackle/core/vec2.hpp"

namespace crackle {

/// A pre-existing joint of the rock: a straight line [m].
struct Joint {
  Vec2 from, to;
  Index set = 0;  ///< which of the network's sets it belongs to: joints of one set share their properties
};

/// Lengths of joints: f(l) is truncated to [min, max] by drawing again.
struct JointLengths {
  enum class Law : std::uint8_t {
    constant,   ///< mean
    normal,     ///< Gauss
    lognormal,  ///< ln l is normal; mean and deviation are those of l
    power_law,  ///< f(l) ~ l^-exponent between min and max (Bonnet et al. 2001, Eq. 9)
  };
  Law law = Law::constant;
  double mean = 0.0;                                     ///< before truncation [m]
  double deviation = 0.0;                                ///< standard deviation before truncation [m]
  double exponent = 0.0;                                 ///< of the power law
  double min = 0.0;                                      ///< [m]
  double max = std::numeric_limits<double>::infinity();  ///< [m]
};

/// Directions of joints, which have no sense of running: angles are modulo half a turn.
struct JointDirections {
  enum class Law : std::uint8_t {
    constant,   ///< angle
    uniform,    ///< all alike
    von_mises,  ///< f(θ) ~ exp(κ cos 2(θ − angle)) (Mardia and Jupp 2000, axial data)
  };
  Law law = Law::uniform;
  double angle = 0.0;          ///< from the x axis, counter-clockwise [rad]
  double concentration = 0.0;  ///< κ
};

/// Where the middles of joints lie: within `radius` of the origin, or, with radius 0, in the rectangle.
struct JointRegion {
  Vec2 lower, upper;    ///< corners [m]
  double radius = 0.0;  ///< [m]
};

/// A random set of joints. Their middles are uniform in the region and independent of one another.
struct JointSet {
  double density = 0.0;  ///< middles per area [1/m2]
  JointLengths length;
  JointDirections direction;
  JointRegion region;
  /// Circle round the origin that no joint may enter [m]; 0: none. Joints that would are left out, so
  /// that the density far from it is the one asked for.
  double clear_radius = 0.0;
  std::uint64_t seed = 1;  ///< the same seed gives the same joints on any CPU
};

/// The joints of a set. @throws MeshError when the set asks for more than a million, or for lengths
/// that its limits nearly rule out
std::vector<Joint> generate_joints(const JointSet& set, Index number_of_set = 0);

}  // namespace crackle
