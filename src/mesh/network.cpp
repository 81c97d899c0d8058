// SPDX-License-Identifier: GPL-3.0-or-later
// Random networks of joints: places, lengths and directions of one set are independent.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "crackle/core/errors.hpp"
#include "crackle/mesh/joints.hpp"
#include "portable_math.hpp"
#include "random.hpp"

namespace crackle {
namespace {

using meshing::portable_direction;
using meshing::portable_exp;
using meshing::portable_log;
using meshing::Random;

constexpr double most_joints = 1e6;
constexpr int most_tries = 10000;  // for one joint

/// Standard normal, by the polar method (Marsaglia and Bray 1964); its second number is not kept.
double normal(Random& random) {
  for (;;) {
    const double x = random.between(-1.0, 1.0), y = random.between(-1.0, 1.0);
    const double square = x * x + y * y;
    if (square > 0.0 && square < 1.0) return x * std::sqrt(-2.0 * portable_log(square) / square);
  }
}

double power_law(const JointLengths& lengths, Random& random) {
  const double low = portable_log(lengths.min), high = portable_log(lengths.max);
  const double rise = 1.0 - lengths.exponent, share = random.uniform();
  if (std::abs(rise) * (high - low) < 1e-9) return portable_exp(low + share * (high - low));
  // the inverse of the distribution function, from the end where it does not overflow
  const double far = portable_exp(-std::abs(rise) * (high - low));
  const double at = portable_log(rise < 0.0 ? 1.0 - share * (1.0 - far) : far + share * (1.0 - far));
  return portable_exp((rise < 0.0 ? low : high) + at / rise);
}

double draw_untruncated(const JointLengths& lengths, Random& random) {
  switch (lengths.law) {
    case JointLengths::Law::constant:
      return lengths.mean;
    case JointLengths::Law::normal:
      return lengths.mean + lengths.deviation * normal(random);
    case JointLengths::Law::lognormal: {
      const double ratio = lengths.deviation / lengths.mean;
      const double variance = portable_log(1.0 + ratio * ratio);
      return lengths.mean * portable_exp(std::sqrt(variance) * normal(random) - 0.5 * variance);
    }
    case JointLengths::Law::power_law:
      return std::clamp(power_law(lengths, random), lengths.min, lengths.max);
  }
  return 0.0;
}

double draw_length(const JointLengths& lengths, Random& random) {
  for (int i = 0; i < most_tries; ++i) {
    const double length = draw_untruncated(lengths, random);
    if (length > 0.0 && length >= lengths.min && length <= lengths.max) return length;
  }
  throw MeshError(fmt::format(
      "hardly any joint of mean length {:.6g} m comes out between the shortest ({:.6g} m) and the "
      "longest ({:.6g} m) allowed: change mean, deviation or limits",
      lengths.mean, lengths.min, lengths.max));
}

/// Half the angle of a von Mises variate about 0, as a direction (Best and Fisher 1979).
Vec2 draw_axis(double concentration, Random& random) {
  const double tau = 1.0 + std::sqrt(1.0 + 4.0 * concentration * concentration);
  const double rho = (tau - std::sqrt(2.0 * tau)) / (2.0 * concentration);
  const double r = (1.0 + rho * rho) / (2.0 * rho);
  for (;;) {
    const double z = portable_direction(std::numbers::pi * random.uniform()).x;
    const double f = std::clamp((1.0 + r * z) / (r + z), -1.0, 1.0), c = concentration * (r - f);
    const double u = 1.0 - random.uniform();  // above 0
    const bool left = random.uniform() < 0.5;
    if (c * (2.0 - c) - u <= 0.0 && portable_log(c / u) + 1.0 - c < 0.0) continue;
    // cos(φ/2) and sin(φ/2) of cos φ = f
    return {std::sqrt(0.5 * (1.0 + f)), (left ? 1.0 : -1.0) * std::sqrt(0.5 * (1.0 - f))};
  }
}

Vec2 draw_direction(const JointDirections& directions, Random& random) {
  constexpr double few = 1e-6;  // a concentration that cannot be told from none
  const bool uniform = directions.law == JointDirections::Law::uniform ||
                       (directions.law == JointDirections::Law::von_mises && directions.concentration < few);
  if (uniform) return portable_direction(std::numbers::pi * random.uniform());
  const Vec2 mean = portable_direction(directions.angle);
  if (directions.law == JointDirections::Law::constant) return mean;
  const Vec2 turn = draw_axis(directions.concentration, random);
  return {mean.x * turn.x - mean.y * turn.y, mean.y * turn.x + mean.x * turn.y};
}

double area(const JointRegion& region) {
  if (region.radius > 0.0) return std::numbers::pi * region.radius * region.radius;
  return (region.upper.x - region.lower.x) * (region.upper.y - region.lower.y);
}

Vec2 draw_middle(const JointRegion& region, Random& random) {
  const double r = region.radius;
  const Vec2 lower = r > 0.0 ? Vec2{-r, -r} : region.lower, upper = r > 0.0 ? Vec2{r, r} : region.upper;
  for (;;) {
    const double x = random.between(lower.x, upper.x), y = random.between(lower.y, upper.y);
    if (r <= 0.0 || x * x + y * y < r * r) return {x, y};
  }
}

double distance_from_origin(Vec2 middle, Vec2 direction, double length) {
  const double at = std::clamp(-dot(middle, direction), -0.5 * length, 0.5 * length);
  return norm(middle + at * direction);
}

}  // namespace

std::vector<Joint> generate_joints(const JointSet& set, Index number_of_set) {
  const double wanted = set.density * area(set.region);
  if (!(wanted <= most_joints)) {
    throw MeshError(
        fmt::format("a density of {:.6g} joints per m2 on {:.6g} m2 makes more than a million joints",
                    set.density, area(set.region)));
  }
  Random random(set.seed);
  std::vector<Joint> joints;
  for (std::int64_t k = std::llround(wanted); k > 0; --k) {
    const Vec2 middle = draw_middle(set.region, random);
    const double length = draw_length(set.length, random);
    const Vec2 direction = draw_direction(set.direction, random);
    if (distance_from_origin(middle, direction, length) < set.clear_radius) continue;
    const Vec2 half = 0.5 * length * direction;
    joints.push_back({middle - half, middle + half, number_of_set});
  }
  return joints;
}

}  // namespace crackle
