// SPDX-License-Identifier: GPL-3.0-or-later
//
// The path of fractures over edges of an intact mesh, and the jumps of displacement across it.
//
// At a vertex the path cuts the fan of triangles into sectors. The displacement of a triangle T there is
//   u_T(P) = u_P + Σ_{k: T ∈ support of k} δ_k d_k
// with u_P that of the mesh without fractures. A new edge cuts one sector in two: one half gets new
// unknowns δ, and older unknowns keep their support, so that unknowns are only ever appended (kinks,
// branches and crossings alike).
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "crackle/mesh/mesh.hpp"

namespace crackle {

/// An unknown δ [m]: jump of displacement at a vertex, in a direction, of the triangles of one sector.
struct JumpUnknown {
  Index vertex = -1;
  Vec2 direction;
  std::vector<Index> triangles;  ///< sorted
  friend bool operator==(const JumpUnknown&, const JumpUnknown&) = default;
};

/// Share of an unknown in the opening and slip at an end of an edge: opening = Σ normal δ.
struct JumpTerm {
  Index unknown = -1;
  double normal = 0.0;
  double tangent = 0.0;
};

/// An edge of the path, directed from where the fluid comes from.
struct PathEdge {
  Index edge = -1;                      ///< of the mesh
  Index parent = -1;                    ///< path edge it was reached from; -1: from the well, -2: of a joint
  std::array<Index, 2> vertex{-1, -1};  ///< inner, outer
  Vec2 normal;                          ///< of the fracture, from face a to face b
  double length = 0.0;                  ///< of the fracture [m]
  double aperture = 0.0;                ///< between mated faces at no jump [m]
  std::array<std::vector<JumpTerm>, 2> jump;  ///< at the inner and the outer vertex
};

/// Components of displacement that are held at a vertex: bits, 1 for x, 2 for y.
using Held = std::vector<std::uint8_t>;

class FracturePath {
 public:
  /// @param slip false: faces only open (a straight path along a principal stress); one unknown a vertex
  FracturePath(std::shared_ptr<const Mesh> mesh, Held held, bool slip);

  /// Appends a mesh edge that leaves `inner`. @param along piece of a smooth fracture that it stands for,
  /// from its inner end to its outer one [m]; zero: the edge itself @return its number on the path
  Index add(Index edge, Index inner, Index parent, double aperture = 0.0, Vec2 along = {});
  /// Takes back the last edges, so that `count` are left.
  void truncate(std::size_t count);

  const Mesh& mesh() const { return *mesh_; }
  const std::vector<PathEdge>& edges() const { return edges_; }
  const std::vector<JumpUnknown>& unknowns() const { return unknowns_; }
  /// Path edges at a vertex.
  std::vector<Index> at_vertex(Index vertex) const;
  /// A mesh edge is on the path.
  bool holds(Index edge) const { return on_path_[static_cast<std::size_t>(edge)] != 0; }
  /// Triangles round a vertex.
  std::vector<Index> fan(Index vertex) const;
  /// The same in the sectors that the path cuts them into.
  std::vector<std::vector<Index>> sectors(Index vertex) const;
  /// Mesh edges that end at a vertex.
  std::vector<Index> mesh_edges_at(Index vertex) const;

 private:
  void split(Index vertex, Vec2 normal);
  void renew_jumps(Index vertex);

  std::shared_ptr<const Mesh> mesh_;
  Held held_;
  bool slip_;
  std::vector<Index> first_, triangles_;  // vertex -> triangles
  std::vector<char> on_path_;
  std::vector<PathEdge> edges_;
  std::vector<JumpUnknown> unknowns_;
  std::vector<std::size_t> unknowns_before_;  // per edge: unknowns when it was added
};

}  // namespace crackle
