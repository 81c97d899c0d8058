// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "crackle/core/vec2.hpp"
#include "crackle/mesh/joints.hpp"

namespace crackle {

/// What a triangle is made of.
enum class Region : std::int8_t {
  rock = 0,
  wellbore_core = 1,  ///< rock inside the wellbore, removed by the excavation
};

/// Where an edge lies.
enum class EdgeKind : std::int8_t {
  interior = 0,  ///< between two triangles
  outer = 1,     ///< on the outer boundary of the domain
  wellbore = 2,  ///< on the wall of an excavated wellbore
};

/// An edge of the triangulation. Face `a` belongs to triangle[0], face `b` to triangle[1].
/// Seen from triangle[0] the edge runs counter-clockwise from vertex[0] to vertex[1], so the
/// normal right_normal(v1 - v0) points from face a to face b (or out of the body).
struct Edge {
  std::array<Index, 2> vertex{-1, -1};
  std::array<Index, 2> triangle{-1, -1};    ///< triangle[1] = -1 on a boundary
  std::array<std::int8_t, 2> side{-1, -1};  ///< which side of each triangle this edge is
  EdgeKind kind = EdgeKind::interior;
  Index joint = -1;  ///< pre-existing joint the edge belongs to; -1: intact rock
};

/// A conforming triangulation of the domain, in metres, with its edges.
///
/// Side i of a triangle runs from its corner i to its corner (i + 1) % 3. Triangles are
/// counter-clockwise. `edges` and `triangle_edges` are derived by build_edges().
struct Mesh {
  std::vector<Vec2> vertices;                   ///< reference coordinates [m]
  std::vector<std::array<Index, 3>> triangles;  ///< vertices of each triangle, counter-clockwise
  std::vector<Region> regions;                  ///< one per triangle
  std::vector<Edge> edges;
  std::vector<std::array<Index, 3>> triangle_edges;  ///< edge on each side of each triangle
  std::vector<Index> set_of_joint;                   ///< of each joint that edges name: which of joint_sets
  std::vector<std::string> joint_sets;               ///< names

  Index triangle_count() const { return static_cast<Index>(triangles.size()); }
  Index vertex_count() const { return static_cast<Index>(vertices.size()); }
  Index edge_count() const { return static_cast<Index>(edges.size()); }
};

/// What to mesh: a rectangle centred on the origin, with a polygonal wellbore (its core meshed
/// too) in the middle. Element size is size_fine within fine_radius of the origin and grows
/// linearly to size_coarse at the nearest point of the outer boundary.
struct MeshRecipe {
  std::string generator = "cgal";  ///< "cgal" or "gmsh"
  double width = 0.0;              ///< extent in x [m]
  double height = 0.0;             ///< extent in y [m]
  double wellbore_diameter = 0.0;  ///< [m]; 0: no wellbore
  int wellbore_segments = 0;       ///< edges round the wellbore; 0: from size_fine
  double size_fine = 0.0;          ///< target edge length near the wellbore [m]
  double fine_radius = 0.0;        ///< [m]
  double size_coarse = 0.0;        ///< target edge length at the outer boundary [m]
  std::uint64_t seed = 1;          ///< shifts the interior points; same seed, same mesh on any CPU
  std::vector<Joint> joints;
  std::vector<std::string> joint_sets;  ///< names of the sets that joints are of
};

/// What became of a network of joints in a mesh. Joints nearer to one another (or to the wellbore) than
/// an edge can show are moved together: joints at a sharp angle run as one until they are apart.
struct NetworkReport {
  Index joints = 0;                   ///< of the recipe
  Index shown = 0;                    ///< with edges of their own
  Index merged = 0;                   ///< that run along others on their whole length
  Index too_short = 0;                ///< left out: shorter than an edge can be
  Index outside = 0;                  ///< left out: in the wellbore or outside the domain
  Index junctions = 0;                ///< points where joints meet
  Index sharp = 0;                    ///< angles below 20 degrees between joints of the recipe
  double sharpest_deg = 180.0;        ///< the smallest of them
  Vec2 sharpest_at;                   ///< [m]
  Index snapped = 0;                  ///< points that were moved onto a point or line nearby
  double largest_move = 0.0;          ///< largest distance of an edge from the joint it stands for [m]
  Vec2 largest_move_at;               ///< [m]
  double smallest_angle_deg = 180.0;  ///< between joints in the mesh
  double shortest_edge = 0.0;         ///< of joints in the mesh [m]; 0: none
  double length = 0.0;                ///< of all joints in the mesh [m]
};

/// Target edge length [m] of a recipe at a point.
double target_size(const MeshRecipe& recipe, Vec2 point);

/// Expected number of triangles of a recipe, within about 20 % (no mesh is made).
double estimate_triangles(const MeshRecipe& recipe);

/// Makes the mesh by the recipe's generator, orders it along a Hilbert curve and derives edges.
/// Every joint and the wellbore's wall are checked to be present as edges afterwards.
/// @param report where given, what became of the joints. @throws MeshError
Mesh generate_mesh(const MeshRecipe& recipe, NetworkReport* report = nullptr);

/// Derives `edges` and `triangle_edges` from `triangles` (edge kinds: interior or outer).
/// Turns clockwise triangles round. @throws MeshError on an edge with more than two triangles,
/// a degenerate triangle, or vertices out of range.
void build_edges(Mesh& mesh);

/// Reorders triangles along a Hilbert curve through their centroids and vertices by first use, so
/// that neighbours in the plane are neighbours in memory. Edges are rebuilt, their kinds and
/// joints kept.
void order_along_hilbert_curve(Mesh& mesh);

/// The mesh without its wellbore core; edges that bounded the core become EdgeKind::wellbore.
Mesh excavate(const Mesh& mesh);

/// Quality of a mesh, as `crackle check` reports it.
struct MeshQuality {
  double min_angle_deg = 0.0;  ///< smallest angle of all triangles
  Index min_angle_triangle = -1;
  double min_edge = 0.0;         ///< shortest edge [m]
  double max_edge = 0.0;         ///< longest edge [m]
  double mean_size_ratio = 0.0;  ///< mean of (edge length / target size at its midpoint); 0 without a recipe
  double max_size_ratio = 0.0;
  Index max_size_ratio_edge = -1;
};

/// @param recipe target sizes to compare with; nullptr: none (a mesh from a file)
MeshQuality measure_quality(const Mesh& mesh, const MeshRecipe* recipe);

/// The quality gate: @throws MeshError naming the worst triangle, its place and what to do, when
/// an angle is below min_angle_deg or an edge more than three times its target.
void require_quality(const Mesh& mesh, const MeshQuality& quality, double min_angle_deg);

/// Reads a gmsh file (.msh, any version that libgmsh reads). Physical surfaces named
/// "wellbore_core" become Region::wellbore_core, all others rock; each physical curve named "joint*"
/// becomes a joint, numbered from 0 by the numbers at the end of the names (none: first), then by name;
/// what stands between is the name of its set: "joint_bedding_12" is of the set "bedding", "joint12" of
/// one without a name. Boundary edges of the curve "wellbore_wall" become EdgeKind::wellbore. Vertices that
/// no triangle uses are dropped. Not to be called from two threads at once, nor write_gmsh: gmsh has global
/// state.
/// @throws MeshError
Mesh read_gmsh(const std::string& path);

/// Writes a gmsh file (version 4.1, binary) that read_gmsh() reads back to the same mesh, bit by bit
/// and in the same order. The name has to end in .msh. @throws MeshError
void write_gmsh(const Mesh& mesh, const std::string& path);

/// How structured_rectangle() cuts its cells.
enum class MeshPattern {
  right,         ///< two triangles a cell, all diagonals from lower left to upper right
  cross,         ///< four triangles a cell, round its centre
  shifted_rows,  ///< every other row of vertices shifted by half a cell: equilateral if step.y = 0.866 step.x
};

/// A rectangle [m] of nx x ny cells, for patch tests and benchmarks. @throws MeshError
Mesh structured_rectangle(Vec2 lower, Vec2 upper, int nx, int ny, MeshPattern pattern);

/// The mesh with every vertex off its boundary moved at random by at most `fraction` of its shortest
/// edge; below 0.3 no triangle of a structured mesh turns over. Kinds and joints of edges are kept.
/// @throws MeshError when triangles overlap
Mesh jittered(const Mesh& mesh, double fraction, std::uint64_t seed);

}  // namespace crackle
