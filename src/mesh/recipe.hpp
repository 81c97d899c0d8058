// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "crackle/mesh/mesh.hpp"

namespace crackle::meshing {

/// @throws MeshError when no sensible mesh follows from the recipe
void check_recipe(const MeshRecipe& recipe);

/// Distance from the origin to the nearest point of the outer boundary [m].
double nearest_boundary(const MeshRecipe& recipe);

}  // namespace crackle::meshing
