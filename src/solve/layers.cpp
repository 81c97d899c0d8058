// SPDX-License-Identifier: GPL-3.0-or-later
// What a scene's layers make of its rock, of its mass and of the materials of its edges.
#include <algorithm>
#include <map>

#include "crackle/solve/simulation.hpp"

namespace crackle {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

// Perfectly bonded rocks part by the lower of each strength and fracture energy.
CohesiveMaterial weaker(const CohesiveMaterial& a, const CohesiveMaterial& b) {
  CohesiveMaterial m = a;
  m.tensile_strength = std::min(a.tensile_strength, b.tensile_strength);
  m.cohesion = std::min(a.cohesion, b.cohesion);
  m.tan_friction = std::min(a.tan_friction, b.tan_friction);
  m.tan_residual = std::min(a.tan_residual, b.tan_residual);
  m.fracture_energy_mode1 = std::min(a.fracture_energy_mode1, b.fracture_energy_mode1);
  m.fracture_energy_mode2 = std::min(a.fracture_energy_mode2, b.fracture_energy_mode2);
  m.penalty = std::min(a.penalty, b.penalty);
  m.tangential_penalty = std::min(a.tangential_penalty, b.tangential_penalty);
  return m;
}

}  // namespace

const JointEdge* RockModel::joint_at(Index edge) const {
  const auto found = std::ranges::lower_bound(joints, edge, {}, &JointEdge::edge);
  return found != joints.end() && found->edge == edge ? &*found : nullptr;
}

Bulk bulk_of(const RockModel& scene, const Bulk::Damping& damping) {
  std::vector<BulkMaterial> materials;
  for (std::size_t layer = 0; layer <= scene.layers.size(); ++layer) {
    const RockMass& rock = scene.rock(layer);
    materials.push_back({rock.triangle_stiffness.value_or(rock.stiffness),
                         rock.density,
                         {rock.stress, rock.stress_gradient}});
  }
  return {*scene.mesh, std::move(materials), scene.layer_of_triangle, damping};
}

EdgeMaterials edge_materials(const RockModel& scene) {
  EdgeMaterials m;
  m.all.push_back(scene.cohesive);
  m.all.insert(m.all.end(), scene.joint_materials.begin(), scene.joint_materials.end());
  if (scene.layer_of_triangle.empty()) return m;
  std::vector<std::uint16_t> of_layer{0};
  for (const RockMass& layer : scene.layers) {
    of_layer.push_back(static_cast<std::uint16_t>(m.all.size()));
    m.all.push_back(layer.cohesive);
  }
  const Mesh& mesh = *scene.mesh;
  m.of_edge.assign(mesh.edges.size(), 0);
  std::map<std::pair<std::uint16_t, std::uint16_t>, std::uint16_t> between;
  for (Index e = 0; e < mesh.edge_count(); ++e) {
    const Edge& edge = mesh.edges[at(e)];
    std::uint16_t a = scene.layer_of_triangle[at(edge.triangle[0])];
    std::uint16_t b = edge.triangle[1] < 0 ? a : scene.layer_of_triangle[at(edge.triangle[1])];
    if (a > b) std::swap(a, b);
    m.of_edge[at(e)] = of_layer[a];
    if (a == b) continue;
    const auto [found, fresh] = between.try_emplace({a, b}, static_cast<std::uint16_t>(m.all.size()));
    if (fresh) {
      // Bedding of either rock counts as it is on the interface, which is straight.
      const Vec2 side = mesh.vertices[at(edge.vertex[1])] - mesh.vertices[at(edge.vertex[0])];
      const Vec2 normal = (1.0 / norm(side)) * right_normal(side);
      m.all.push_back(
          weaker(on_plane(scene.rock(a).cohesive, normal), on_plane(scene.rock(b).cohesive, normal)));
    }
    m.of_edge[at(e)] = found->second;
  }
  return m;
}

void set_mass(State& state, const Bulk& bulk) {
  if (!bulk.layered()) return set_mass(state, bulk.density(0));
  std::vector<double> density(at(state.mesh->triangle_count()));
  for (Index t = 0; t < state.mesh->triangle_count(); ++t) density[at(t)] = bulk.density(t);
  set_mass(state, std::move(density));
}

void set_materials(State& state, const Scene& scene, const EdgeMaterials& materials) {
  for (Index i = 0; i < state.cohesive.count(); ++i)
    state.cohesive.material[at(i)] = materials.number(state.cohesive.edge[at(i)]);
  for (const JointEdge& joint : scene.joints)
    state.cohesive.material[at(state.cohesive.of_edge[at(joint.edge)])] = joint.material;
}

double slowest_shear_wave(const Scene& scene) {
  double slowest = wave_speeds(scene.stiffness, scene.density).s;
  for (const RockMass& layer : scene.layers)
    slowest = std::min(slowest, wave_speeds(layer.stiffness, layer.density).s);
  return slowest;
}

SeismicMedium Simulation::medium() const {
  SeismicMedium medium{
      {scene_.stiffness.c12, scene_.stiffness.c66}, scene_.thickness, {}, scene_.layer_of_triangle};
  for (const RockMass& layer : scene_.layers)
    medium.layers.push_back({layer.stiffness.c12, layer.stiffness.c66});
  return medium;
}

}  // namespace crackle
