// SPDX-License-Identifier: GPL-3.0-or-later
//
// Plates and bars of the reference rock for smeared damage: E = 35 GPa, ν = 0.27, ρ = 2500 kg/m3, f_t = 9
// MPa, c = 36 MPa, G_I = 5, G_II = 80 J/m2, linear softening.
#pragma once

#include <algorithm>
#include <functional>

#include "../../granite.hpp"

namespace crackle::smeared {

using granite::at;

inline DamageMaterial rock(DamagePreset preset) {
  DamageMaterial m{9e6, 36e6, 0.0, 0.0, 5.0, 80.0};
  m.apply(preset);
  m.initiation = Initiation::principal;
  return m;
}

inline Scene scene(std::shared_ptr<const Mesh> mesh, const DamageMaterial& m) {
  Scene s = granite::scene(std::move(mesh));
  s.damping.ratio = 0.1;
  s.damage.law = find_softening("linear");
  s.damage.materials = {m};
  return s;
}

/// Rock near the ends that does not break: clamped corners would, and the grips reckon with intact triangles.
inline void strengthen_ends(Scene& s, double half_height) {
  DamageMaterial strong = s.damage.materials.back();
  strong.tensile_strength = strong.cohesion = 1e12;
  strong.fracture_energy_mode1 = strong.fracture_energy_mode2 = 1e20;
  const auto number = static_cast<std::uint16_t>(s.damage.materials.size());
  s.damage.materials.push_back(strong);
  s.damage.of_triangle.resize(s.mesh->triangles.size());
  for (Index t = 0; t < s.mesh->triangle_count(); ++t) {
    if (std::abs(granite::centroid(*s.mesh, t).y) > 0.85 * half_height) s.damage.of_triangle[at(t)] = number;
  }
}

/// A body pulled apart along y: nodes at its ends move at half the speed each, which grows in the first part
/// of the time.
class Pull {
 public:
  Pull(const Scene& scene, double half_height, double speed, double rise)
      : simulation(scene), speed_(speed), rise_(rise) {
    State& state = simulation.state();
    for (Index n = 0; n < state.node_count(); ++n) {
      const double y = state.node_reference(n).y;
      if (std::abs(y) < half_height * (1.0 - 1e-9)) continue;
      state.inverse_mass[at(n)] = 0.0;
      gripped_.push_back(n);
    }
  }

  Simulation simulation;
  double work = 0.0;      // of the grips [J/m]
  double force = 0.0;     // mean of both ends [N/m]
  double residual = 0.0;  // of the ledger, largest so far over the largest energy

  void step() {
    State& state = simulation.state();
    const double dt = 0.8 * simulation.stable().limit;
    const double speed = 0.5 * speed_ * std::min(1.0, state.time / rise_);
    for (const Index n : gripped_)
      state.velocity[at(n)] = {0.0, state.node_reference(n).y > 0.0 ? speed : -speed};
    const double before = pull();
    if (started_) work += 0.5 * (last_pull_ + before) * last_step_;
    started_ = true;
    if (state.step % 20 == 0) {
      const Energies e = simulation.step_and_account(dt);
      const double spent = e.fracture + e.friction + e.viscous;
      scale_ = std::max({scale_, std::abs(work), spent, 1e-6});
      worst_ = std::max(worst_, std::abs(e.kinetic + e.strain + spent - work));
      residual = worst_ / scale_;
    } else {
      simulation.step(dt);
    }
    last_pull_ = before;
    last_step_ = 2.0 * dt * speed;
    force += 0.02 * (before - force);
  }

 private:
  // Mean of the forces with which the ends are held [N/m]. Grips are intact.
  double pull() const {
    const State& state = simulation.state();
    double sum = 0.0;
    for (const Index n : gripped_) {
      const double side = state.node_reference(n).y > 0.0 ? 1.0 : -1.0;
      for (Index k = 0; k < state.node_size[at(n)]; ++k) {
        const Index corner = state.node_corners[at(state.node_first[at(n)] + k)];
        sum -= side * simulation.bulk().triangle_forces(state, corner / 3)[at(corner % 3)].y;
      }
    }
    return 0.5 * sum;
  }

  double speed_, rise_;
  std::vector<Index> gripped_;
  double last_pull_ = 0.0, last_step_ = 0.0, scale_ = 0.0, worst_ = 0.0;
  bool started_ = false;
};

/// x and y exchanged.
inline Mesh transposed(Mesh mesh) {
  for (Vec2& v : mesh.vertices) v = {v.y, v.x};
  for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
  build_edges(mesh);
  return mesh;
}

/// Without the triangles for which gone(centroid) holds.
inline Mesh without(const Mesh& whole, const std::function<bool(Vec2)>& gone) {
  Mesh mesh;
  std::vector<Index> number(whole.vertices.size(), -1);
  for (Index t = 0; t < whole.triangle_count(); ++t) {
    if (gone(granite::centroid(whole, t))) continue;
    mesh.triangles.push_back(whole.triangles[at(t)]);
    for (Index& v : mesh.triangles.back()) {
      if (number[at(v)] < 0) {
        number[at(v)] = mesh.vertex_count();
        mesh.vertices.push_back(whole.vertices[at(v)]);
      }
      v = number[at(v)];
    }
  }
  mesh.regions.assign(mesh.triangles.size(), Region::rock);
  build_edges(mesh);
  return mesh;
}

/// Triangles that a straight notch of half-length a through the origin passes through, as cracks across it.
inline std::vector<CutTriangle> notch(const Mesh& mesh, double a, double angle) {
  const Vec2 along{std::cos(angle), std::sin(angle)}, normal{-along.y, along.x};
  std::vector<CutTriangle> cut;
  for (Index t = 0; t < mesh.triangle_count(); ++t) {
    int ahead = 0;
    for (const Index v : mesh.triangles[at(t)]) ahead += dot(mesh.vertices[at(v)], normal) > 1e-7;
    if (ahead % 3 != 0 && std::abs(dot(granite::centroid(mesh, t), along)) < a) cut.push_back({t, normal});
  }
  return cut;
}

inline Index failed(const State& state) {
  return static_cast<Index>(
      std::ranges::count_if(state.damage.triangles, [](const auto& d) { return d.failed != 0; }));
}

}  // namespace crackle::smeared
