// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "crackle/mesh/mesh.hpp"

namespace crackle {

/// Coordinates [m] from `from` on: spacing `step` up to `fine_end`, from there growing by `ratio` a
/// step to `to`. The last steps are stretched a little so that they end there. @throws MeshError
std::vector<double> graded_line(double from, double fine_end, double to, double step, double ratio);

/// A rectangle between lines at the given coordinates [m], increasing, each cell cut into two triangles
/// along alternating diagonals: for a fracture whose straight path is known. @throws MeshError
Mesh grid_rectangle(std::span<const double> x, std::span<const double> y);

/// Interior edges of the mesh that lie on the segment from `from` to `to` [m], in order, each meeting
/// the next. @throws MeshError when they do not make up the whole segment
std::vector<Index> edges_along(const Mesh& mesh, Vec2 from, Vec2 to);

}  // namespace crackle
