// SPDX-License-Identifier: GPL-3.0-or-later
#include "size_field.hpp"

#include <algorithm>
#include <cmath>

#include "wellbore.hpp"

namespace crackle::meshing {
namespace {

constexpr double growth_from_wall = 0.25;  // of size with distance: gentle enough for good angles

}

SizeField::SizeField(const MeshRecipe& recipe) : recipe_(recipe) {
  recipe_.joints.clear();
  const std::vector<Vec2> polygon = wellbore_polygon(recipe);
  if (polygon.empty()) return;
  wall_radius_ = 0.5 * recipe.wellbore_diameter;
  wall_edge_ = norm(polygon[1] - polygon[0]);
}

double SizeField::operator()(Vec2 point) const {
  const double target = target_size(recipe_, point);
  if (wall_edge_ == 0.0) return target;
  const double ease = growth_from_wall * std::abs(norm(point) - wall_radius_);
  return std::clamp(target, wall_edge_ - ease, wall_edge_ + ease);
}

}  // namespace crackle::meshing
