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

meshing::Draft make_draft(const MeshRecipe& recipe) {
  if (recipe.generator == "cgal") return meshing::make_cgal_draft(recipe);
  if (recipe.generator == "gmsh") return meshing::make_gmsh_draft(recipe);
  throw MeshError(
      fmt::format("there is no mesh generator \"{}\": use \"cgal\" or \"gmsh\"", recipe.generator));
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

Mesh generate_mesh(const MeshRecipe& recipe) {
  meshing::check_recipe(recipe);
  const std::vector<Vec2> wellbore = meshing::wellbore_polygon(recipe);
  Mesh mesh = to_mesh(make_draft(recipe), wellbore);
  order_along_hilbert_curve(mesh);

  std::vector<Constraint> present = recipe.constraints;
  for (std::size_t k = 0; k < wellbore.size(); ++k) {
    present.push_back({wellbore[k], wellbore[(k + 1) % wellbore.size()], -1});
  }
  meshing::require_constraints(mesh, present);
  return mesh;
}

}  // namespace crackle
