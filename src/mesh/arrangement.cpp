// SPDX-License-Identifier: GPL-3.0-or-later
// Where boundary, wellbore wall and constraints meet. CGAL decides by exact predicates which
// segments cross, and remembers which constraint each piece came from.
#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Constrained_triangulation_plus_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>

#include "draft.hpp"
#include "wellbore.hpp"

namespace crackle::meshing {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<Index, Kernel>;
using FaceBase = CGAL::Constrained_triangulation_face_base_2<Kernel>;
using Structure = CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>;
using Delaunay = CGAL::Constrained_Delaunay_triangulation_2<Kernel, Structure, CGAL::Exact_predicates_tag>;
using Arrangement = CGAL::Constrained_triangulation_plus_2<Delaunay>;

Kernel::Point_2 to_cgal(Vec2 p) { return {p.x, p.y}; }

}  // namespace

Draft arrange(const MeshRecipe& recipe) {
  Arrangement arrangement;
  std::vector<std::pair<Arrangement::Constraint_id, Index>> inserted;
  const auto insert = [&](Vec2 p, Vec2 q, Index joint) {
    inserted.emplace_back(arrangement.insert_constraint(to_cgal(p), to_cgal(q)), joint);
  };
  const auto insert_loop = [&](const std::vector<Vec2>& loop) {
    for (std::size_t k = 0; k < loop.size(); ++k) insert(loop[k], loop[(k + 1) % loop.size()], -1);
  };
  const double a = 0.5 * recipe.width, b = 0.5 * recipe.height;
  insert_loop({{-a, -b}, {a, -b}, {a, b}, {-a, b}});
  insert_loop(wellbore_polygon(recipe));
  for (const Constraint& constraint : recipe.constraints) {
    insert(constraint.from, constraint.to, constraint.joint);
  }

  Draft draft;
  for (auto v = arrangement.finite_vertices_begin(); v != arrangement.finite_vertices_end(); ++v) {
    v->info() = static_cast<Index>(draft.points.size());
    draft.points.push_back({v->point().x(), v->point().y()});
  }
  for (const auto& [id, joint] : inserted) {
    auto v = arrangement.vertices_in_constraint_begin(id);
    for (auto w = std::next(v); w != arrangement.vertices_in_constraint_end(id); v = w++) {
      draft.segments.push_back({{(*v)->info(), (*w)->info()}, joint});
    }
  }

  // Overlapping constraints gave the same piece twice: keep the one of the lowest joint, if any.
  const auto key = [](const Segment& s) { return std::minmax(s.end[0], s.end[1]); };
  const auto rank = [](const Segment& s) { return static_cast<std::uint32_t>(s.joint); };  // -1 comes last
  std::stable_sort(draft.segments.begin(), draft.segments.end(), [&](const Segment& s, const Segment& t) {
    const auto ks = std::pair<Index, Index>(key(s)), kt = std::pair<Index, Index>(key(t));
    return ks != kt ? ks < kt : rank(s) < rank(t);
  });
  const auto same = [&](const Segment& s, const Segment& t) {
    return std::pair<Index, Index>(key(s)) == std::pair<Index, Index>(key(t));
  };
  draft.segments.erase(std::unique(draft.segments.begin(), draft.segments.end(), same), draft.segments.end());
  return draft;
}

}  // namespace crackle::meshing
