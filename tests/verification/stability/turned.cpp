// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "../damage/scenes.hpp"
#include "crackle/solve/estimates.hpp"
#include "scenes.hpp"

namespace crackle::stability {

using granite::at;

namespace {

constexpr double h = 1e-3, half_width = 50 * h, notch = 10 * h;  // [m]

// Reference rock of the damage tests: l_ch = E'G/f_t² = 2.33 mm.
CohesiveMaterial rock() {
  constexpr double penalty = 20.0 * granite::young_modulus;
  return {9e6, 36e6, 0.0, 0.0, 5.0, 80.0, penalty, penalty, Calibration::exact};
}

// Edges of a path from end to end of the notch that leaves its line least.
std::vector<Index> path(const Mesh& mesh, Vec2 along) {
  std::vector<std::vector<Index>> edges_at(mesh.vertices.size());
  for (Index e = 0; e < mesh.edge_count(); ++e) {
    for (const Index v : mesh.edges[at(e)].vertex) edges_at[at(v)].push_back(e);
  }
  const auto off = [&](Index v) { return std::abs(cross(along, mesh.vertices[at(v)])); };
  const auto nearest = [&](Vec2 x) {
    const auto d = [&](Vec2 y) { return norm(y - x); };
    return static_cast<Index>(std::ranges::min_element(mesh.vertices, {}, d) - mesh.vertices.begin());
  };
  std::vector<Index> edges;
  const Index last = nearest(notch * along);
  for (Index v = nearest(-notch * along); v != last && edges.size() < 100;) {
    Index best = -1, to = -1;
    for (const Index e : edges_at[at(v)]) {
      const auto& ends = mesh.edges[at(e)].vertex;
      const Index next = ends[0] == v ? ends[1] : ends[0];
      if (dot(along, mesh.vertices[at(next)] - mesh.vertices[at(v)]) < 0.1 * h) continue;
      if (best < 0 || off(next) < off(to)) best = e, to = next;
    }
    edges.push_back(best);
    v = to;
  }
  return edges;
}

}  // namespace

Row turned(const std::string& setting, double x) {
  Scene scene = granite::scene(std::make_shared<const Mesh>(structured_rectangle(
      {-half_width, -half_width}, {half_width, half_width}, 100, 100, MeshPattern::right)));
  const double angle = x * std::numbers::pi / 180.0;
  const Vec2 along{std::cos(angle), std::sin(angle)};
  scene.damping.ratio = 0.1;
  if (setting == "damage") {
    scene = smeared::scene(scene.mesh, smeared::rock(DamagePreset::recommended));
    scene.damage.cut = smeared::notch(*scene.mesh, notch, angle);
  } else {
    scene.law = find_law("benzeggagh_kenane");
    scene.cohesive = rock();
    scene.contact = {scene.cohesive.penalty, scene.cohesive.penalty, 0.0};
    scene.insertion.on_demand = true;
    scene.cracks = path(*scene.mesh, along);
  }
  // Linear softening, remote tension, a = 4.29 l_ch: exact.
  const double strength = 0.9552 * std::sqrt(plane_strain_modulus(scene.stiffness) *
                                             rock().fracture_energy_mode1 / (std::numbers::pi * notch));
  scene.stress = {0.6 * strength, 0.6 * strength, 0.0};
  Simulation simulation(scene);
  State& state = simulation.state();
  std::vector<Index> held, ring;
  for (Index n = 0; n < state.node_count(); ++n) {
    const Vec2 at_rest = state.node_reference(n);
    if (std::max(std::abs(at_rest.x), std::abs(at_rest.y)) > half_width - 1e-9) held.push_back(n);
  }
  for (Index t = 0; t < scene.mesh->triangle_count(); ++t) {
    const Vec2 c = granite::centroid(*scene.mesh, t);
    if (std::max(std::abs(c.x), std::abs(c.y)) > half_width - h) ring.push_back(t);
  }
  const PlaneStiffness& c = scene.stiffness;
  const double bulk = c.c11 + c.c12;  // stress over strain, equal along x and y [Pa]
  constexpr double rise = 1.2e-3;     // from 0.6 to 1.6 of the strength [s]
  const double rate = strength / bulk / rise, dt = 0.8 * simulation.stable_limit();
  Row row{"turned", setting, x};
  row.predicted = 1.0;
  row.measured = 0.0;
  double stress = 0.0;
  while (state.time < rise && stress > 0.7 * row.measured * strength - 1e4) {
    for (const Index n : held) state.velocity[at(n)] = rate * state.node_reference(n);
    simulation.step(dt);
    if (state.step % 20 != 0) continue;
    double sum = 0.0;
    for (const Index t : ring) {
      const Sym2 s = simulation.bulk().stress(state, t);
      sum += 0.5 * (s.xx + s.yy);
    }
    stress = sum / static_cast<double>(ring.size());
    row.measured = std::max(row.measured, stress / strength);
  }
  row.broken = smeared::failed(state) - static_cast<long>(scene.damage.cut.size());
  for (const CohesiveStatus s : state.cohesive.status) row.broken += s >= CohesiveStatus::broken;
  row.broken -= static_cast<long>(scene.cracks.size());
  return row;
}

}  // namespace crackle::stability
