// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a general path costs: 1e5 degrees of freedom, 200 edges, both wings free, faces that slip.
#include <gtest/gtest.h>

#include <ctime>

#include "../../acceptance.hpp"
#include "wing.hpp"

namespace crackle {
namespace {

TEST(Paths, Cost) {
  constexpr double step = 0.25, fine = 26.0, far = 300.0;
  const auto line = [](double even, double ratio) {
    const std::vector<double> half = graded_line(0.0, even, far, {step, ratio});
    std::vector<double> both;
    for (std::size_t i = half.size(); i-- > 1;) both.push_back(-half[i]);
    both.insert(both.end(), half.begin(), half.end());
    return both;
  };
  const auto begin = std::clock();
  QuasiStaticScene s;
  auto mesh = std::make_shared<const Mesh>(grid_rectangle(line(fine, 1.2), line(20.0, 1.15)));
  s.held.assign(mesh->vertices.size(), 0);
  Index well = -1;
  for (std::size_t v = 0; v < s.held.size(); ++v) {
    const Vec2 p = mesh->vertices[v];
    if (p.y == 0.0 && std::abs(p.x) > 0.99 * far) s.held[v] = p.x > 0.0 ? 2 : 3;
    if (p.x == 0.0 && p.y == 0.0) well = static_cast<Index>(v);
  }
  s.stiffness = isotropic_plane_strain(30e9, 0.25);
  s.pore_pressure = 10.56e6;
  s.stress = {-18.3e6, -9.44e6, 0.0};
  s.law = find_law("linear");
  s.cohesive.fracture_energy_mode1 = 31.25;
  s.cohesive.tensile_strength = 10e6;
  s.closure.residual_aperture = 1e-5;
  s.fluid.viscosity = 1e-6;
  s.fluid.cavitation_pressure = 0.0;
  s.fluid.reference_pressure = s.pore_pressure;
  s.pump = Pump({{0.0, 1e9, 1e-4}});
  s.slip = true;
  s.cohesive.tan_residual = 0.6;
  for (const double end : {1.0, -1.0}) {
    const std::vector<Index> path = edges_along(*mesh, {0.0, 0.0}, {end, 0.0});
    s.wings.push_back({well, path, path.size(), true});
  }
  const std::size_t unknowns = 2 * mesh->vertices.size();
  s.mesh = std::move(mesh);
  QuasiStatic stage(s);
  int steps = 0;
  while (stage.path().edges().size() < 200 && stage.time() < 200.0) {
    stage.step(200.0);
    ++steps;
  }
  const double seconds = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
  std::printf("%zu degrees of freedom, %zu path edges, %d steps, %ld iterations: %.1f s of processor time\n",
              unknowns, stage.path().edges().size(), steps, stage.newton_iterations(), seconds);
  accept(22, "general path, 1e5 degrees of freedom, 200 edges, both wings free: processor time", "120 s",
         text("%.0f s", seconds), seconds <= 120.0);
  EXPECT_GE(stage.path().edges().size(), 200U);
  EXPECT_LE(seconds, 120.0);
}

}  // namespace
}  // namespace crackle
