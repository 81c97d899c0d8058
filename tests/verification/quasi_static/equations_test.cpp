// SPDX-License-Identifier: GPL-3.0-or-later
//
// The condensed stage against the full equations, and against Griffith's crack.
#include <gtest/gtest.h>

#include <cstdio>
#include <map>
#include <numeric>

#include "../../acceptance.hpp"
#include "crackle/cohesive/interface.hpp"
#include "crackle/solve/condensation.hpp"
#include "crackle/solve/estimates.hpp"
#include "dfit.hpp"
#include "paths.hpp"

namespace crackle {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

// Three steps of pumping; then every equation is written again without condensation: forces at every node of
// the mesh with its nodes split, and mass in every cell.
TEST(QuasiStaticEquations, FullResidual) {
  QuasiStaticScene s = dfit::scene(0.5, 20.0);
  s.well.breakdown_pressure.reset();
  s.leak_off = std::monostate{};
  QuasiStatic stage(s);
  quasi_static::State before;
  QuasiStaticRow row;
  for (int i = 0; i < 3; ++i) {
    before = stage.state();
    row = stage.step(1.0);
  }
  const quasi_static::State& state = stage.state();
  const Mesh& mesh = *s.mesh;
  const Bulk bulk(mesh, s.stiffness, 1.0, {}, {});
  // Forces of the rock on the nodes of the split mesh: a corner belongs to the sector that moved, or not.
  std::map<std::pair<Index, bool>, Vec2> force;
  double scale = 0.0;
  std::vector<std::vector<Index>> sector(mesh.vertices.size());
  for (const JumpUnknown& u : stage.path().unknowns()) sector[at(u.vertex)] = u.triangles;
  const std::vector<Vec2> moved = stage.corner_displacement();
  const std::vector<Sym2> stress = stage.stress(moved);
  for (Index t = 0; t < mesh.triangle_count(); ++t) {
    const auto g = bulk.shape_gradients(t);
    for (std::size_t i = 0; i < 3; ++i) {
      const Index v = mesh.triangles[at(t)][i];
      const auto& list = sector[at(v)];
      const Vec2 f = -bulk.area(t) * ((stress[at(t)] + -1.0 * s.stress) * g[i]);
      force[{v, std::binary_search(list.begin(), list.end(), t)}] += f;
      scale = std::max(scale, norm(f));
    }
  }
  // Fluid, bonds and in-situ stress on both faces of every edge of the path.
  for (std::size_t c = 0; c < state.cells.size(); ++c) {
    const PathEdge& edge = stage.path().edges()[c];
    const InterfaceLaw law(s.law,
                           resolved_strength(s.cohesive.tensile_strength, plane_strain_modulus(s.stiffness),
                                             s.cohesive.fracture_energy_mode1, edge.length, s.edges_per_zone),
                           s.cohesive.fracture_energy_mode1, s.closure);
    const FractureCell cell = stage.cells()[c];
    for (std::size_t i = 0; i < 2; ++i) {
      const double history = c < before.cells.size() ? before.cells[c].points[i].max_opening : 0.0;
      const quasi_static::Point& point = state.cells[c].points[i];
      const double pull = law.traction(cell.opening[i], history, point.bond).traction - point.in_situ -
                          (cell.pressure - s.pore_pressure);
      const Vec2 f = 0.5 * edge.length * pull * edge.normal;
      const Edge& e = mesh.edges[at(edge.edge)];
      for (std::size_t side = 0; side < 2; ++side) {
        const auto& list = sector[at(edge.vertex[i])];
        force[{edge.vertex[i], std::binary_search(list.begin(), list.end(), e.triangle[side])}] +=
            side == 0 ? f : -1.0 * f;
      }
    }
  }
  double worst = 0.0;
  for (const auto& [node, f] : force) {
    const int held = s.held[at(node.first)];
    if (!(held & 1)) worst = std::max(worst, std::abs(f.x));
    if (!(held & 2)) worst = std::max(worst, std::abs(f.y));
  }
  const double lost = std::abs(row.mass_defect) / row.injected;
  accept(2, "condensed stage, three steps, in the full equations of the split mesh: force, mass", "1e-8",
         text("%.1e, %.1e", worst / scale, lost), worst / scale <= 1e-8 && lost <= 1e-8);
  EXPECT_LT(worst / scale, 1e-8);
  EXPECT_LT(lost, 1e-8);
}

// S w = load.
std::vector<double> by_conjugate_gradients(const Condensation& rock, std::vector<double> left) {
  const std::size_t n = left.size();
  const auto dot = [](const std::vector<double>& a, const std::vector<double>& b) {
    return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
  };
  std::vector<double> w(n, 0.0), way = left, force(n);
  const double enough = 1e-24 * dot(left, left);
  for (double now = dot(left, left); now > enough;) {
    for (std::size_t i = 0; i < n; ++i) {
      force[i] = 0.0;
      for (std::size_t j = 0; j < n; ++j) force[i] += (i > j ? rock.row(i)[j] : rock.row(j)[i]) * way[j];
    }
    const double step = now / dot(way, force);
    for (std::size_t i = 0; i < n; ++i) {
      w[i] += step * way[i];
      left[i] -= step * force[i];
    }
    const double next = dot(left, left);
    for (std::size_t i = 0; i < n; ++i) way[i] = left[i] + next / now * way[i];
    now = next;
  }
  return w;
}

// Uniform pressure in a crack of so many edges a wing; free boundary 20 lengths away. Error of the opening
// [%].
double griffith(int edges) {
  const double length = 10.0, step = length / edges, pressure = 1e6;
  auto mesh = wing::mesh(step, 1.5 * length, 20.0 * length);
  const Held held = wing::symmetric(*mesh);
  const PlaneStiffness stiffness = isotropic_plane_strain(30e9, 0.25);
  const Bulk bulk(*mesh, stiffness, 1.0, {}, {});
  FracturePath path(mesh, held, false);
  Index inner = -1, parent = -1;
  for (const Index e : edges_along(*mesh, {0.0, 0.0}, {length, 0.0})) {
    const Edge& edge = mesh->edges[at(e)];
    if (inner < 0) inner = mesh->vertices[at(edge.vertex[0])].x == 0.0 ? edge.vertex[0] : edge.vertex[1];
    parent = path.add(e, inner, parent);
    inner = path.edges()[at(parent)].vertex[1];
  }
  Condensation rock(mesh, bulk, held);
  rock.follow(path.unknowns());
  std::vector<double> load(rock.size(), 0.0);
  for (const PathEdge& e : path.edges()) {
    for (const auto& end : e.jump) {
      for (const JumpTerm& t : end) load[at(t.unknown)] += 0.5 * e.length * pressure * t.normal;
    }
  }
  const std::vector<double> w = by_conjugate_gradients(rock, load);
  const double exact = 4.0 * pressure * length / plane_strain_modulus(stiffness);
  const double opening = std::abs(w[0] * path.edges()[0].jump[0].front().normal);
  return 100.0 * (opening / exact - 1.0);
}

TEST(QuasiStaticEquations, Griffith) {
  const double coarse = griffith(40), fine = griffith(80);
  accept(3, "Griffith's crack of 40 edges, R = 20 l: opening", "0.5 %", text("%+.2f %%", coarse),
         std::abs(coarse) <= 0.5);
  accept(3, "Griffith's crack of 80 edges, R = 20 l: opening", "0.5 %", text("%+.2f %%", fine),
         std::abs(fine) <= 0.5);
  EXPECT_LE(std::abs(coarse), 0.5);
  EXPECT_LE(std::abs(fine), 0.5);
}

// Volume at 1 Pa of a crack along the interface of two rocks, over that of Rice (1988, J. Appl. Mech. 55, 98,
// integrated): 2π a² (1 + 4ε²)/(E* cosh² πε), 2/E* = 1/E₁' + 1/E₂', ε by Dundurs' β. @param soft E₁/E₂
double along_interface(double soft) {
  using namespace paths;
  constexpr double a = 5.0, step = 0.125;
  QuasiStaticScene s = wide(a + 1.0, step, {});
  RockMass layer = s;
  layer.stiffness = isotropic_plane_strain(young / soft, poisson);
  set_layer(s, layer, [](Vec2 x) { return x.y < 0.0; });
  const Bulk bulk = bulk_of(s, {});
  FracturePath path(s.mesh, s.held, true);
  Index inner = vertex_at(*s.mesh, {-a, 0.0}), parent = -1;
  for (const Index e : edges_along(*s.mesh, {-a, 0.0}, {a, 0.0})) {
    parent = path.add(e, inner, parent);
    inner = path.edges()[at(parent)].vertex[1];
  }
  Condensation rock(s.mesh, bulk, s.held);
  rock.follow(path.unknowns());
  std::vector<double> load(rock.size(), 0.0);
  for (const PathEdge& e : path.edges()) {
    for (const auto& end : e.jump) {
      for (const JumpTerm& t : end) load[at(t.unknown)] += 0.5 * e.length * t.normal;
    }
  }
  const std::vector<double> jumps = by_conjugate_gradients(rock, load);
  const double kappa = 3.0 - 4.0 * poisson;
  const double beta = (soft - 1.0) * (kappa - 1.0) / ((soft + 1.0) * (kappa + 1.0));
  const double epsilon = std::log((1.0 - beta) / (1.0 + beta)) / (2.0 * M_PI);
  const double both = 2.0 * modulus / (1.0 + soft), c = std::cosh(M_PI * epsilon);
  return std::inner_product(load.begin(), load.end(), jumps.begin(), 0.0) /
         (2.0 * M_PI * a * a * (1.0 + 4.0 * epsilon * epsilon) / (both * c * c));
}

TEST(QuasiStaticEquations, CrackAlongAnInterface) {
  const double one = along_interface(1.0), two = along_interface(4.0);
  accept(
      25,
      "crack along the interface of a rock and one of a quarter of its modulus: volume; the same in one rock",
      "3 %; they differ by 0.5 %", text("%+.2f %%; %+.2f %%", 100.0 * (two - 1.0), 100.0 * (one - 1.0)),
      std::abs(two - 1.0) <= 0.03 && std::abs(two - one) <= 0.005);
  EXPECT_NEAR(two, 1.0, 0.03) << "of the mesh";
  EXPECT_NEAR(two, one, 0.005);
}

}  // namespace
}  // namespace crackle
