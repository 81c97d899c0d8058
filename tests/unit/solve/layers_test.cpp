// SPDX-License-Identifier: GPL-3.0-or-later
//
// Layers: stiffness of a layered plate, stress that differs from layer to layer, waves at an interface, and
// elements that have their own layer's strength.
#include <gtest/gtest.h>

#include "../../granite.hpp"
#include "../../result.hpp"

namespace crackle {
namespace {

using granite::at;

RockMass rock(double young_modulus, double poisson_ratio, double density) {
  RockMass r;
  r.stiffness = isotropic_plane_strain(young_modulus, poisson_ratio);
  r.density = density;
  r.cohesive = granite::cohesive();
  return r;
}

// Of granite, with another rock above the line through a point with a normal.
Scene half_and_half(Mesh mesh, const RockMass& other, Vec2 point, Vec2 normal) {
  Scene scene = granite::scene(std::make_shared<const Mesh>(std::move(mesh)));
  scene.cohesive = granite::cohesive();
  scene.layers = {other};
  scene.layer_of_triangle.resize(scene.mesh->triangles.size());
  for (Index t = 0; t < scene.mesh->triangle_count(); ++t)
    scene.layer_of_triangle[at(t)] = dot(granite::centroid(*scene.mesh, t) - point, normal) > 0.0 ? 1 : 0;
  return scene;
}

// A mesh whose edges follow a line through the origin.
Mesh with_line(Vec2 along) {
  MeshRecipe recipe;
  recipe.width = recipe.height = 0.4;
  recipe.size_fine = recipe.size_coarse = 0.02;
  recipe.joints = {{-1.0 * along, along, 0}};
  recipe.joint_sets = {"interface"};
  return generate_mesh(recipe);
}

// Both rocks strained uniformly, each so that the traction on the interface is the same: nothing is
// unbalanced inside, and the mean stress over the mean strain across is that of springs in series (Backus
// 1962).
TEST(Layers, PatchOfTwoRocks) {
  for (const double dip : {0.0, 0.5}) {
    const Vec2 t{std::cos(dip), std::sin(dip)}, n{-t.y, t.x};
    const Scene scene = half_and_half(with_line(t), rock(10e9, 0.15, 2200.0), {}, n);
    const PlaneStiffness &a = scene.stiffness, &b = scene.layers[0].stiffness;
    // Common strain along, and a jump of the strain across with which σn is the same.
    const double along = 1e-8;
    const auto strain = [&](double across, double shear) {
      const auto part = [&](Vec2 u, Vec2 v) {
        return along * dot(u, t) * dot(v, t) + across * dot(u, n) * dot(v, n) +
               0.5 * shear * (dot(u, t) * dot(v, n) + dot(u, n) * dot(v, t));
      };
      const Vec2 x{1.0, 0.0}, y{0.0, 1.0};
      return Sym2{part(x, x), part(y, y), part(x, y)};
    };
    const double across_a = 2e-8, shear_a = 3e-8;
    const Sym2 stress_a = a.stress(strain(across_a, shear_a));
    const double pull = dot(n, stress_a * n), push = dot(t, stress_a * n);
    const double across_b = (pull - b.c12 * along) / b.c11, shear_b = push / b.c66;  // isotropic
    Simulation simulation(scene);
    State& state = simulation.state();
    for (Index v = 0; v < state.node_count(); ++v) {
      const Vec2 x = state.node_reference(v);
      const double height = dot(x, n);
      const double across = height > 0.0 ? across_b : across_a, shear = height > 0.0 ? shear_b : shear_a;
      state.displacement[at(v)] = (along * dot(x, t) + shear * height) * t + (across * height) * n;
    }
    const double unbalanced = simulation.imbalance();
    double sum = 0.0, area = 0.0;
    for (Index k = 0; k < state.mesh->triangle_count(); ++k) {
      sum += simulation.bulk().area(k) * dot(n, simulation.stress(k) * n);
      area += simulation.bulk().area(k);
    }
    std::printf("layers at %.1f rad: unbalanced %.1e, stress across off by %.1e\n", dip, unbalanced,
                sum / area / pull - 1.0);
    EXPECT_LT(unbalanced, 1e-6);  // the strain is finite
    EXPECT_NEAR(sum / area, pull, 1e-6 * pull);
  }
}

// Stress along the layers may differ: nothing moves. Across them it may not: the static stage finds where the
// interface comes to rest, far from the sides u = h Δσ / (C_a + C_b).
TEST(Layers, StressStepsComeToRestWithoutSteps) {
  struct Method {
    const char* name;
    bool law, demand, damage;
  };
  for (const Method& method :
       {Method{"all edges", true, false, false}, Method{"on demand", true, true, false},
        Method{"damage", false, false, true}}) {
    for (const bool balanced : {true, false}) {
      Mesh mesh =
          jittered(structured_rectangle({-0.3, -0.05}, {0.3, 0.05}, 60, 10, MeshPattern::cross), 0.0, 1);
      RockMass other = rock(10e9, 0.15, 2200.0);
      other.cohesive.penalty = 60e9;
      Scene scene = half_and_half(std::move(mesh), other, {}, {0.0, 1.0});
      scene.stress = {-7e6, -5e6, 0.0};
      scene.layers[0].stress = {-3e6, balanced ? -5e6 : -4.5e6, 0.0};
      if (method.law) scene.law = find_law("linear");
      scene.insertion.on_demand = method.demand;
      if (method.damage) {
        scene.damage.law = find_softening("linear");
        scene.damage.materials.assign(2, {3e6, 24e6, 0.78, 0.78, 5.0, 80.0});
        scene.damage.of_triangle = scene.layer_of_triangle;
      }
      Simulation simulation(scene);
      const State& state = simulation.state();
      const double expected = balanced ? 0.0 : 0.05 * 0.5e6 / (scene.stiffness.c11 + other.stiffness.c11);
      double moved = 0.0, middle = 0.0;
      for (Index n = 0; n < state.node_count(); ++n) {
        moved = std::max(moved, norm(state.displacement[at(n)]));
        if (norm(state.node_reference(n)) < 1e-9) middle = state.displacement[at(n)].y;
      }
      const double imbalance = simulation.imbalance();
      const double dt = 0.5 * simulation.stable_limit();
      for (int i = 0; i < 200; ++i) simulation.step(dt);
      double fastest = 0.0;
      for (const Vec2 v : state.velocity) fastest = std::max(fastest, norm(v));
      std::printf("%s, %s: interface moved by %.4e m (theory %.4e), imbalance %.0e, then %.0e m/s\n",
                  method.name, balanced ? "steps along" : "a step across", middle, expected, imbalance,
                  fastest);
      EXPECT_EQ(simulation.geostatic_slips(), 0);
      EXPECT_LT(imbalance, 1e-9);
      EXPECT_LT(fastest, 1e-8);
      if (balanced) {
        EXPECT_LT(moved, 1e-15);
      } else {
        EXPECT_NEAR(middle, expected, 5e-3 * expected);
      }
    }
  }
}

// A P pulse comes to an interface across: amplitudes of velocity R = (Z1 − Z2)/(Z1 + Z2), T = 2 Z1/(Z1 + Z2),
// Z = ρ c.
TEST(Layers, WavesAreReflectedByTheImpedanceRatio) {
  const Check check("waves at an interface of two rocks");
  double worst = 0.0;
  for (const auto& [young, density] : {std::pair{10e9, 2000.0}, {80e9, 3200.0}}) {
    const RockMass other = rock(young, 0.27, density);
    Mesh strip = jittered(structured_rectangle({0, 0}, {1, 0.05}, 200, 10, MeshPattern::cross), 0.0, 1);
    for (Edge& edge : strip.edges) {
      if (edge.kind == EdgeKind::outer) edge.kind = EdgeKind::wellbore;
    }
    Simulation simulation(half_and_half(std::move(strip), other, {0.5, 0.0}, {1.0, 0.0}));
    State& state = simulation.state();
    const double c1 = wave_speeds(granite::stiffness(), granite::density).p;
    const double c2 = wave_speeds(other.stiffness, other.density).p;
    const double z1 = granite::density * c1, z2 = other.density * c2;
    const double dt = 0.8 * simulation.stable().limit, width = 0.02, start = 0.3;
    std::vector<std::size_t> sides;
    for (Index n = 0; n < state.node_count(); ++n) {
      const Vec2 x = state.node_reference(n);
      const auto shape = [&](double s) { return std::exp(-0.5 * std::pow((s - start) / width, 2)); };
      state.displacement[at(n)] = {1e-6 * shape(x.x), 0.0};
      const double back = x.x + 0.5 * c1 * dt;
      state.velocity[at(n)] = {1e-6 * c1 * (back - start) / (width * width) * shape(back), 0.0};
      if (x.y == 0.0 || x.y == 0.05) sides.push_back(at(n));
    }
    while (state.time < 0.3 / c1) {
      simulation.step(dt);
      for (const std::size_t n : sides) {
        state.velocity[n].y = 0.0;
        state.displacement[n].y = 0.0;
      }
    }
    double reflected = 0.0, passed = 0.0;  // of a displacement of 1e-6 m
    for (Index n = 0; n < state.node_count(); ++n) {
      const double u = state.displacement[at(n)].x / 1e-6, x = state.node_reference(n).x;
      if (x < 0.48 && std::abs(u) > std::abs(reflected)) reflected = u;
      if (x > 0.52 && std::abs(u) > std::abs(passed)) passed = u;
    }
    const double r = (z1 - z2) / (z1 + z2), t = 2.0 * z1 / (z1 + z2);
    std::printf("impedances 1 to %.3f: reflected %+.4f (theory %+.4f), passed %.4f (%.4f)\n", z2 / z1,
                reflected, r, passed, t);
    worst = std::max({worst, std::abs(reflected - r), std::abs(passed - t)});
  }
  check.result(worst);
  EXPECT_LT(worst, 0.01);
}

// A column of two rocks is pulled apart: elements come with the strength of their own layer, on the interface
// with the lower one of each, and mass is kept as nodes part.
TEST(Layers, ElementsHaveTheStrengthOfTheirLayer) {
  RockMass weak = rock(20e9, 0.2, 2000.0);
  weak.cohesive.tensile_strength = 1e6;
  weak.cohesive.fracture_energy_mode2 = 200.0;
  for (const bool demand : {true, false}) {
    Mesh mesh =
        jittered(structured_rectangle({-0.06, -0.03}, {0.06, 0.03}, 24, 12, MeshPattern::cross), 0.0, 1);
    Scene scene = half_and_half(std::move(mesh), weak, {}, {0.0, 1.0});
    scene.law = find_law("linear");
    scene.insertion.on_demand = demand;
    scene.stress = {0.5e6, 0.5e6, 0.0};
    scene.layers[0].stress = scene.stress;
    Simulation simulation(scene);
    State& state = simulation.state();
    for (Index n = 0; n < state.node_count(); ++n) {
      if (state.inverse_mass[at(n)] > 0.0) state.velocity[at(n)] = {0.0, 3.0 * state.node_reference(n).y};
    }
    const auto momentum = [&] {
      double sum = 0.0;
      for (Index n = 0; n < state.node_count(); ++n) {
        if (state.node_size[at(n)] > 0 && state.inverse_mass[at(n)] > 0.0)
          sum += 1.0 / state.inverse_mass[at(n)];
      }
      return sum;
    };
    const double mass = momentum(), dt = 0.5 * simulation.stable_limit();
    for (int i = 0; i < 100; ++i) simulation.step(dt);
    Index above = 0, below = 0, between = 0;
    for (Index e = 0; e < state.cohesive.count(); ++e) {
      const Edge& edge = state.mesh->edges[at(state.cohesive.edge[at(e)])];
      const auto layer = [&](int k) { return scene.layer_of_triangle[at(edge.triangle[at(k)])]; };
      const CohesiveMaterial m = simulation.cohesive()->materials()[state.cohesive.material[at(e)]];
      if (layer(0) != layer(1)) {
        ++between;
        EXPECT_EQ(m.tensile_strength, 1e6);
        EXPECT_EQ(m.fracture_energy_mode2, scene.cohesive.fracture_energy_mode2);
      } else {
        ++(layer(0) == 1 ? above : below);
        EXPECT_EQ(m.tensile_strength, layer(0) == 1 ? 1e6 : 3e6);
      }
    }
    std::printf("%s: %d elements in the weak layer, %d on the interface, %d in the strong rock; mass %+.1e\n",
                demand ? "on demand" : "all edges", above, between, below, momentum() / mass - 1.0);
    EXPECT_GT(above, 50);
    if (demand) {
      EXPECT_LT(below, above / 2);
    }
    EXPECT_NEAR(momentum() / mass, 1.0, 1e-12);
  }
}

// The tiles sort a block's triangles by rock: the same steps as when both layers are of one rock, and the
// same bits for one thread and two (threads_test.cpp runs the tiles otherwise).
TEST(Layers, OfTheSameRockChangeNothing) {
  std::array<std::vector<Vec2>, 2> displacement;
  for (const bool layered : {false, true}) {
    Mesh mesh = jittered(structured_rectangle({0, 0}, {0.2, 0.1}, 40, 20, MeshPattern::cross), 0.2, 3);
    order_along_hilbert_curve(mesh);
    Scene scene = granite::scene(std::make_shared<const Mesh>(std::move(mesh)));
    scene.cohesive = granite::cohesive();
    scene.stress = granite::anisotropic;
    scene.damping.ratio = 0.1;
    if (layered) {
      scene.layers.assign(2, scene);
      for (Index t = 0; t < scene.mesh->triangle_count(); ++t)
        scene.layer_of_triangle.push_back(
            static_cast<std::uint16_t>(static_cast<int>(granite::centroid(*scene.mesh, t).y / 0.02) % 3));
    }
    Simulation simulation(scene);
    State& state = simulation.state();
    for (Index n = 0; n < state.node_count(); ++n) {
      if (state.inverse_mass[at(n)] > 0.0)
        state.velocity[at(n)] = {1e-2 * std::sin(80.0 * state.node_reference(n).y), 0.0};
    }
    const double dt = 0.8 * simulation.stable().limit;
    for (int i = 0; i < 300; ++i) simulation.step(dt);
    displacement[layered ? 1 : 0] = state.displacement;
  }
  double worst = 0.0, largest = 0.0;
  for (std::size_t n = 0; n < displacement[0].size(); ++n) {
    worst = std::max(worst, norm(displacement[0][n] - displacement[1][n]));
    largest = std::max(largest, norm(displacement[0][n]));
  }
  std::printf("three layers of one rock: displacements differ by %.1e\n", worst / largest);
  EXPECT_LT(worst, 1e-10 * largest);
}

}  // namespace
}  // namespace crackle
