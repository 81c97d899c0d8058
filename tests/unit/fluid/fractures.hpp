// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "../../granite.hpp"

namespace crackle {

/// Cuts `count` elements one after another, from the vertex nearest to a point on along a direction.
/// @return the elements
inline std::vector<Index> cut_ray(State& state, const Cohesive& cohesive, Vec2 from, Vec2 along, int count) {
  using granite::at;
  const Mesh& mesh = *state.mesh;
  Index here = 0;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    if (norm(mesh.vertices[at(v)] - from) < norm(mesh.vertices[at(here)] - from)) here = v;
  }
  std::vector<Index> path;
  for (int i = 0; i < count; ++i) {
    Index best = -1, next = -1;
    double straightest = -2.0;
    for (Index element = 0; element < state.cohesive.count(); ++element) {
      const auto& v = mesh.edges[at(state.cohesive.edge[at(element)])].vertex;
      if (v[0] != here && v[1] != here) continue;
      const Index other = v[0] == here ? v[1] : v[0];
      const Vec2 d = mesh.vertices[at(other)] - mesh.vertices[at(here)];
      if (dot(d, along) / norm(d) > straightest)
        straightest = dot(d, along) / norm(d), best = element, next = other;
    }
    cohesive.cut(state, best);
    path.push_back(best);
    here = next;
  }
  return path;
}

}  // namespace crackle
