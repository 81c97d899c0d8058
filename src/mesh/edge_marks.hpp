// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "crackle/mesh/mesh.hpp"

namespace crackle::meshing {

/// What an edge carries besides its topology, named by its end vertices.
struct EdgeMark {
  std::array<Index, 2> vertex{-1, -1};
  EdgeKind kind = EdgeKind::interior;  ///< wellbore, or what build_edges() finds
  Index joint = -1;
};

/// The marks of all edges that build_edges() alone would not restore.
std::vector<EdgeMark> edge_marks(const Mesh& mesh);

/// Puts marks on the edges of a mesh, after build_edges(). A mark of kind wellbore only goes to an
/// edge with one triangle. @returns marks that are no edge of the mesh
std::vector<EdgeMark> apply_edge_marks(Mesh& mesh, const std::vector<EdgeMark>& marks);

/// The edges round each vertex, as offsets into one list.
struct VertexEdges {
  std::vector<Index> begin;  ///< of vertex v: from begin[v] to begin[v + 1]
  std::vector<Index> edges;
};
VertexEdges vertex_edges(const Mesh& mesh);

}  // namespace crackle::meshing
