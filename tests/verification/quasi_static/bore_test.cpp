// SPDX-License-Identifier: GPL-3.0-or-later
//
// A wellbore drilled into the stage's mesh: Kirsch round it, its fluid and the rock's compliance as storage,
// and the fracture that starts at its wall against theory (validation.md D3, D4).
#include <gtest/gtest.h>

#include <cstdio>
#include <numbers>

#include "../../granite.hpp"
#include "../../result.hpp"
#include "../kirsch.hpp"
#include "crackle/mesh/grid.hpp"
#include "crackle/solve/estimates.hpp"
#include "crackle/solve/quasi_static.hpp"

namespace crackle {
namespace {

using granite::at;

constexpr double radius = granite::wellbore_radius;

// Two wings along x from the wall of the wellbore of the granite, `open` of each broken; edges of `size` up
// to `reach` from the origin.
QuasiStaticScene scene(double size, double reach, double open) {
  MeshRecipe recipe;
  recipe.width = recipe.height = 8.0;
  recipe.wellbore_diameter = 2.0 * radius;
  recipe.size_fine = size;
  recipe.fine_radius = reach;
  recipe.size_coarse = 0.5;
  recipe.joints = {{{-reach, 0.0}, {reach, 0.0}, 0}};
  recipe.joint_sets = {"path"};
  QuasiStaticScene s;
  s.mesh = std::make_shared<const Mesh>(excavate(generate_mesh(recipe)));
  s.stiffness = granite::stiffness();
  s.law = find_law("linear");
  s.tensile_strength = granite::cohesive().tensile_strength;
  s.fracture_energy = granite::cohesive().fracture_energy_mode1;
  s.closure.residual_aperture = 1e-6;
  s.fluid.viscosity = 1e-6;
  s.fluid.compressibility = 1.0 / 1.45e9;
  s.fluid.cavitation_pressure = -2e6;
  s.held.assign(s.mesh->vertices.size(), 0);
  for (const Edge& e : s.mesh->edges) {
    if (e.kind == EdgeKind::outer) s.held[at(e.vertex[0])] = s.held[at(e.vertex[1])] = 3;
  }
  for (const double side : {1.0, -1.0}) {
    Wing wing;
    for (const Edge& e : s.mesh->edges) {
      for (const Index v : e.vertex) {
        const Vec2 x = s.mesh->vertices[at(v)];
        if (e.kind == EdgeKind::wellbore && std::abs(x.y) < 1e-9 && side * x.x > 0.0) wing.start = v;
      }
    }
    const Vec2 from = s.mesh->vertices[at(wing.start)];
    wing.path = edges_along(*s.mesh, from, {side * reach, 0.0});
    for (const Index e : wing.path) {
      const auto& v = s.mesh->edges[at(e)].vertex;
      const double middle = 0.5 * side * (s.mesh->vertices[at(v[0])].x + s.mesh->vertices[at(v[1])].x);
      wing.open += middle < radius + open ? 1 : 0;
    }
    wing.open -= 1;  // of its default
    s.wings.push_back(std::move(wing));
  }
  return s;
}

double breakdown(double size, Sym2 stress) {
  QuasiStaticScene s = scene(size, 2.5 * radius, 0.0);
  s.stress = stress;
  s.wetting = Wetting::broken;
  s.edges_per_zone = 2.0;
  s.pump = Pump({{0.0, 1.0, 1e-6}});
  s.control.first = 1e-3;
  s.control.relative = 0.01;
  QuasiStatic stage(std::move(s));
  double highest = 0.0;
  QuasiStaticRow row;
  try {
    while (stage.time() < 200.0) {
      row = stage.step(200.0);
      highest = std::max(highest, row.well_pressure);
      std::printf(
          "%g s dt %g: %.4f MPa, damaged %.1f broken %.1f mm, %d its, residual %.1e mass %.1e rej %ld\n",
          row.time, row.step, 1e-6 * row.well_pressure, 1e3 * row.damaged_length, 1e3 * row.broken_length,
          row.iterations, row.energies.residual, row.mass_defect / row.injected, stage.rejected_steps());
      if (row.well_pressure < 0.9 * highest) break;
    }
  } catch (const std::exception& e) {
    std::printf("%s\n", e.what());
  }
  return highest;
}

TEST(QuasiStaticBore, Breakdown) { std::printf("%.3f\n", 1e-6 * breakdown(3e-3, granite::anisotropic)); }

}  // namespace
}  // namespace crackle
