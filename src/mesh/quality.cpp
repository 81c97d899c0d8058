// SPDX-License-Identifier: GPL-3.0-or-later
// How well shaped the triangles are, and how well edges meet their target length.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "crackle/core/errors.hpp"
#include "crackle/mesh/mesh.hpp"

namespace crackle {
namespace {

constexpr double most_over_target = 3.0;

double smallest_angle(const Mesh& mesh, Index t) {
  const auto& corner = mesh.triangles[t];
  double smallest = std::numbers::pi;
  for (int i = 0; i < 3; ++i) {
    const Vec2 p = mesh.vertices[corner[i]];
    const Vec2 u = mesh.vertices[corner[(i + 1) % 3]] - p, w = mesh.vertices[corner[(i + 2) % 3]] - p;
    smallest = std::min(smallest, std::atan2(std::abs(cross(u, w)), dot(u, w)));
  }
  return smallest * 180.0 / std::numbers::pi;
}

}  // namespace

MeshQuality measure_quality(const Mesh& mesh, const MeshRecipe* recipe) {
  MeshQuality quality;
  if (mesh.triangles.empty()) return quality;
  quality.min_angle_deg = 180.0;
  for (Index t = 0; t < mesh.triangle_count(); ++t) {
    const double angle = smallest_angle(mesh, t);
    if (angle < quality.min_angle_deg) {
      quality.min_angle_deg = angle;
      quality.min_angle_triangle = t;
    }
  }
  quality.min_edge = std::numeric_limits<double>::infinity();
  double sum = 0.0;
  for (Index e = 0; e < mesh.edge_count(); ++e) {
    const Vec2 p = mesh.vertices[mesh.edges[e].vertex[0]], q = mesh.vertices[mesh.edges[e].vertex[1]];
    const double length = norm(q - p);
    quality.min_edge = std::min(quality.min_edge, length);
    quality.max_edge = std::max(quality.max_edge, length);
    if (recipe == nullptr) continue;
    const double ratio = length / target_size(*recipe, 0.5 * (p + q));
    sum += ratio;
    if (ratio > quality.max_size_ratio) {
      quality.max_size_ratio = ratio;
      quality.max_size_ratio_edge = e;
    }
  }
  if (recipe != nullptr) quality.mean_size_ratio = sum / static_cast<double>(mesh.edges.size());
  return quality;
}

void require_quality(const Mesh& mesh, const MeshQuality& quality, double min_angle_deg) {
  if (mesh.triangles.empty()) throw MeshError("the mesh has no triangles");
  if (quality.min_angle_deg < min_angle_deg) {
    const Vec2 p = mesh.vertices[mesh.triangles[quality.min_angle_triangle][0]];
    throw MeshError(fmt::format(
        "triangle {} at ({:.6g}, {:.6g}) m has an angle of {:.3g} degrees, less than {:.3g}: change the mesh "
        "seed, reduce the element size there, or move apart joints that meet at a sharp angle",
        quality.min_angle_triangle, p.x, p.y, quality.min_angle_deg, min_angle_deg));
  }
  if (quality.max_size_ratio > most_over_target) {
    const auto& edge = mesh.edges[quality.max_size_ratio_edge];
    const Vec2 p = 0.5 * (mesh.vertices[edge.vertex[0]] + mesh.vertices[edge.vertex[1]]);
    throw MeshError(fmt::format(
        "the edge at ({:.6g}, {:.6g}) m is {:.3g} times its target length, more than {:.3g}: make size grow "
        "more slowly (larger fine_radius or smaller size_coarse)",
        p.x, p.y, quality.max_size_ratio, most_over_target));
  }
}

}  // namespace crackle
