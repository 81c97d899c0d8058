// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "crackle/mesh/mesh.hpp"

namespace crackle::meshing {

/// Indices of the points in the order of a Hilbert curve through their bounding square.
std::vector<Index> hilbert_order(const std::vector<Vec2>& points);

}  // namespace crackle::meshing
