// SPDX-License-Identifier: GPL-3.0-or-later
#include "crackle/mesh/grid.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "crackle/core/errors.hpp"

namespace crackle {

std::vector<double> graded_line(double from, double fine_end, double to, const Grading& grading) {
  const double step = grading.step, ratio = grading.ratio;
  if (!(step > 0.0) || !(ratio >= 1.0) || !(fine_end >= from) || !(to >= fine_end))
    throw MeshError("graded line: needs step > 0, ratio >= 1 and from <= fine_end <= to");
  const auto fine = static_cast<int>(std::round((fine_end - from) / step));
  std::vector<double> line;
  for (int i = 0; i <= fine; ++i) line.push_back(from + (fine_end - from) * i / std::max(fine, 1));
  std::vector<double> steps;
  double reach = 0.0;
  for (double s = std::min(step * ratio, grading.largest); reach < (to - fine_end) * (1.0 - 1e-12);
       s = std::min(s * ratio, grading.largest)) {
    steps.push_back(s);
    reach += s;
  }
  const double stretch = steps.empty() ? 1.0 : (to - fine_end) / reach;
  double x = line.back();
  for (const double s : steps) line.push_back(x += s * stretch);
  return line;
}

Mesh grid_rectangle(std::span<const double> x, std::span<const double> y, double crossed) {
  const auto increasing = [](std::span<const double> a) {
    return a.size() > 1 && std::adjacent_find(a.begin(), a.end(), std::greater_equal<>()) == a.end();
  };
  if (!increasing(x) || !increasing(y)) throw MeshError("grid: coordinates have to increase");
  Mesh mesh;
  for (const double b : y) {
    for (const double a : x) mesh.vertices.push_back({a, b});
  }
  const auto nx = static_cast<Index>(x.size());
  for (Index j = 0; j + 1 < static_cast<Index>(y.size()); ++j) {
    for (Index i = 0; i + 1 < nx; ++i) {
      const Index a = j * nx + i, b = a + 1, d = a + nx, c = d + 1;
      const Vec2 low = mesh.vertices[static_cast<std::size_t>(a)],
                 high = mesh.vertices[static_cast<std::size_t>(c)];
      if (std::max(std::abs(low.y), std::abs(high.y)) < crossed * (1.0 + 1e-9)) {
        const Index m = mesh.vertex_count();
        mesh.vertices.push_back(0.5 * (low + high));
        mesh.triangles.insert(mesh.triangles.end(), {{a, b, m}, {b, c, m}, {c, d, m}, {d, a, m}});
      } else if ((i + j) % 2 == 0) {
        mesh.triangles.insert(mesh.triangles.end(), {{a, b, c}, {a, c, d}});
      } else {
        mesh.triangles.insert(mesh.triangles.end(), {{a, b, d}, {b, c, d}});
      }
    }
  }
  mesh.regions.assign(mesh.triangles.size(), Region::rock);
  build_edges(mesh);
  return mesh;
}

std::vector<Index> edges_along(const Mesh& mesh, Vec2 from, Vec2 to) {
  const Vec2 span = to - from;
  const double length = norm(span);
  const double tolerance = 1e-6 * length;
  const auto place = [&](Index v) {  // along the segment, or -1 when not on it
    const Vec2 r = mesh.vertices[static_cast<std::size_t>(v)] - from;
    const double s = dot(r, span) / length;
    const bool on =
        std::abs(cross(r, span)) <= tolerance * length && s >= -tolerance && s <= length + tolerance;
    return on ? std::max(s, 0.0) : -1.0;
  };
  struct Piece {
    double begin, end;
    Index edge;
  };
  std::vector<Piece> pieces;
  for (Index e = 0; e < mesh.edge_count(); ++e) {
    const Edge& edge = mesh.edges[static_cast<std::size_t>(e)];
    if (edge.triangle[1] < 0) continue;
    const double a = place(edge.vertex[0]), b = place(edge.vertex[1]);
    if (a >= 0.0 && b >= 0.0) pieces.push_back({std::min(a, b), std::max(a, b), e});
  }
  std::sort(pieces.begin(), pieces.end(), [](const Piece& a, const Piece& b) { return a.begin < b.begin; });
  std::vector<Index> edges;
  double reach = 0.0;
  for (const Piece& piece : pieces) {
    if (std::abs(piece.begin - reach) > tolerance) break;
    reach = piece.end;
    edges.push_back(piece.edge);
  }
  if (std::abs(reach - length) > tolerance)
    throw MeshError(fmt::format("no edges of the mesh along the path from ({:g}, {:g}) to ({:g}, {:g}) m",
                                from.x, from.y, to.x, to.y));
  return edges;
}

}  // namespace crackle
