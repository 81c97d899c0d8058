// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "crackle/mesh/mesh.hpp"

namespace crackle::meshing {

/// The edge length [m] that the generators aim at: the recipe's target, eased towards the edges of
/// the wellbore wall where their number was given and does not match the target.
class SizeField {
 public:
  explicit SizeField(const MeshRecipe& recipe);
  double operator()(Vec2 point) const;

 private:
  MeshRecipe recipe_;  ///< without its joints
  double wall_radius_ = 0.0;
  double wall_edge_ = 0.0;
};

}  // namespace crackle::meshing
