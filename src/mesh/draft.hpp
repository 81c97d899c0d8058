// SPDX-License-Identifier: GPL-3.0-or-later
// A mesh in the making, and the stages that turn a recipe into one.
#pragma once

#include "crackle/mesh/mesh.hpp"
#include "random.hpp"
#include "size_field.hpp"

namespace crackle::meshing {

/// What a segment is a piece of. Where several overlap, the first counts.
enum class Line : std::int8_t { outer, wellbore, joint };

/// A piece of a line: two points that have to be joined by an edge.
struct Segment {
  std::array<Index, 2> end{-1, -1};
  Line line = Line::joint;
  Index joint = -1;
};

struct Draft {
  std::vector<Vec2> points;       ///< [m]
  std::vector<Segment> segments;  ///< they meet at points only
  std::vector<std::array<Index, 3>> triangles;
};

/// Outer boundary, wellbore wall and joints of a recipe, split where they meet; no triangles.
/// Where joints overlap, the pieces belong to the joint of the lowest number. Pieces of joints
/// outside the domain or in the wellbore are left out.
Draft arrange(const MeshRecipe& recipe);

/// Leaves out pieces of joints outside the domain or in the wellbore, and points without a segment.
void drop_outside(Draft& draft, const MeshRecipe& recipe);

/// Splits the segments of a draft where they cross, and makes one of those that are equal.
void split_crossings(Draft& draft, const MeshRecipe& recipe);

/// Moves points of joints that nearly touch one another, another joint, the wellbore's wall or the
/// boundary onto it, so that no two lines are closer than an edge can show. Corners of wall and
/// boundary stay where they are. @returns points moved. @throws MeshError
Index snap(Draft& draft, const MeshRecipe& recipe, const SizeField& size);

/// arrange(), snap() and subdivide() a recipe: all lines as edges, before the plane is filled.
Draft draw_lines(const MeshRecipe& recipe, const SizeField& size, NetworkReport& report);

/// Counts the sharp angles of a network as it was given, arranged.
void count_sharp_angles(const Draft& draft, NetworkReport& report);

/// Counts what snapping did, and holds the lines against the joints that they stand for.
/// @throws MeshError when part of a joint in the rock is not there
void check_lines(const Draft& draft, const MeshRecipe& recipe, const SizeField& size, NetworkReport& report);

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

/// The stages before the order is improved and edges are derived: lines drawn beforehand, by
/// draw_lines(), are filled with triangles. Each throws MeshError.
void fill_by_cgal(Draft& draft, const MeshRecipe& recipe, const SizeField& size);
void fill_by_gmsh(Draft& draft, const MeshRecipe& recipe, const SizeField& size);

/// A line that has to be in a mesh [m].
struct Constraint {
  Vec2 from, to;
  bool joint = false;  ///< and belongs to a joint
};

/// @throws MeshError naming the first constraint that is not a chain of edges of the mesh
void require_constraints(const Mesh& mesh, const std::vector<Constraint>& constraints);

}  // namespace crackle::meshing
