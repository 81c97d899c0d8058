// SPDX-License-Identifier: GPL-3.0-or-later
// The wellbore as a regular polygon with its corners on the circle.
#include "wellbore.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "portable_math.hpp"

namespace crackle::meshing {
namespace {

/// Direction of corner k of n: k/n of a full turn, exact at multiples of a quarter turn.
Vec2 direction(std::int64_t k, std::int64_t n) {
  const std::int64_t octant = 8 * k / n;
  const std::int64_t rest = 8 * k - octant * n;  // n-ths of an octant past the octant's start
  const bool mirrored = octant % 2 == 1;         // odd octants: measured back from the next axis
  const double share = static_cast<double>(mirrored ? n - rest : rest) / static_cast<double>(n);
  Vec2 d = direction_in_first_octant(0.25 * std::numbers::pi * share);
  if (mirrored) std::swap(d.x, d.y);
  for (std::int64_t quarter = octant / 2; quarter > 0; --quarter) d = {-d.y, d.x};
  return d;
}

}  // namespace

int wellbore_edge_count(const MeshRecipe& recipe) {
  if (recipe.wellbore_diameter <= 0.0) return 0;
  if (recipe.wellbore_segments > 0) return recipe.wellbore_segments;
  const double edges = std::round(std::numbers::pi * recipe.wellbore_diameter / recipe.size_fine);
  return static_cast<int>(std::clamp(edges, 8.0, 1e8));
}

std::vector<Vec2> wellbore_polygon(const MeshRecipe& recipe) {
  const int n = wellbore_edge_count(recipe);
  std::vector<Vec2> polygon;
  polygon.reserve(n);
  for (int k = 0; k < n; ++k) polygon.push_back(0.5 * recipe.wellbore_diameter * direction(k, n));
  return polygon;
}

bool inside_polygon(const std::vector<Vec2>& polygon, Vec2 point) {
  const std::size_t n = polygon.size();
  if (n == 0) return false;
  const double radius_square = dot(polygon[0], polygon[0]);
  const double square = dot(point, point);
  if (square >= radius_square) return false;
  const Vec2 middle = 0.5 * (polygon[0] + polygon[1]);
  if (square < dot(middle, middle)) return true;
  for (std::size_t k = 0; k < n; ++k) {
    if (cross(polygon[(k + 1) % n] - polygon[k], point - polygon[k]) < 0.0) return false;
  }
  return true;
}

}  // namespace crackle::meshing
