// SPDX-License-Identifier: GPL-3.0-or-later
//
// What many tests share: the granite of AbuAisha et al. (2016), Table 1, and bodies made of it.
#pragma once

#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include "crackle/solve/simulation.hpp"

namespace crackle::granite {

inline std::size_t at(Index i) { return static_cast<std::size_t>(i); }

inline constexpr double young_modulus = 35e9;  // [Pa]
inline constexpr double poisson_ratio = 0.27;
inline constexpr double density = 2500.0;                 // [kg/m3]
inline constexpr Sym2 isotropic{-4.85e6, -4.85e6, 0.0};   // [Pa]
inline constexpr Sym2 anisotropic{-7.05e6, -4.9e6, 0.0};  // [Pa]

inline PlaneStiffness stiffness() { return isotropic_plane_strain(young_modulus, poisson_ratio); }

inline CohesiveMaterial cohesive() {
  const double tan_phi = std::tan(38.0 * std::numbers::pi / 180.0);
  return {3e6, 24e6, tan_phi, tan_phi, 5.0, 80.0, 120e9, 30e9, Calibration::exact};
}

/// Rock that cannot break, with elements of a given penalty [Pa] on all edges.
inline CohesiveMaterial unbreakable(double penalty) {
  return {1e15, 1e15, 0.0, 0.0, 1e15, 1e15, penalty, penalty, Calibration::y_geo};
}

inline Scene scene(std::shared_ptr<const Mesh> mesh) {
  Scene s;
  s.mesh = std::move(mesh);
  s.stiffness = stiffness();
  s.density = density;
  return s;
}

/// A square domain round a wellbore of 0.1 m, excavated.
struct Wellbore {
  int segments = 105;
  double width = 8.0;        // [m]
  double fine_radius = 0.1;  // [m]
  double size_coarse = 0.3;  // [m]
};
inline constexpr double wellbore_radius = 0.05;  // [m]

inline std::shared_ptr<const Mesh> make(const Wellbore& w) {
  MeshRecipe recipe;
  recipe.width = recipe.height = w.width;
  recipe.wellbore_diameter = 2.0 * wellbore_radius;
  recipe.wellbore_segments = w.segments;
  recipe.size_fine = 2.0 * std::numbers::pi * wellbore_radius / w.segments;
  recipe.fine_radius = w.fine_radius;
  recipe.size_coarse = w.size_coarse;
  return std::make_shared<const Mesh>(excavate(generate_mesh(recipe)));
}

/// Sides for which free(middle) holds become free: a boundary of kind wellbore is not held.
template <class Where>
std::shared_ptr<const Mesh> with_free_sides(Mesh mesh, const Where& free) {
  for (Edge& edge : mesh.edges) {
    const Vec2 middle = 0.5 * (mesh.vertices[at(edge.vertex[0])] + mesh.vertices[at(edge.vertex[1])]);
    if (edge.kind == EdgeKind::outer && free(middle)) edge.kind = EdgeKind::wellbore;
  }
  return std::make_shared<const Mesh>(std::move(mesh));
}
inline std::shared_ptr<const Mesh> free_body(Mesh mesh) {
  return with_free_sides(std::move(mesh), [](Vec2) { return true; });
}

inline std::vector<Index> edges_of_kind(const Mesh& mesh, EdgeKind kind) {
  std::vector<Index> edges;
  for (Index e = 0; e < mesh.edge_count(); ++e) {
    if (mesh.edges[at(e)].kind == kind) edges.push_back(e);
  }
  return edges;
}

/// Area inside the wellbore's wall in the reference state [m2].
inline double hole_area(const Mesh& mesh) {
  double area = 0.0;
  for (const Index e : edges_of_kind(mesh, EdgeKind::wellbore)) {
    const auto& v = mesh.edges[at(e)].vertex;
    area -= 0.5 * cross(mesh.vertices[at(v[0])], mesh.vertices[at(v[1])]);
  }
  return area;
}

inline Vec2 centroid(const Mesh& mesh, Index triangle) {
  Vec2 sum;
  for (const Index v : mesh.triangles[at(triangle)]) sum += mesh.vertices[at(v)];
  return (1.0 / 3.0) * sum;
}

inline double larger_part(Sym2 s) { return std::max({std::abs(s.xx), std::abs(s.yy), std::abs(s.xy)}); }
inline Sym2 difference(Sym2 a, Sym2 b) { return a + (-1.0) * b; }

}  // namespace crackle::granite
