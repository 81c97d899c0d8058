// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "crackle/mesh/mesh.hpp"

namespace crackle::meshing {

/// Edges round the wellbore: as given, or round(pi D / size_fine), at least 8; 0 without a wellbore.
int wellbore_edge_count(const MeshRecipe& recipe);

/// Corners of the wellbore polygon [m], on the circle, counter-clockwise from (D/2, 0).
std::vector<Vec2> wellbore_polygon(const MeshRecipe& recipe);

/// True inside a convex counter-clockwise polygon that is centred on the origin.
bool inside_polygon(const std::vector<Vec2>& polygon, Vec2 point);

}  // namespace crackle::meshing
