// SPDX-License-Identifier: GPL-3.0-or-later
// Kinds and joints of edges, carried over a rebuild of the edges.
#include "edge_marks.hpp"

namespace crackle::meshing {

std::vector<EdgeMark> edge_marks(const Mesh& mesh) {
  std::vector<EdgeMark> marks;
  for (const Edge& edge : mesh.edges) {
    if (edge.joint >= 0 || edge.kind == EdgeKind::wellbore) {
      marks.push_back({edge.vertex, edge.kind, edge.joint});
    }
  }
  return marks;
}

VertexEdges vertex_edges(const Mesh& mesh) {
  VertexEdges around;
  around.begin.assign(mesh.vertices.size() + 1, 0);
  for (const Edge& edge : mesh.edges) {
    for (const Index v : edge.vertex) ++around.begin[v + 1];
  }
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) around.begin[v + 1] += around.begin[v];
  around.edges.resize(2 * mesh.edges.size());
  std::vector<Index> next(around.begin.begin(), around.begin.end() - 1);
  for (Index e = 0; e < mesh.edge_count(); ++e) {
    for (const Index v : mesh.edges[e].vertex) around.edges[next[v]++] = e;
  }
  return around;
}

std::vector<EdgeMark> apply_edge_marks(Mesh& mesh, const std::vector<EdgeMark>& marks) {
  std::vector<EdgeMark> missing;
  if (marks.empty()) return missing;
  const VertexEdges around = vertex_edges(mesh);
  for (const EdgeMark& mark : marks) {
    const auto [v, w] = mark.vertex;
    bool found = false;
    for (Index i = around.begin[v]; i < around.begin[v + 1] && !found; ++i) {
      Edge& edge = mesh.edges[around.edges[i]];
      if (edge.vertex[0] != w && edge.vertex[1] != w) continue;
      found = true;
      if (mark.joint >= 0) edge.joint = mark.joint;
      if (mark.kind == EdgeKind::wellbore && edge.kind == EdgeKind::outer) edge.kind = EdgeKind::wellbore;
    }
    if (!found) missing.push_back(mark);
  }
  return missing;
}

}  // namespace crackle::meshing
