// SPDX-License-Identifier: GPL-3.0-or-later
//
//   Δφ = y / M,   Δλ = x / (N cos φ)      in a level section; in an upright one Δφ = 0 and depth = d0 − y
//   M = a (1 - e²) / (1 - e² sin² φ)^{3/2},   N = a / (1 - e² sin² φ)^{1/2}
//
// Source: any text on geodesy; a and e² of WGS 84 (NIMA TR8350.2, 2000).
//
//   | symbol | meaning                                        | unit |
//   | φ, λ   | latitude and longitude of the reference point  | rad  |
//   | M      | radius of curvature of the meridian            | m    |
//   | N      | radius of curvature of the prime vertical      | m    |
//
// Limits: a flat Earth at the reference point. The error grows with the square of the distance, about
// 1e-7 m at 1 m and 0.1 m at 1 km at middle latitudes; the depth (1 km: 1.6e-4 of the distance) is
// left out. At a pole every longitude is the same place, and the reference's is given.
#include "geographic.hpp"

#include <cmath>
#include <numbers>

namespace crackle {

Geographic to_geographic(Vec2 place, const Case::Seismic& reference) {
  constexpr double a = 6378137.0;  // [m]
  constexpr double flattening = 1.0 / 298.257223563;
  constexpr double e2 = flattening * (2.0 - flattening);
  constexpr double degree = std::numbers::pi / 180.0;

  const double sine = std::sin(reference.latitude * degree);
  const double cosine = std::cos(reference.latitude * degree);
  const double w2 = 1.0 - e2 * sine * sine;
  const double normal_radius = a / std::sqrt(w2);
  const double meridian_radius = normal_radius * (1.0 - e2) / w2;

  const bool upright = reference.depth_axis == "y";
  Geographic point{reference.longitude, reference.latitude, reference.depth};
  if (upright) {
    point.depth -= place.y;
  } else {
    point.latitude += place.y / meridian_radius / degree;
  }
  if (cosine > 1e-9) point.longitude += place.x / (normal_radius * cosine) / degree;
  point.longitude = std::remainder(point.longitude, 360.0);
  return point;
}

}  // namespace crackle
