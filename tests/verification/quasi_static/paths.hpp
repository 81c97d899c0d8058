// SPDX-License-Identifier: GPL-3.0-or-later
//
// Scenes whose paths nobody lays down: granite-like rock, a fluid that its viscosity does not hinder.
#pragma once

#include "wing.hpp"

namespace crackle::paths {

inline std::size_t at(Index i) { return static_cast<std::size_t>(i); }

constexpr double young = 30e9, poisson = 0.25, rate = 1e-4, toughness = 1e6, pore = 10.56e6;
inline const double modulus = young / (1.0 - poisson * poisson);

inline QuasiStaticScene scene_on(std::shared_ptr<const Mesh> mesh, Sym2 stress) {
  QuasiStaticScene s;
  s.mesh = std::move(mesh);
  s.slip = true;
  s.cohesive.tan_residual = 0.6;
  s.stiffness = isotropic_plane_strain(young, poisson);
  s.pore_pressure = pore;
  s.stress = stress;
  s.law = find_law("linear");
  s.cohesive.fracture_energy_mode1 = toughness * toughness / modulus;
  s.cohesive.tensile_strength = 10e6;
  s.closure.residual_aperture = 1e-5;
  s.fluid.viscosity = 1e-6;
  s.fluid.cavitation_pressure = 0.0;
  s.fluid.reference_pressure = pore;
  s.pump = Pump({{0.0, 1e9, rate}});
  return s;
}

/// A square of side 2 R [m], cells of `step` [m] cut into four; held at its rim.
inline QuasiStaticScene square(double radius, double step, Sym2 stress) {
  const int n = static_cast<int>(std::lround(2.0 * radius / step));
  QuasiStaticScene s = scene_on(std::make_shared<const Mesh>(structured_rectangle(
                                    {-radius, -radius}, {radius, radius}, n, n, MeshPattern::cross)),
                                stress);
  s.held.assign(s.mesh->vertices.size(), 0);
  for (const Edge& e : s.mesh->edges) {
    if (e.triangle[1] < 0) s.held[at(e.vertex[0])] = s.held[at(e.vertex[1])] = 3;
  }
  return s;
}

/// A wide body with fine edges within `fine` [m] of the middle of y = 0; free, held at two far points.
inline QuasiStaticScene wide(double fine, double step, Sym2 stress) {
  const auto line = [&](double even, double ratio) {
    const std::vector<double> half = graded_line(0.0, even, 20.0 * fine, {step, ratio});
    std::vector<double> both;
    for (std::size_t i = half.size(); i-- > 1;) both.push_back(-half[i]);
    both.insert(both.end(), half.begin(), half.end());
    return both;
  };
  QuasiStaticScene s =
      scene_on(std::make_shared<const Mesh>(grid_rectangle(line(fine, 1.2), line(6.0 * step, 1.15))), stress);
  s.held.assign(s.mesh->vertices.size(), 0);
  for (std::size_t v = 0; v < s.held.size(); ++v) {
    const Vec2 p = s.mesh->vertices[v];
    if (p.y == 0.0 && std::abs(p.x) > 19.9 * fine) s.held[v] = p.x > 0.0 ? 2 : 3;
  }
  return s;
}

inline Index vertex_at(const Mesh& mesh, Vec2 where) {
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    if (norm(mesh.vertices[at(v)] - where) < 1e-9) return v;
  }
  return -1;
}

/// A wing along a line from the well, all of it open; on from there it is free.
inline Wing free_wing(const QuasiStaticScene& s, Vec2 well, Vec2 end) {
  Wing w;
  w.start = vertex_at(*s.mesh, well);
  w.path = edges_along(*s.mesh, well, end);
  w.open = w.path.size();
  w.free = true;
  return w;
}

/// Half length [m] and pressure [Pa] of a fracture of so much volume [m2] at the toughness vertex.
struct Vertex {
  double half_length, pressure;
};
inline Vertex vertex_of(double volume) {
  const double a = std::pow(modulus * volume / (2.0 * std::sqrt(M_PI) * toughness), 2.0 / 3.0);
  return {a, toughness / std::sqrt(M_PI * a)};
}

/// Makes a layer of the triangles whose middle `holds`.
template <class Holds>
void set_layer(QuasiStaticScene& s, const RockMass& layer, const Holds& holds) {
  s.layers.push_back(layer);
  const Mesh& mesh = *s.mesh;
  for (const auto& v : mesh.triangles) {
    const Vec2 sum = mesh.vertices[at(v[0])] + mesh.vertices[at(v[1])] + mesh.vertices[at(v[2])];
    s.layer_of_triangle.push_back(holds((1.0 / 3.0) * sum) ? 1 : 0);
  }
}

inline Vec2 middle(const QuasiStatic& stage, const PathEdge& e) {
  const Mesh& mesh = *stage.scene().mesh;
  return 0.5 * (mesh.vertices[at(e.vertex[0])] + mesh.vertices[at(e.vertex[1])]);
}

}  // namespace crackle::paths
