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

/// Overlapping lines gave the same piece twice: one stays, with the first line and lowest joint.
void merge_equal(std::vector<Segment>& segments) {
  const auto key = [](const Segment& s) {
    return std::pair(std::min(s.end[0], s.end[1]), std::max(s.end[0], s.end[1]));
  };
  std::stable_sort(segments.begin(), segments.end(),
                   [&](const Segment& s, const Segment& t) { return key(s) < key(t); });
  std::vector<Segment> merged;
  for (const Segment& segment : segments) {
    if (merged.empty() || key(merged.back()) != key(segment)) {
      merged.push_back(segment);
      continue;
    }
    Segment& kept = merged.back();
    kept.line = std::min(kept.line, segment.line);
    if (kept.joint < 0 || (segment.joint >= 0 && segment.joint < kept.joint)) kept.joint = segment.joint;
  }
  segments = std::move(merged);
}

}  // namespace

Draft arrange(const MeshRecipe& recipe) {
  struct Inserted {
    Arrangement::Constraint_id id;
    Line line;
    Index joint;
  };
  Arrangement arrangement;
  std::vector<Inserted> inserted;
  const auto insert = [&](Vec2 p, Vec2 q, Line line, Index joint) {
    const Kernel::Point_2 from(p.x, p.y), to(q.x, q.y);
    inserted.push_back({arrangement.insert_constraint(from, to), line, joint});
  };
  const auto insert_loop = [&](const std::vector<Vec2>& loop, Line line) {
    for (std::size_t k = 0; k < loop.size(); ++k) insert(loop[k], loop[(k + 1) % loop.size()], line, -1);
  };
  const double a = 0.5 * recipe.width, b = 0.5 * recipe.height;
  insert_loop({{-a, -b}, {a, -b}, {a, b}, {-a, b}}, Line::outer);
  insert_loop(wellbore_polygon(recipe), Line::wellbore);
  for (const Constraint& constraint : recipe.constraints) {
    insert(constraint.from, constraint.to, Line::constraint, constraint.joint);
  }

  Draft draft;
  for (auto v = arrangement.finite_vertices_begin(); v != arrangement.finite_vertices_end(); ++v) {
    v->info() = static_cast<Index>(draft.points.size());
    draft.points.push_back({v->point().x(), v->point().y()});
  }
  for (const auto& [id, line, joint] : inserted) {
    auto v = arrangement.vertices_in_constraint_begin(id);
    for (auto w = std::next(v); w != arrangement.vertices_in_constraint_end(id); v = w++) {
      draft.segments.push_back({{(*v)->info(), (*w)->info()}, line, joint});
    }
  }
  merge_equal(draft.segments);
  return draft;
}

}  // namespace crackle::meshing
