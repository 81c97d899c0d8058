// SPDX-License-Identifier: GPL-3.0-or-later
// The constrained Delaunay triangulation: of all triangulations that hold the segments, the one
// whose smallest angle is largest.
#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include "crackle/core/errors.hpp"
#include "draft.hpp"

namespace crackle::meshing {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<Index, Kernel>;
using FaceBase = CGAL::Constrained_triangulation_face_base_2<Kernel>;
using Structure = CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>;
using Delaunay =
    CGAL::Constrained_Delaunay_triangulation_2<Kernel, Structure,
                                               CGAL::No_constraint_intersection_requiring_constructions_tag>;

}  // namespace

void triangulate(Draft& draft) {
  Delaunay delaunay;
  std::vector<Delaunay::Vertex_handle> vertex(draft.points.size());
  Delaunay::Face_handle near;
  for (std::size_t i = 0; i < draft.points.size(); ++i) {
    vertex[i] = delaunay.insert({draft.points[i].x, draft.points[i].y}, near);
    vertex[i]->info() = static_cast<Index>(i);
    near = vertex[i]->face();
  }
  try {
    for (const Segment& segment : draft.segments) {
      delaunay.insert_constraint(vertex[segment.end[0]], vertex[segment.end[1]]);
    }
  } catch (const Delaunay::Intersection_of_constraints_exception&) {
    throw MeshError("two constraints cross so closely that they cannot be told apart: simplify the joints");
  }
  if (delaunay.number_of_vertices() != draft.points.size()) {
    throw MeshError("two constraints end at nearly the same point: simplify the joints");
  }
  draft.triangles.clear();
  draft.triangles.reserve(delaunay.number_of_faces());
  for (auto f = delaunay.finite_faces_begin(); f != delaunay.finite_faces_end(); ++f) {
    draft.triangles.push_back({f->vertex(0)->info(), f->vertex(1)->info(), f->vertex(2)->info()});
  }
}

}  // namespace crackle::meshing
