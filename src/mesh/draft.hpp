// SPDX-License-Identifier: GPL-3.0-or-later
// A mesh in the making, and the stages that turn a recipe into one.
#pragma once

#include "crackle/mesh/mesh.hpp"
#include "random.hpp"
#include "size_field.hpp"

namespace crackle::meshing {

/// What a segment is a piece of. Where several overlap, the first counts.
enum class Line : std::int8_t { outer, wellbore, constraint };

/// A piece of a line: two points that have to be joined by an edge.
struct Segment {
  std::array<Index, 2> end{-1, -1};
  Line line = Line::constraint;
  Index joint = -1;
};

struct Draft {
  std::vector<Vec2> points;       ///< [m]
  std::vector<Segment> segments;  ///< they meet at points only
  std::vector<std::array<Index, 3>> triangles;
};

/// Outer boundary, wellbore wall and constraints of a recipe, split where they meet; no triangles.
/// Where constraints overlap, the pieces belong to the joint of the lowest number.
Draft arrange(const MeshRecipe& recipe);

/// Cuts segments into edges of about the wanted size.
void subdivide(Draft& draft, const SizeField& size);

/// Fills the plane between the segments with points and triangles (Delaunay refinement), starting
/// from given points.
/// @param spacing start points nearer than this to another point are left out [wanted edge lengths]
void refine(Draft& draft, const SizeField& size, const std::vector<Vec2>& start, double spacing,
            Random& random);

/// Replaces the triangles by the constrained Delaunay triangulation of the points.
void triangulate(Draft& draft);

/// Moves points off the segments until triangles are near equilateral and edges near the wanted size.
void smooth(Draft& draft, const SizeField& size);

/// The stages before the order is improved and edges are derived. Each throws MeshError.
Draft make_cgal_draft(const MeshRecipe& recipe);
Draft make_gmsh_draft(const MeshRecipe& recipe);

/// @throws MeshError naming the first constraint that is not a chain of edges of the mesh
void require_constraints(const Mesh& mesh, const std::vector<Constraint>& constraints);

}  // namespace crackle::meshing
