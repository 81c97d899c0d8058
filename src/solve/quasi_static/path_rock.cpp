// SPDX-License-Identifier: GPL-3.0-or-later
#include "path_rock.hpp"

#include <algorithm>
#include <cmath>

#include "crackle/solve/estimates.hpp"

namespace crackle::quasi_static {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

constexpr double least_shear = 0.25;  // β², below it the intact bond gives way to shear

CohesiveMaterial material_of(const QuasiStaticScene& scene, const EdgeMaterials& materials, Index edge,
                             Vec2 normal) {
  if (const JointEdge* joint = scene.joint_at(edge)) return scene.joint_materials[joint->material - 1U];
  return on_plane(materials.all[materials.number(edge)], normal);
}

bool uniform(const QuasiStaticScene& scene) {
  return scene.layer_of_triangle.empty() && scene.stress_gradient == Sym2{};
}

}  // namespace

InterfaceLaw law_of(const QuasiStaticScene& scene, const EdgeMaterials& materials, Index edge, Vec2 normal,
                    double length) {
  const CohesiveMaterial m = material_of(scene, materials, edge, normal);
  const auto& [a, b] = scene.mesh->edges[at(edge)].triangle;
  const double modulus = std::min(plane_strain_modulus(scene.rock_of(a).stiffness),
                                  plane_strain_modulus(scene.rock_of(b).stiffness));
  const double strength =
      resolved_strength(m.tensile_strength, modulus, m.fracture_energy_mode1, length, scene.edges_per_zone);
  ShearLaw shear;
  shear.friction = m.tan_residual;
  // Opened with slip s = x w the bond of a joint dissipates G_I (1 + β² x²): to first order in x² what the
  // linear criterion G_I/G_Ic + G_II/G_IIc = 1 asks for.
  if (const JointEdge* joint = scene.joint_at(edge); joint != nullptr && joint->bonded)
    shear.ratio = std::sqrt(std::max(1.0 - m.fracture_energy_mode1 / m.fracture_energy_mode2, least_shear));
  return {scene.law, strength, m.fracture_energy_mode1, scene.closure, shear};
}

Sym2 in_situ_beside(const Mesh& mesh, const Bulk& bulk, Index edge) {
  const auto& [a, b] = mesh.edges[at(edge)].triangle;
  return 0.5 * (bulk.in_situ(a) + bulk.in_situ(b));
}

void balance_in_situ(const QuasiStaticScene& scene, const Condensation& rock, Bulk& bulk) {
  if (uniform(scene)) return;
  const Mesh& mesh = *scene.mesh;
  std::vector<PointLoad> forces;
  for (Index t = 0; t < mesh.triangle_count(); ++t) {
    const auto g = bulk.shape_gradients(t);
    for (std::size_t i = 0; i < 3; ++i) {
      forces.push_back({t, mesh.triangles[at(t)][i],
                        Vec2{0.0, bulk.corner_weight(t)} - bulk.area(t) * (bulk.in_situ(t) * g[i])});
    }
  }
  for (const Edge& edge : mesh.edges) {
    if (edge.triangle[1] >= 0) continue;
    const Vec2 out = right_normal(mesh.vertices[at(edge.vertex[1])] - mesh.vertices[at(edge.vertex[0])]);
    for (const Index v : edge.vertex)
      forces.push_back({edge.triangle[0], v, 0.5 * (bulk.in_situ(edge.triangle[0]) * out)});
  }
  const std::vector<Vec2> u = rock.respond(forces);
  for (Index t = 0; t < mesh.triangle_count(); ++t) {
    const auto& v = mesh.triangles[at(t)];
    bulk.set_in_situ(t, bulk.small_stress(t, {u[at(v[0])], u[at(v[1])], u[at(v[2])]}));
  }
}

}  // namespace crackle::quasi_static
