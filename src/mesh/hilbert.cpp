// SPDX-License-Identifier: GPL-3.0-or-later
// Neighbours in the plane become neighbours in memory, by the curve of Hilbert (1891).
#include "hilbert.hpp"

#include <algorithm>
#include <numeric>

#include "edge_marks.hpp"

namespace crackle {
namespace {

constexpr std::uint32_t levels = 24;  // 2^24 cells a side: finer than any mesh

/// Place of the cell (x, y) along the Hilbert curve through 2^levels x 2^levels cells.
std::uint64_t hilbert_index(std::uint32_t x, std::uint32_t y) {
  std::uint64_t index = 0;
  for (std::uint32_t half = 1u << (levels - 1); half > 0; half >>= 1) {
    const bool right = (x & half) != 0, upper = (y & half) != 0;
    index = 4 * index + (right ? (upper ? 2u : 3u) : (upper ? 1u : 0u));
    if (!upper) {  // the lower quadrants run transposed, the right one from the far end
      if (right) {
        x = ~x & (2 * half - 1);
        y = ~y & (2 * half - 1);
      }
      std::swap(x, y);
    }
  }
  return index;
}

}  // namespace

std::vector<Index> meshing::hilbert_order(const std::vector<Vec2>& points) {
  if (points.empty()) return {};
  Vec2 lower = points.front(), upper = lower;
  for (const Vec2 p : points) {
    lower = {std::min(lower.x, p.x), std::min(lower.y, p.y)};
    upper = {std::max(upper.x, p.x), std::max(upper.y, p.y)};
  }
  constexpr double last_cell = static_cast<double>((1u << levels) - 1);
  const double cells = last_cell / std::max({upper.x - lower.x, upper.y - lower.y, 1e-300});
  const auto cell = [&](double distance) {
    return static_cast<std::uint32_t>(std::clamp(distance * cells, 0.0, last_cell));
  };
  std::vector<std::uint64_t> key;
  key.reserve(points.size());
  for (const Vec2 p : points) key.push_back(hilbert_index(cell(p.x - lower.x), cell(p.y - lower.y)));

  std::vector<Index> order(points.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
            [&](Index a, Index b) { return key[a] != key[b] ? key[a] < key[b] : a < b; });
  return order;
}

void order_along_hilbert_curve(Mesh& mesh) {
  if (mesh.triangles.empty()) return;
  std::vector<meshing::EdgeMark> marks = meshing::edge_marks(mesh);

  std::vector<Vec2> centroids;
  centroids.reserve(mesh.triangles.size());
  for (const auto& [p, q, r] : mesh.triangles) {
    centroids.push_back((1.0 / 3.0) * (mesh.vertices[p] + mesh.vertices[q] + mesh.vertices[r]));
  }
  std::vector<std::array<Index, 3>> triangles;
  std::vector<Region> regions;
  triangles.reserve(mesh.triangles.size());
  regions.reserve(mesh.triangles.size());
  for (const Index t : meshing::hilbert_order(centroids)) {
    triangles.push_back(mesh.triangles[t]);
    regions.push_back(mesh.regions[t]);
  }

  std::vector<Index> new_index(mesh.vertices.size(), -1);
  std::vector<Vec2> vertices;
  vertices.reserve(mesh.vertices.size());
  const auto number = [&](Index v) {
    if (new_index[v] < 0) {
      new_index[v] = static_cast<Index>(vertices.size());
      vertices.push_back(mesh.vertices[v]);
    }
    return new_index[v];
  };
  for (auto& triangle : triangles) {
    for (Index& v : triangle) v = number(v);
  }
  for (Index v = 0; v < mesh.vertex_count(); ++v) number(v);  // unused vertices, if any, come last
  for (auto& mark : marks) {
    for (Index& v : mark.vertex) v = new_index[v];
  }

  mesh.vertices = std::move(vertices);
  mesh.triangles = std::move(triangles);
  mesh.regions = std::move(regions);
  build_edges(mesh);
  meshing::apply_edge_marks(mesh, marks);
}

}  // namespace crackle
