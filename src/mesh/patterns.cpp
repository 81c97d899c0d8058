// SPDX-License-Identifier: GPL-3.0-or-later
// Meshes of known shape for patch tests and benchmarks.
#include <algorithm>
#include <cmath>
#include <limits>

#include "crackle/core/errors.hpp"
#include "crackle/mesh/mesh.hpp"
#include "edge_marks.hpp"
#include "random.hpp"

namespace crackle {
namespace {

/// Rows of nx cells, every other row of vertices shifted by half a cell (with an extra vertex at its
/// end, so that the sides of the rectangle stay straight).
void fill_shifted(Mesh& mesh, Vec2 lower, Vec2 step, int nx, int ny) {
  std::vector<Index> below, row;
  for (int j = 0; j <= ny; ++j) {
    row.clear();
    const bool shifted = j % 2 == 1;
    for (int i = 0; i <= (shifted ? nx + 1 : nx); ++i) {
      const double column = shifted ? std::clamp(i - 0.5, 0.0, static_cast<double>(nx)) : i;
      row.push_back(mesh.vertex_count());
      mesh.vertices.push_back(lower + Vec2{column * step.x, j * step.y});
    }
    if (j > 0) {
      const auto& wide = shifted ? row : below;  // nx + 2 vertices
      const auto& narrow = shifted ? below : row;
      for (int i = 0; i <= nx; ++i) {
        mesh.triangles.push_back({wide[i], wide[i + 1], narrow[i]});
        if (i < nx) mesh.triangles.push_back({narrow[i], narrow[i + 1], wide[i + 1]});
      }
    }
    below = row;
  }
}

void fill_cells(Mesh& mesh, Vec2 lower, Vec2 step, int nx, int ny, bool cross_pattern) {
  for (int j = 0; j <= ny; ++j) {
    for (int i = 0; i <= nx; ++i) mesh.vertices.push_back(lower + Vec2{i * step.x, j * step.y});
  }
  for (int j = 0; j < ny; ++j) {
    for (int i = 0; i < nx; ++i) {
      const Index a = j * (nx + 1) + i, b = a + 1, d = a + nx + 1, c = d + 1;  // counter-clockwise
      if (cross_pattern) {
        const Index m = mesh.vertex_count();
        mesh.vertices.push_back(lower + Vec2{(i + 0.5) * step.x, (j + 0.5) * step.y});
        mesh.triangles.insert(mesh.triangles.end(), {{a, b, m}, {b, c, m}, {c, d, m}, {d, a, m}});
      } else {
        mesh.triangles.insert(mesh.triangles.end(), {{a, b, c}, {a, c, d}});
      }
    }
  }
}

}  // namespace

Mesh structured_rectangle(Vec2 lower, Vec2 upper, int nx, int ny, MeshPattern pattern) {
  if (nx < 1 || ny < 1 || !(upper.x > lower.x) || !(upper.y > lower.y)) {
    throw MeshError("a structured rectangle needs at least one cell each way and upper beyond lower");
  }
  const Vec2 step{(upper.x - lower.x) / nx, (upper.y - lower.y) / ny};
  Mesh mesh;
  if (pattern == MeshPattern::shifted_rows) {
    fill_shifted(mesh, lower, step, nx, ny);
  } else {
    fill_cells(mesh, lower, step, nx, ny, pattern == MeshPattern::cross);
  }
  build_edges(mesh);
  return mesh;
}

Mesh jittered(const Mesh& mesh, double fraction, std::uint64_t seed) {
  std::vector<double> shortest(mesh.vertices.size(), std::numeric_limits<double>::infinity());
  std::vector<bool> fixed(mesh.vertices.size(), false);
  for (const Edge& edge : mesh.edges) {
    const double length = norm(mesh.vertices[edge.vertex[1]] - mesh.vertices[edge.vertex[0]]);
    for (const Index v : edge.vertex) {
      shortest[v] = std::min(shortest[v], length);
      if (edge.triangle[1] < 0) fixed[v] = true;
    }
  }
  Mesh moved = mesh;
  meshing::Random random(seed);
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    Vec2 step;
    do {  // uniform in the unit circle
      step = {random.between(-1.0, 1.0), random.between(-1.0, 1.0)};
    } while (dot(step, step) > 1.0);
    if (!fixed[v]) moved.vertices[v] += fraction * shortest[v] * step;
  }
  build_edges(moved);
  meshing::apply_edge_marks(moved, meshing::edge_marks(mesh));
  return moved;
}

}  // namespace crackle
