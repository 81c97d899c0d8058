// SPDX-License-Identifier: GPL-3.0-or-later
// The edges of a triangulation, numbered by the first triangle that has them.
#include <fmt/format.h>

#include <algorithm>

#include "crackle/core/errors.hpp"
#include "crackle/mesh/mesh.hpp"

namespace crackle {
namespace {

/// Twice the area over the square of the longest side, below which a triangle counts as degenerate.
constexpr double flat = 1e-12;

void orient(Mesh& mesh, Index t) {
  auto& corner = mesh.triangles[t];
  for (const Index v : corner) {
    if (v < 0 || v >= mesh.vertex_count()) {
      throw MeshError(
          fmt::format("triangle {} has vertex {}, but the mesh has {} vertices", t, v, mesh.vertex_count()));
    }
  }
  const Vec2 p = mesh.vertices[corner[0]], q = mesh.vertices[corner[1]], r = mesh.vertices[corner[2]];
  const double doubled_area = cross(q - p, r - p);
  const double longest = std::max({dot(q - p, q - p), dot(r - q, r - q), dot(p - r, p - r)});
  if (!(std::abs(doubled_area) > flat * longest)) {
    throw MeshError(fmt::format(
        "triangle {} at ({:.6g}, {:.6g}) m is degenerate (no area): repair or refine the mesh", t, p.x, p.y));
  }
  if (doubled_area < 0.0) std::swap(corner[1], corner[2]);
}

[[noreturn]] void refuse_edge(const Mesh& mesh, Index v, Index w, const char* what) {
  const Vec2 p = mesh.vertices[v], q = mesh.vertices[w];
  throw MeshError(
      fmt::format("the edge from ({:.6g}, {:.6g}) m to ({:.6g}, {:.6g}) m {}: the triangles overlap", p.x,
                  p.y, q.x, q.y, what));
}

}  // namespace

void build_edges(Mesh& mesh) {
  const Index triangle_count = mesh.triangle_count();
  if (mesh.regions.size() != mesh.triangles.size()) mesh.regions.resize(mesh.triangles.size(), Region::rock);
  mesh.edges.clear();
  // Euler: as many as vertices and triangles, less one and more one a hole.
  mesh.edges.reserve(mesh.vertices.size() + mesh.triangles.size() + 16);
  mesh.triangle_edges.assign(mesh.triangles.size(), {-1, -1, -1});

  // Edges that share their lower vertex are chained in a list: it is some three edges long.
  std::vector<Index> first(mesh.vertices.size(), -1);
  std::vector<Index> next;
  next.reserve(mesh.edges.capacity());

  for (Index t = 0; t < triangle_count; ++t) {
    orient(mesh, t);
    for (int side = 0; side < 3; ++side) {
      const Index v = mesh.triangles[t][side], w = mesh.triangles[t][(side + 1) % 3];
      const Index low = std::min(v, w);
      Index e = first[low];
      while (e >= 0 && mesh.edges[e].vertex != std::array{w, v}) {
        if (mesh.edges[e].vertex == std::array{v, w}) {
          refuse_edge(mesh, v, w, "has two triangles on the same side");
        }
        e = next[e];
      }
      if (e < 0) {
        e = mesh.edge_count();
        Edge edge;
        edge.vertex = {v, w};
        edge.triangle = {t, -1};
        edge.side = {static_cast<std::int8_t>(side), -1};
        edge.kind = EdgeKind::outer;
        mesh.edges.push_back(edge);
        next.push_back(first[low]);
        first[low] = e;
      } else {
        Edge& edge = mesh.edges[e];
        if (edge.triangle[1] >= 0) refuse_edge(mesh, v, w, "has more than two triangles");
        edge.triangle[1] = t;
        edge.side[1] = static_cast<std::int8_t>(side);
        edge.kind = EdgeKind::interior;
      }
      mesh.triangle_edges[t][side] = e;
    }
  }
}

}  // namespace crackle
