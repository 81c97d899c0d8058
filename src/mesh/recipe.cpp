// SPDX-License-Identifier: GPL-3.0-or-later
// The element size that a recipe asks for, and what follows from it before any mesh is made.
#include "recipe.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "crackle/core/errors.hpp"
#include "wellbore.hpp"

namespace crackle {
namespace {

/// Element size may grow by this much a metre; faster, and neighbouring triangles lose their shape.
constexpr double steepest_growth = 0.5;
constexpr double most_triangles = 50e6;

/// Share of the circle of radius r about the origin that lies in the rectangle |x| < a, |y| < b.
double share_inside(double r, double a, double b) {
  const double from = r > a ? std::acos(a / r) : 0.0;
  const double to = r > b ? std::asin(b / r) : 0.5 * std::numbers::pi;
  return std::max(0.0, to - from) / (0.5 * std::numbers::pi);
}

}  // namespace

namespace meshing {

double nearest_boundary(const MeshRecipe& recipe) { return 0.5 * std::min(recipe.width, recipe.height); }

void check_recipe(const MeshRecipe& recipe) {
  const auto positive = [](double value, const char* what) {
    if (!(value > 0.0) || !std::isfinite(value)) {
      throw MeshError(fmt::format("{} is {}, it has to be positive", what, value));
    }
  };
  positive(recipe.width, "the width of the domain");
  positive(recipe.height, "the height of the domain");
  positive(recipe.size_fine, "the element size near the wellbore (size_fine)");
  positive(recipe.size_coarse, "the element size at the outer boundary (size_coarse)");
  if (recipe.size_fine > recipe.size_coarse) {
    throw MeshError(fmt::format("size_fine ({} m) is larger than size_coarse ({} m): exchange them",
                                recipe.size_fine, recipe.size_coarse));
  }
  const double boundary = nearest_boundary(recipe);
  if (recipe.size_fine > boundary) {
    throw MeshError(
        fmt::format("size_fine ({} m) is larger than half the domain ({} m)", recipe.size_fine, boundary));
  }
  if (!(recipe.fine_radius >= 0.0)) {
    throw MeshError(fmt::format("fine_radius is {} m, it cannot be negative", recipe.fine_radius));
  }
  if (recipe.fine_radius < boundary &&
      recipe.size_coarse - recipe.size_fine > steepest_growth * (boundary - recipe.fine_radius)) {
    throw MeshError(fmt::format(
        "element size grows from {} m to {} m over {} m, which is more than {} a metre: reduce size_coarse "
        "or fine_radius",
        recipe.size_fine, recipe.size_coarse, boundary - recipe.fine_radius, steepest_growth));
  }
  if (!(recipe.wellbore_diameter >= 0.0)) {
    throw MeshError(
        fmt::format("the wellbore diameter is {} m, it cannot be negative", recipe.wellbore_diameter));
  }
  if (recipe.wellbore_diameter >= 2.0 * boundary) {
    throw MeshError(fmt::format("the wellbore ({} m) does not fit into the domain ({} m x {} m)",
                                recipe.wellbore_diameter, recipe.width, recipe.height));
  }
  if (recipe.wellbore_segments < 0 || recipe.wellbore_segments == 1 || recipe.wellbore_segments == 2) {
    throw MeshError(
        fmt::format("a wellbore of {} segments is no polygon: give at least 3, or 0 for the default",
                    recipe.wellbore_segments));
  }
  const double a = 0.5 * recipe.width, b = 0.5 * recipe.height;
  for (std::size_t j = 0; j < recipe.joints.size(); ++j) {
    const auto& [from, to, set] = recipe.joints[j];
    const double length = norm(to - from);
    if (!std::isfinite(length) || !(norm(from) < 1e6)) {
      throw MeshError(
          fmt::format("joint {} has an end that is no place, or is farther than 1000 km away", j));
    }
    if (length < 1e-9 * std::max(a, b)) {
      throw MeshError(fmt::format("joint {} at ({} m, {} m) has no length: remove it", j, from.x, from.y));
    }
    if (set < 0 || (set > 0 && set >= static_cast<Index>(recipe.joint_sets.size()))) {
      throw MeshError(
          fmt::format("joint {} is of set {}, but there are {} sets", j, set, recipe.joint_sets.size()));
    }
  }
  const double expected = estimate_triangles(recipe);
  if (expected > most_triangles) {
    throw MeshError(
        fmt::format("the recipe asks for some {:.0f} million triangles, more than the {:.0f} million "
                    "that are allowed: increase size_fine or size_coarse, or reduce fine_radius",
                    1e-6 * expected, 1e-6 * most_triangles));
  }
}

}  // namespace meshing

double target_size(const MeshRecipe& recipe, Vec2 point) {
  const double boundary = meshing::nearest_boundary(recipe);
  if (recipe.fine_radius >= boundary) return recipe.size_fine;
  const double growth = (recipe.size_coarse - recipe.size_fine) / (boundary - recipe.fine_radius);
  const double beyond = std::clamp(norm(point) - recipe.fine_radius, 0.0, boundary - recipe.fine_radius);
  return recipe.size_fine + growth * beyond;
}

double estimate_triangles(const MeshRecipe& recipe) {
  // Equilateral triangles of edge h cover sqrt(3)/4 h^2; irregular ones of that mean edge a little
  // less (counted: tests/unit/mesh).
  constexpr double per_regular_triangle = 1.03;
  const double a = 0.5 * recipe.width, b = 0.5 * recipe.height;
  const double corner = std::sqrt(a * a + b * b);
  constexpr int rings = 4000;  // radii spaced quadratically: fine near the wellbore
  double count = 0.0;
  for (int i = 0; i < rings; ++i) {
    const double s0 = static_cast<double>(i) / rings, s1 = static_cast<double>(i + 1) / rings;
    const double r0 = corner * s0 * s0, r1 = corner * s1 * s1, r = 0.5 * (r0 + r1);
    const double size = target_size(recipe, {r, 0.0});
    count += share_inside(r, a, b) * std::numbers::pi * (r1 * r1 - r0 * r0) /
             (0.25 * std::sqrt(3.0) * size * size);
  }
  return per_regular_triangle * count;
}

}  // namespace crackle
