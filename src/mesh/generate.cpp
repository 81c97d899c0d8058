// SPDX-License-Identifier: GPL-3.0-or-later
// From a recipe to a mesh: the named generator, then what every mesh gets.
#include <fmt/format.h>

#include "crackle/core/errors.hpp"
#include "draft.hpp"
#include "edge_marks.hpp"
#include "recipe.hpp"
#include "wellbore.hpp"

namespace crackle {
namespace {

using meshing::Line;
using meshing::Segment;

void fill(meshing::Draft& draft, const MeshRecipe& recipe, const meshing::SizeField& size) {
  if (recipe.generator == "cgal") return meshing::fill_by_cgal(draft, recipe, size);
  if (recipe.generator == "gmsh") return meshing::fill_by_gmsh(draft, recipe, size);
  throw MeshError(
      fmt::format("there is no mesh generator \"{}\": use \"cgal\" or \"gmsh\"", recipe.generator));
}

/// What has to be in the mesh: the wellbore's wall and the joints.
std::vector<meshing::Constraint> lines_of(const meshing::Draft& draft, const std::vector<Vec2>& wellbore) {
  std::vector<meshing::Constraint> lines;
  for (std::size_t k = 0; k < wellbore.size(); ++k) {
    lines.push_back({wellbore[k], wellbore[(k + 1) % wellbore.size()], false});
  }
  for (const Segment& segment : draft.segments) {
    if (segment.joint < 0) continue;
    lines.push_back({draft.points[segment.end[0]], draft.points[segment.end[1]], true});
  }
  return lines;
}

Mesh to_mesh(meshing::Draft&& draft, const std::vector<Vec2>& wellbore) {
  Mesh mesh;
  mesh.vertices = std::move(draft.points);
  mesh.triangles = std::move(draft.triangles);
  for (const auto& [p, q, r] : mesh.triangles) {
    const Vec2 centroid = (1.0 / 3.0) * (mesh.vertices[p] + mesh.vertices[q] + mesh.vertices[r]);
    const bool core = meshing::inside_polygon(wellbore, centroid);
    mesh.regions.push_back(core ? Region::wellbore_core : Region::rock);
  }
  build_edges(mesh);
  std::vector<meshing::EdgeMark> marks;
  for (const meshing::Segment& segment : draft.segments) {
    marks.push_back({segment.end, EdgeKind::interior, segment.joint});
  }
  const auto missing = meshing::apply_edge_marks(mesh, marks);
  if (!missing.empty()) {
    const Vec2 at = mesh.vertices[missing.front().vertex[0]];
    throw MeshError(
        fmt::format("the generator lost {} edges of boundary, wellbore or joints, the first at "
                    "({:.6g}, {:.6g}) m: use the other generator",
                    missing.size(), at.x, at.y));
  }
  return mesh;
}

}  // namespace

Mesh generate_mesh(const MeshRecipe& recipe, NetworkReport* report) {
  meshing::check_recipe(recipe);
  const meshing::SizeField size(recipe);
  NetworkReport network;
  meshing::Draft draft = meshing::draw_lines(recipe, size, network);
  const std::vector<Vec2> wellbore = meshing::wellbore_polygon(recipe);
  const std::vector<meshing::Constraint> lines = lines_of(draft, wellbore);
  fill(draft, recipe, size);
  Mesh mesh = to_mesh(std::move(draft), wellbore);
  for (const Joint& joint : recipe.joints) mesh.set_of_joint.push_back(joint.set);
  mesh.joint_sets = recipe.joint_sets;
  if (mesh.joint_sets.empty() && !recipe.joints.empty()) mesh.joint_sets = {""};
  order_along_hilbert_curve(mesh);
  meshing::require_constraints(mesh, lines);
  if (report != nullptr) *report = network;
  return mesh;
}

}  // namespace crackle
