// SPDX-License-Identifier: GPL-3.0-or-later
// Delaunay refinement after a size field (Ruppert 1995, Shewchuk 2002, as in CGAL's Mesh_2): the
// circumcentre of a triangle that is too big or too sharp becomes a point, until none is left.
#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Constrained_triangulation_plus_2.h>
#include <CGAL/Delaunay_mesh_face_base_2.h>
#include <CGAL/Delaunay_mesher_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>

#include "draft.hpp"
#include "random.hpp"
#include "recipe.hpp"

namespace crackle::meshing {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<Index, Kernel>;
using FaceBase = CGAL::Delaunay_mesh_face_base_2<Kernel>;
using Structure = CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>;
using Delaunay = CGAL::Constrained_Delaunay_triangulation_2<Kernel, Structure, CGAL::Exact_predicates_tag>;
using Triangulation = CGAL::Constrained_triangulation_plus_2<Delaunay>;
using Point = Kernel::Point_2;

Vec2 from_cgal(const Point& p) { return {p.x(), p.y()}; }

/// The longest edge may be this many times the wanted size. Refinement makes edges of some 0.5 to
/// 1 times its bound; with this factor their mean is the wanted size (tests hold it to 10 %).
constexpr double longest_over_wanted = 1.45;
/// sin^2 of the smallest angle asked for, 20.7 degrees: up to there refinement provably ends.
constexpr double smallest_sine2 = 0.125;

/// When a triangle has to be refined. A triangle that is too big counts as IMPERATIVELY_BAD, one
/// that is only too sharp as BAD: so refinement also ends where constraints meet at a sharp angle.
class Criteria {
 public:
  struct Quality {
    double sine2 = 1.0;                           ///< sin^2 of the smallest angle
    double size2 = 0.0;                           ///< (longest edge over its bound)^2
    bool operator<(const Quality& other) const {  // the most urgent first
      const bool big = size2 > 1.0, other_big = other.size2 > 1.0;
      if (big != other_big) return big;
      return big ? size2 > other.size2 : sine2 < other.sine2;
    }
  };

  class Is_bad {
   public:
    explicit Is_bad(const SizeField* size) : size_(size) {}
    CGAL::Mesh_2::Face_badness operator()(const Quality& quality) const {
      if (quality.size2 > 1.0) return CGAL::Mesh_2::IMPERATIVELY_BAD;
      return quality.sine2 < smallest_sine2 ? CGAL::Mesh_2::BAD : CGAL::Mesh_2::NOT_BAD;
    }
    CGAL::Mesh_2::Face_badness operator()(const Triangulation::Face_handle& face, Quality& quality) const {
      const Vec2 p = from_cgal(face->vertex(0)->point()), q = from_cgal(face->vertex(1)->point()),
                 r = from_cgal(face->vertex(2)->point());
      std::array<double, 3> square{dot(q - p, q - p), dot(r - q, r - q), dot(p - r, p - r)};
      std::sort(square.begin(), square.end());
      const double bound = longest_over_wanted * (*size_)((1.0 / 3.0) * (p + q + r));
      const double doubled_area = cross(q - p, r - p);
      quality.size2 = square[2] / (bound * bound);
      quality.sine2 = doubled_area * doubled_area / (square[1] * square[2]);
      return (*this)(quality);
    }

   private:
    const SizeField* size_;
  };

  explicit Criteria(const SizeField& size) : size_(&size) {}
  Is_bad is_bad_object() const { return Is_bad(size_); }

 private:
  const SizeField* size_;
};

/// True when a new point would keep its distance from all points and out of the way of segments:
/// a point inside the circle over a segment makes refinement cut the segment.
bool fits(const Triangulation& triangulation, const Point& point, double distance) {
  std::vector<Triangulation::Face_handle> hit;
  triangulation.get_conflicts(point, std::back_inserter(hit));
  for (const auto& face : hit) {
    for (int i = 0; i < 3; ++i) {
      const auto v = face->vertex(i);
      if (triangulation.is_infinite(v)) return false;
      if (CGAL::squared_distance(point, v->point()) < distance * distance) return false;
      if (face->is_constrained(i) &&
          CGAL::angle(face->vertex(Triangulation::cw(i))->point(), point,
                      face->vertex(Triangulation::ccw(i))->point()) != CGAL::ACUTE) {
        return false;
      }
    }
  }
  return !hit.empty();
}

/// A row of points on both sides of every segment, near-equilateral with it: keeps the circles
/// over the segments free, so that refinement need not cut them.
void insert_rows_along_segments(Triangulation& triangulation, const Draft& draft) {
  for (const Segment& segment : draft.segments) {
    const Vec2 p = draft.points[segment.end[0]], q = draft.points[segment.end[1]];
    const Vec2 up = 0.87 * right_normal(q - p);
    for (const Vec2 apex : {0.5 * (p + q) + up, 0.5 * (p + q) - up}) {
      const Point point(apex.x, apex.y);
      if (fits(triangulation, point, 0.7 * norm(q - p))) triangulation.insert(point);
    }
  }
}

/// One random point in every square of a quadtree whose squares are a few edges wide. Refinement
/// goes on from there, so another seed gives quite another mesh.
void insert_random_points(Triangulation& triangulation, const SizeField& size, Random& random, Vec2 centre,
                          double width) {
  constexpr double edges_per_square = 4.0;
  const double wanted = size(centre);
  if (width > edges_per_square * wanted) {
    for (const double y : {-0.25, 0.25}) {
      for (const double x : {-0.25, 0.25}) {
        insert_random_points(triangulation, size, random, centre + Vec2{x * width, y * width}, 0.5 * width);
      }
    }
    return;
  }
  const double x = centre.x + width * random.between(-0.5, 0.5);
  const double y = centre.y + width * random.between(-0.5, 0.5);
  if (fits(triangulation, Point(x, y), size({x, y}))) triangulation.insert(Point(x, y));
}

}  // namespace

void refine(Draft& draft, const SizeField& size, std::uint64_t seed) {
  Triangulation triangulation;
  std::vector<Triangulation::Vertex_handle> vertex;
  Vec2 upper;
  for (const Vec2 p : draft.points) {
    vertex.push_back(triangulation.insert(Point(p.x, p.y)));
    upper = {std::max(upper.x, p.x), std::max(upper.y, p.y)};
  }
  std::vector<std::pair<Triangulation::Constraint_id, Index>> inserted;
  for (const Segment& segment : draft.segments) {
    inserted.emplace_back(triangulation.insert_constraint(vertex[segment.end[0]], vertex[segment.end[1]]),
                          segment.joint);
  }
  insert_rows_along_segments(triangulation, draft);
  Random random(seed);
  insert_random_points(triangulation, size, random, {0.0, 0.0}, 2.0 * std::max(upper.x, upper.y));

  const std::vector<Point> no_holes;
  CGAL::refine_Delaunay_mesh_2(triangulation, no_holes.begin(), no_holes.end(), Criteria(size));

  draft = {};
  for (auto v = triangulation.finite_vertices_begin(); v != triangulation.finite_vertices_end(); ++v) {
    v->info() = static_cast<Index>(draft.points.size());
    draft.points.push_back(from_cgal(v->point()));
  }
  for (const auto& [id, joint] : inserted) {
    auto v = triangulation.vertices_in_constraint_begin(id);
    for (auto w = std::next(v); w != triangulation.vertices_in_constraint_end(id); v = w++) {
      draft.segments.push_back({{(*v)->info(), (*w)->info()}, joint});
    }
  }
  for (auto f = triangulation.finite_faces_begin(); f != triangulation.finite_faces_end(); ++f) {
    draft.triangles.push_back({f->vertex(0)->info(), f->vertex(1)->info(), f->vertex(2)->info()});
  }
}

Draft make_cgal_draft(const MeshRecipe& recipe) {
  const SizeField size(recipe);
  Draft draft = arrange(recipe);
  subdivide(draft, size);
  refine(draft, size, recipe.seed);
  smooth(draft, size);
  return draft;
}

}  // namespace crackle::meshing
