// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>
#include <span>
#include <vector>

#include "crackle/mesh/mesh.hpp"

namespace crackle {

/// Spacing of a line: `step` at first, growing by `ratio` a step, to `largest` at most [m].
struct Grading {
  double step = 0.0;
  double ratio = 1.0;
  double largest = std::numeric_limits<double>::infinity();
};

/// Coordinates [m] from `from` on: even up to `fine_end`, from there growing to `to`. The growing steps
/// are changed a little so that they end there. @throws MeshError
std::vector<double> graded_line(double from, double fine_end, double to, const Grading& grading);

/// A rectangle between lines at the given coordinates [m], increasing, each cell cut into two triangles
/// along alternating diagonals: for a fracture whose straight path is known.
/// @param crossed cells that lie in |y| <= crossed [m] are cut by both diagonals, into four: linear triangles
/// of such cells are less stiff at the tip, and so at every vertex alike. @throws MeshError
Mesh grid_rectangle(std::span<const double> x, std::span<const double> y, double crossed = 0.0);

/// Interior edges of the mesh that lie on the segment from `from` to `to` [m], in order, each meeting
/// the next. @throws MeshError when they do not make up the whole segment
std::vector<Index> edges_along(const Mesh& mesh, Vec2 from, Vec2 to);

}  // namespace crackle
