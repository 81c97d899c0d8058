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
#include "crackle/core/errors.hpp"
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
  recipe.wellbore_segments = 2 * static_cast<int>(std::lround(std::numbers::pi * radius / size));
  recipe.size_fine = size;
  recipe.fine_radius = reach;
  recipe.size_coarse = 0.5;
  recipe.joints = {{{-reach, 0.0}, {reach, 0.0}, 0}};
  recipe.joint_sets = {"path"};
  QuasiStaticScene s;
  s.mesh = std::make_shared<const Mesh>(excavate(generate_mesh(recipe)));
  s.stiffness = granite::stiffness();
  s.law = find_law("linear");
  s.cohesive.tensile_strength = granite::cohesive().tensile_strength;
  s.cohesive.fracture_energy_mode1 = granite::cohesive().fracture_energy_mode1;
  s.closure.residual_aperture = 1e-6;
  s.fluid.viscosity = 1e-6;
  s.fluid.compressibility = 1e-12;
  s.fluid.cavitation_pressure = -2e6;
  s.pump = Pump({{0.0, 1e4, 1e-6}});
  s.control.relative = 0.01;
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

// Pressure to which the intact wellbore can be pumped, the fluid in broken edges only [Pa].
double breakdown(Sym2 stress) {
  QuasiStaticScene s = scene(2e-3, 2.0 * radius, 0.0);
  s.stress = stress;
  s.wetting = Wetting::broken;
  s.fluid.compressibility = 1.0 / 1.45e9;
  QuasiStatic stage(std::move(s));
  double highest = 0.0;
  EXPECT_THROW(
      stage.run(1e4, [&](const QuasiStaticRow& row) { highest = std::max(highest, row.well_pressure); }),
      NumericalError);  // it snaps
  return highest;
}

TEST(QuasiStaticBore, Breakdown) {
  const Check check("D4 breakdown of a wellbore in field time, fluid in broken edges only");
  const double isotropic = breakdown(granite::isotropic) / 14.05e6 - 1.0;
  const double anisotropic = breakdown(granite::anisotropic) / 12.45e6 - 1.0;
  std::printf("breakdown over theory: isotropic %+.2f %%, anisotropic %+.2f %%\n", 100 * isotropic,
              100 * anisotropic);
  check.result(std::max(std::abs(isotropic), std::abs(anisotropic)));
  EXPECT_LT(std::abs(isotropic), 0.01);
  EXPECT_LT(std::abs(anisotropic), 0.01);
}

// Pumped below what breaks it: stress round the wellbore, and the volume that the pump has put into it.
TEST(QuasiStaticBore, Kirsch) {
  const Check check("A2 Kirsch, excavated and pumped in field time: stress");
  QuasiStaticScene s = scene(2e-3, 2.0 * radius, 0.0);
  s.stress = granite::anisotropic;
  QuasiStatic stage(s);
  QuasiStaticRow row;
  while (stage.state().well_pressure < 5e6) row = stage.step(1e4);
  const double shear = granite::young_modulus / (2.0 * (1.0 + granite::poisson_ratio));
  const Kirsch exact{radius, shear, granite::poisson_ratio, s.stress, row.well_pressure};
  const std::vector<Sym2> stress = stage.stress(stage.corner_displacement());
  double off = 0.0, all = 0.0;  // squares, by area
  for (Index t = 0; t < s.mesh->triangle_count(); ++t) {
    const auto& v = s.mesh->triangles[at(t)];
    const Vec2 a = s.mesh->vertices[at(v[0])], b = s.mesh->vertices[at(v[1])], c = s.mesh->vertices[at(v[2])];
    const Vec2 centre = (1.0 / 3.0) * (a + b + c);
    if (norm(centre) > 2.0 * radius) continue;
    const auto square = [&](Sym2 x) {
      return cross(b - a, c - a) * (x.xx * x.xx + x.yy * x.yy + 2.0 * x.xy * x.xy);
    };
    off += square(stress[at(t)] + -1.0 * exact.stress(centre));
    all += square(exact.stress(centre));
  }
  const double error = std::sqrt(off / all);
  const double area = std::numbers::pi * radius * radius;
  const double volume = area * row.well_pressure * (1.0 / shear + s.fluid.compressibility);
  std::printf("at %.3f MPa: stress %.2f %% off, volume %+.2f %%; mass %.1e, energy %.1e\n",
              1e-6 * row.well_pressure, 100 * error, 100 * (row.injected / volume - 1.0),
              row.mass_defect / row.injected, row.energies.residual);
  check.result(error);
  EXPECT_LT(error, 0.02);
  EXPECT_NEAR(row.injected / volume, 1.0, 0.01);
  EXPECT_LT(std::abs(row.mass_defect / row.injected), 1e-8);
  EXPECT_LT(row.energies.residual, 1e-6);
}

// Two cracks that grow from the wall, pressure in them and in the wellbore: K_I = F p √(πL) is K_Ic, with L
// that of the crack without cohesion that opens as they do.
TEST(QuasiStaticBore, TwoCracksGrow) {
  const Check check("D3 wellbore with two cracks in field time: pressure at which they grow");
  QuasiStatic stage(scene(2.5e-3, 6.5 * radius, radius));
  const double toughness =
      std::sqrt(plane_strain_modulus(granite::stiffness()) * stage.scene().cohesive.fracture_energy_mode1);
  double worst = 0.0, mass = 0.0, energy = 0.0;
  for (const auto& [length, factor] : {std::pair{1.5, 1.27234}, {2.0, 1.21581}, {3.0, 1.15189}}) {
    QuasiStaticRow before, row = stage.row();
    while (row.elastic_length < 2.0 * length * radius) before = row, row = stage.step(1e4);
    const double f =
        (2.0 * length * radius - before.elastic_length) / (row.elastic_length - before.elastic_length);
    const double pressure = before.well_pressure + f * (row.well_pressure - before.well_pressure);
    const double error =
        pressure / (toughness / (factor * std::sqrt(std::numbers::pi * length * radius))) - 1.0;
    std::printf("L = %.1f R: %.4f MPa, %+.2f %%\n", length, 1e-6 * pressure, 100 * error);
    worst = std::max(worst, std::abs(error));
    mass = std::max(mass, std::abs(row.mass_defect / row.injected));
    energy = std::max(energy, row.energies.residual);
  }
  std::printf("mass %.1e, energy %.1e\n", mass, energy);
  check.result(worst);
  EXPECT_LT(worst, 0.02);
  EXPECT_LT(mass, 1e-8);
  EXPECT_LT(energy, 1e-2);
}

}  // namespace
}  // namespace crackle
