// SPDX-License-Identifier: GPL-3.0-or-later
//
// The same pumped crack in both regimes, on one mesh: explicit steps with the cavity of uniform pressure, and
// the quasi-static stage with flow that its viscosity does not hinder (validation D5, granite).
#pragma once

#include <gtest/gtest.h>

#include "../../acceptance.hpp"
#include "../../pumped_crack.hpp"
#include "crackle/mesh/grid.hpp"
#include "crackle/solve/estimates.hpp"
#include "crackle/solve/quasi_static.hpp"

namespace crackle::regimes {

using granite::at;

constexpr double notch = 0.1, path = 0.27;  // [m]
constexpr double fluid_modulus = 5e6, rate = 2e-3, end = 2.4e-3;
constexpr Sym2 in_situ{-2e6, 0.0, 0.0};  // along the crack

inline std::shared_ptr<const Mesh> make_mesh(double size) {
  MeshRecipe recipe;
  recipe.width = recipe.height = 8.0;
  recipe.size_fine = size;
  recipe.fine_radius = 0.27;
  recipe.size_coarse = 0.5;
  recipe.joints = {
      {{-notch, 0.0}, {notch, 0.0}, 0}, {{notch, 0.0}, {path, 0.0}, 1}, {{-path, 0.0}, {-notch, 0.0}, 1}};
  recipe.joint_sets = {"crack", "path"};
  return std::make_shared<const Mesh>(generate_mesh(recipe));
}

inline Scene explicit_scene(std::shared_ptr<const Mesh> mesh) {
  Scene scene = granite::pumped_crack(std::move(mesh), "linear", fluid_modulus, rate);
  scene.stress = in_situ;
  return scene;
}

inline QuasiStaticScene quasi_static_scene(std::shared_ptr<const Mesh> mesh) {
  QuasiStaticScene s;
  s.stiffness = granite::stiffness();
  s.stress = in_situ;
  s.law = find_law("linear");
  s.cohesive.tensile_strength = granite::cohesive().tensile_strength;
  s.cohesive.fracture_energy_mode1 = granite::cohesive().fracture_energy_mode1;
  s.edges_per_zone = 2.0;  // so that the strength is that of the explicit run
  s.closure.residual_aperture = 1e-6;
  s.fluid.viscosity = 1e-9;
  s.fluid.compressibility = 1.0 / fluid_modulus;
  s.fluid.cavitation_pressure = -2e6;
  s.pump = Pump({{0.0, 1.0, rate}});
  s.slip = true;
  s.cohesive.tan_residual = 0.6;
  s.control.first = 1e-6;
  s.held.assign(mesh->vertices.size(), 0);
  for (const Edge& e : mesh->edges) {
    if (e.kind == EdgeKind::outer) s.held[at(e.vertex[0])] = s.held[at(e.vertex[1])] = 3;
  }
  Index well = 0;
  for (const Edge& e : mesh->edges) {
    if (e.joint < 0) continue;
    for (const Index v : e.vertex)
      if (norm(mesh->vertices[at(v)]) < norm(mesh->vertices[at(well)])) well = v;
  }
  for (const double side : {1.0, -1.0}) {
    Wing wing;
    wing.start = well;
    const Vec2 tip{side * notch, 0.0};
    wing.path = edges_along(*mesh, mesh->vertices[at(well)], tip);
    wing.open = wing.path.size();
    const std::vector<Index> on = edges_along(*mesh, tip, {side * path, 0.0});
    wing.path.insert(wing.path.end(), on.begin(), on.end());
    s.wings.push_back(std::move(wing));
  }
  s.mesh = std::move(mesh);
  return s;
}

struct Moment {
  double time, pressure, half_length, dissipated;
};

inline std::vector<Moment> by_steps(const std::shared_ptr<const Mesh>& mesh) {
  std::vector<Moment> record;
  Simulation simulation(explicit_scene(mesh));
  for (double next = 0.5 * end; simulation.state().time < end;) {
    simulation.step(0.8 * simulation.stable_limit());
    const double time = simulation.state().time;
    if (time < next) continue;
    next += 0.01 * end;
    record.push_back({time, simulation.wellbore_pressure(),
                      0.5 * simulation.fluid()->wetted_length(simulation.state()),
                      simulation.state().dissipation.fracture});
  }
  return record;
}

inline std::vector<Moment> by_equilibrium(const std::shared_ptr<const Mesh>& mesh) {
  std::vector<Moment> record;
  QuasiStatic stage(quasi_static_scene(mesh));
  stage.run(end, [&](const QuasiStaticRow& row) {
    record.push_back({row.time, row.fracture_pressure, 0.5 * row.damaged_length, row.dissipated});
  });
  return record;
}

inline Moment interpolate(const std::vector<Moment>& record, double time) {
  for (std::size_t i = 1; i < record.size(); ++i) {
    const Moment &a = record[i - 1], &b = record[i];
    if (b.time < time) continue;
    const double f = (time - a.time) / (b.time - a.time);
    const auto between = [&](double x, double y) { return x + f * (y - x); };
    return {time, between(a.pressure, b.pressure), between(a.half_length, b.half_length),
            between(a.dissipated, b.dissipated)};
  }
  return record.back();
}

/// Griffith's crack of a compressible fluid [Pa, m]: p = √(E'G/(π a)), 2π p a²/E' (1 + p/K) pumped.
inline Moment by_griffith(double time) {
  const double modulus = plane_strain_modulus(granite::stiffness()),
               energy = granite::cohesive().fracture_energy_mode1;
  const auto pressure = [&](double a) { return std::sqrt(modulus * energy / (M_PI * a)); };
  double low = 0.5 * notch, high = 2.0 * path;
  while (high - low > 1e-9) {
    const double a = 0.5 * (low + high), p = pressure(a);
    (2.0 * M_PI * p * a * a / modulus * (1.0 + p / fluid_modulus) < rate * time ? low : high) = a;
  }
  return {time, pressure(low), low, 0.0};
}

/// Means over the second half of the time.
struct Comparison {
  double pressure = 0.0, length = 0.0;         ///< quasi-static over explicit, less 1
  double by_steps = 0.0, by_equilibrium = 0;   ///< pressures over Griffith's, less 1
  double energy = 0.0, energy_by_steps = 0.0;  ///< dissipated per advance, over G
};

inline Comparison compare(double size) {
  const auto mesh = make_mesh(size);
  const std::vector<Moment> steps = by_steps(mesh), equilibrium = by_equilibrium(mesh);
  const double weight = 1.0 / static_cast<double>(steps.size());
  Comparison c;
  for (const Moment& s : steps) {
    const Moment q = interpolate(equilibrium, s.time), g = by_griffith(s.time);
    c.pressure += weight * (q.pressure / s.pressure - 1.0);
    c.length += weight * (q.half_length / s.half_length - 1.0);
    c.by_steps += weight * (s.pressure / g.pressure - 1.0);
    c.by_equilibrium += weight * (q.pressure / g.pressure - 1.0);
  }
  const auto per_advance = [](const Moment& a, const Moment& b) {
    return (b.dissipated - a.dissipated) / (2.0 * (b.half_length - a.half_length)) /
           granite::cohesive().fracture_energy_mode1;
  };
  c.energy = per_advance(interpolate(equilibrium, steps.front().time), equilibrium.back());
  c.energy_by_steps = per_advance(steps.front(), steps.back());
  accept(
      16,
      text("one pumped crack, mesh of %.0f mm, quasi-static over explicit: p, length; dissipated over G per "
           "advance, both; p over Griffith's, both",
           1e3 * size),
      "2, 5 %; 1; printed",
      text("%+.2f, %+.2f %%; %.3f, %.3f; %+.2f, %+.2f %%", 100 * c.pressure, 100 * c.length, c.energy,
           c.energy_by_steps, 100 * c.by_equilibrium, 100 * c.by_steps),
      std::abs(c.pressure) <= 0.02 && std::abs(c.length) <= 0.05 && c.energy >= 0.99);
  return c;
}

}  // namespace crackle::regimes
