// SPDX-License-Identifier: GPL-3.0-or-later
#include "loops.hpp"

#include <algorithm>

namespace crackle {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

// Side `side` of a triangle is wetted if its edge is; both faces of an interior edge are.
Index cavity_of_side(const State& state, Index triangle, Index side) {
  return state.fluid.cavity_of_edge[at(state.mesh->triangle_edges[at(triangle)][at(side)])];
}

// Across a dry side: the side of the other triangle that starts at the same vertex, or -1 on a
// boundary. `corner` is where the side starts.
Index next_side_round_vertex(const Mesh& mesh, Index corner) {
  const Edge& edge = mesh.edges[at(mesh.triangle_edges[at(corner / 3)][at(corner % 3)])];
  const std::size_t other = edge.triangle[0] == corner / 3 ? 1 : 0;
  if (edge.triangle[other] < 0) return -1;
  return 3 * edge.triangle[other] + (edge.side[other] + 1) % 3;
}

// The wetted side at which the loop goes on after a side that ends at this corner: turning round
// the vertex through dry sides, out of the body and in again where an outer boundary is met.
Index next_wet_side(const State& state, Index corner, bool& leaks) {
  const Mesh& mesh = *state.mesh;
  const Index first = corner;
  for (;;) {
    if (cavity_of_side(state, corner / 3, corner % 3) >= 0) return corner;
    const Index next = next_side_round_vertex(mesh, corner);
    if (next >= 0) {
      corner = next;
      if (corner == first) return -1;
      continue;
    }
    // Outer boundary: go back round the vertex to its other boundary side.
    leaks = true;
    Index back = first;
    for (;;) {
      const Index side = 3 * (back / 3) + (back % 3 + 2) % 3;  // ends at the vertex
      const Edge& edge = mesh.edges[at(mesh.triangle_edges[at(back / 3)][at(side % 3)])];
      const std::size_t other = edge.triangle[0] == back / 3 ? 1 : 0;
      if (cavity_of_side(state, side / 3, side % 3) >= 0 || edge.triangle[other] < 0) return back;
      back = 3 * edge.triangle[other] + edge.side[other];
    }
  }
}

}  // namespace

std::vector<Fluid::Loop> wetted_loops(const State& state, bool& leaks) {
  const Mesh& mesh = *state.mesh;
  std::vector<Fluid::Loop> loops;
  std::vector<Index> sides;
  for (std::size_t e = 0; e < mesh.edges.size(); ++e) {
    if (state.fluid.cavity_of_edge[e] < 0) continue;
    for (std::size_t f = 0; f < 2; ++f) {
      if (mesh.edges[e].triangle[f] >= 0)
        sides.push_back(3 * mesh.edges[e].triangle[f] + mesh.edges[e].side[f]);
    }
  }
  std::sort(sides.begin(), sides.end());
  std::vector<char> visited(sides.size(), 0);
  const auto slot = [&](Index side) {
    const auto it = std::lower_bound(sides.begin(), sides.end(), side);
    return it != sides.end() && *it == side ? it - sides.begin() : std::ptrdiff_t{-1};
  };
  for (std::size_t s = 0; s < sides.size(); ++s) {
    if (visited[s]) continue;
    Fluid::Loop loop;
    loop.cavity = cavity_of_side(state, sides[s] / 3, sides[s] % 3);
    Index side = sides[s];
    while (side >= 0) {
      const std::ptrdiff_t k = slot(side);
      if (k < 0 || visited[static_cast<std::size_t>(k)]) break;
      visited[static_cast<std::size_t>(k)] = 1;
      const Index end = 3 * (side / 3) + (side % 3 + 1) % 3;
      loop.corners.push_back(side);  // a side starts at the corner of the same number
      loop.corners.push_back(end);
      side = next_wet_side(state, end, leaks);
    }
    loops.push_back(std::move(loop));
  }
  return loops;
}

}  // namespace crackle
