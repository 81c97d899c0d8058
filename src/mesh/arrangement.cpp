// SPDX-License-Identifier: GPL-3.0-or-later
// Where boundary, wellbore wall and joints meet. CGAL calculates crossings in rational numbers, which
// are rounded only at the end, and remembers which constraint each piece came from. (With rounded
// crossings it can lead a line through a far point where three lines nearly meet.)
#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Constrained_triangulation_plus_2.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <cmath>

#include "draft.hpp"
#include "wellbore.hpp"

namespace crackle::meshing {
namespace {

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<Index, Kernel>;
using FaceBase = CGAL::Constrained_triangulation_face_base_2<Kernel>;
using Structure = CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>;
using Delaunay = CGAL::Constrained_Delaunay_triangulation_2<Kernel, Structure, CGAL::Exact_intersections_tag>;
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

void add_line(Draft& draft, Vec2 from, Vec2 to, Line line, Index joint) {
  const Index first = static_cast<Index>(draft.points.size());
  draft.points.push_back(from);
  draft.points.push_back(to);
  draft.segments.push_back({{first, first + 1}, line, joint});
}

void add_loop(Draft& draft, const std::vector<Vec2>& loop, Line line) {
  for (std::size_t k = 0; k < loop.size(); ++k) {
    add_line(draft, loop[k], loop[(k + 1) % loop.size()], line, -1);
  }
}

/// Of the exact value: that of CGAL's interval would depend on how it was come by.
double rounded(const Kernel::FT& x) { return CGAL::to_double(CGAL::exact(x)); }

/// A crossing with the boundary is rounded: exactly on it, or a triangle without area would be outside.
void straighten_boundary(Draft& draft, double a, double b) {
  constexpr double round_off = 1e-12;
  for (const Segment& segment : draft.segments) {
    if (segment.line != Line::outer) continue;
    for (const Index v : segment.end) {
      Vec2& p = draft.points[v];
      if (std::abs(std::abs(p.x) - a) < round_off * a) p.x = std::copysign(a, p.x);
      if (std::abs(std::abs(p.y) - b) < round_off * b) p.y = std::copysign(b, p.y);
    }
  }
}

}  // namespace

void split_crossings(Draft& draft, const MeshRecipe& recipe) {
  Arrangement arrangement;
  std::vector<Arrangement::Constraint_id> inserted;
  std::vector<Segment> whole;
  for (const Segment& segment : draft.segments) {
    const Vec2 p = draft.points[segment.end[0]], q = draft.points[segment.end[1]];
    if (p == q) continue;
    inserted.push_back(arrangement.insert_constraint(Kernel::Point_2(p.x, p.y), Kernel::Point_2(q.x, q.y)));
    whole.push_back(segment);
  }
  draft.points.clear();
  for (auto v = arrangement.finite_vertices_begin(); v != arrangement.finite_vertices_end(); ++v) {
    v->info() = static_cast<Index>(draft.points.size());
    draft.points.push_back({rounded(v->point().x()), rounded(v->point().y())});
  }
  draft.segments.clear();
  for (std::size_t i = 0; i < whole.size(); ++i) {
    auto v = arrangement.vertices_in_constraint_begin(inserted[i]);
    for (auto w = std::next(v); w != arrangement.vertices_in_constraint_end(inserted[i]); v = w++) {
      draft.segments.push_back({{(*v)->info(), (*w)->info()}, whole[i].line, whole[i].joint});
    }
  }
  merge_equal(draft.segments);
  straighten_boundary(draft, 0.5 * recipe.width, 0.5 * recipe.height);
}

void drop_outside(Draft& draft, const MeshRecipe& recipe) {
  const double a = 0.5 * recipe.width, b = 0.5 * recipe.height;
  const std::vector<Vec2> wellbore = wellbore_polygon(recipe);
  std::erase_if(draft.segments, [&](const Segment& segment) {
    const Vec2 middle = 0.5 * (draft.points[segment.end[0]] + draft.points[segment.end[1]]);
    const bool outside = std::abs(middle.x) > a || std::abs(middle.y) > b;
    return segment.line == Line::joint && (outside || inside_polygon(wellbore, middle));
  });
  std::vector<Index> place(draft.points.size(), -1);
  for (const Segment& segment : draft.segments) {
    for (const Index v : segment.end) place[v] = 0;
  }
  Index kept = 0;
  for (std::size_t v = 0; v < draft.points.size(); ++v) {
    if (place[v] < 0) continue;
    draft.points[kept] = draft.points[v];
    place[v] = kept++;
  }
  draft.points.resize(kept);
  for (Segment& segment : draft.segments) {
    for (Index& v : segment.end) v = place[v];
  }
}

Draft arrange(const MeshRecipe& recipe) {
  const double a = 0.5 * recipe.width, b = 0.5 * recipe.height;
  Draft draft;
  add_loop(draft, {{-a, -b}, {a, -b}, {a, b}, {-a, b}}, Line::outer);
  add_loop(draft, wellbore_polygon(recipe), Line::wellbore);
  for (std::size_t j = 0; j < recipe.joints.size(); ++j) {
    add_line(draft, recipe.joints[j].from, recipe.joints[j].to, Line::joint, static_cast<Index>(j));
  }
  split_crossings(draft, recipe);
  drop_outside(draft, recipe);
  return draft;
}

}  // namespace crackle::meshing
