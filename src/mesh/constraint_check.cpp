// SPDX-License-Identifier: GPL-3.0-or-later
// Every joint has to be a chain of edges: a generator may drop one without a word.
#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "crackle/core/errors.hpp"
#include "draft.hpp"
#include "edge_marks.hpp"

namespace crackle::meshing {
namespace {

/// Vertices sorted by x, to find the one at a place.
class VertexFinder {
 public:
  explicit VertexFinder(const std::vector<Vec2>& vertices) : vertices_(vertices), order_(vertices.size()) {
    std::iota(order_.begin(), order_.end(), 0);
    std::sort(order_.begin(), order_.end(),
              [&](Index a, Index b) { return vertices_[a].x < vertices_[b].x; });
  }
  Index at(Vec2 place, double tolerance) const {
    auto v = std::lower_bound(order_.begin(), order_.end(), place.x - tolerance,
                              [&](Index i, double x) { return vertices_[i].x < x; });
    for (; v != order_.end() && vertices_[*v].x <= place.x + tolerance; ++v) {
      if (norm(vertices_[*v] - place) <= tolerance) return *v;
    }
    return -1;
  }

 private:
  const std::vector<Vec2>& vertices_;
  std::vector<Index> order_;
};

}  // namespace

void require_constraints(const Mesh& mesh, const std::vector<Constraint>& constraints) {
  if (constraints.empty()) return;
  const VertexFinder finder(mesh.vertices);
  const VertexEdges around = vertex_edges(mesh);
  for (const Constraint& constraint : constraints) {
    const Vec2 from = constraint.from, to = constraint.to;
    const double length = norm(to - from);
    const double tolerance = 1e-9 * std::max({length, norm(from), norm(to)});
    const Vec2 along = (1.0 / length) * (to - from);
    const Index last = finder.at(to, tolerance);
    Index here = finder.at(from, tolerance);
    while (here >= 0 && here != last) {
      Index next = -1;
      for (Index i = around.begin[here]; i < around.begin[here + 1]; ++i) {
        const Edge& edge = mesh.edges[around.edges[i]];
        const Index other = edge.vertex[0] == here ? edge.vertex[1] : edge.vertex[0];
        const Vec2 at = mesh.vertices[other] - from;
        const bool ahead = dot(at, along) > dot(mesh.vertices[here] - from, along);
        if (ahead && std::abs(cross(along, at)) <= tolerance && (!constraint.joint || edge.joint >= 0)) {
          next = other;
        }
      }
      if (next < 0) break;
      here = next;
    }
    if (here < 0 || here != last) {
      const Vec2 lost = here < 0 ? from : mesh.vertices[here];
      throw MeshError(
          fmt::format("the {} from ({:.6g}, {:.6g}) m to ({:.6g}, {:.6g}) m is not in the mesh beyond "
                      "({:.6g}, {:.6g}) m: move it away from its neighbours, or use the other generator",
                      constraint.joint ? "joint" : "wall", from.x, from.y, to.x, to.y, lost.x, lost.y));
    }
  }
}

}  // namespace crackle::meshing
