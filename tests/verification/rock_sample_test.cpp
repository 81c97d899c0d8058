// SPDX-License-Identifier: GPL-3.0-or-later
//
// Samples of rock in a testing machine: a disc pressed across its diameter (validation.md B9) and a block
// pressed at its ends (B10), with cohesive elements on all edges:
//   disc    σ_xx in the middle = (2p/π) (sin 2α − α), p = F/(2αR) over arcs of 2α (Hondros 1959);
//           strength 2F/(πD) near f_t
//   block   strength 2 c cos φ/(1 − sin φ) (Mohr-Coulomb)
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "../granite.hpp"
#include "../result.hpp"

namespace crackle {
namespace {

using granite::at;

Scene sample(std::shared_ptr<const Mesh> mesh) {
  Scene scene = granite::scene(std::move(mesh));
  scene.damping.ratio = 0.1;
  scene.law = find_law("benzeggagh_kenane");
  scene.cohesive = granite::cohesive();
  scene.cohesive.penalty = scene.cohesive.tangential_penalty = 20.0 * granite::young_modulus;
  scene.contact = {scene.cohesive.penalty, scene.cohesive.penalty, scene.cohesive.tan_residual};
  return scene;
}

// Two platens that press nodes together along y, at a speed each that grows within the first tenth of
// a millisecond; along x the nodes are free.
class Press {
 public:
  Press(const Scene& scene, double speed, const std::function<bool(Vec2)>& under_platen)
      : simulation(scene), speed_(speed) {
    const State& state = simulation.state();
    for (Index n = 0; n < state.node_count(); ++n) {
      if (under_platen(state.node_reference(n))) pressed_.push_back(at(n));
    }
  }

  Simulation simulation;
  double closing = 0.0;  // of both platens [m]
  double force = 0.0;    // mean of both, over some 100 steps [N/m]

  void step() {
    State& state = simulation.state();
    const double dt = 0.8 * simulation.stable_limit();
    const double speed = speed_ * std::min(1.0, state.time / 1e-4);
    std::vector<double> before;
    for (const std::size_t n : pressed_) before.push_back(state.displacement[n].y);
    simulation.step(dt);
    double taken = 0.0;
    for (std::size_t k = 0; k < pressed_.size(); ++k) {
      const std::size_t n = pressed_[k];
      const double side = state.node_reference(static_cast<Index>(n)).y > 0.0 ? 1.0 : -1.0;
      const double velocity = -side * speed;
      taken += side * (state.velocity[n].y - velocity) / (dt * state.inverse_mass[n]);
      state.velocity[n].y = velocity;
      state.displacement[n].y = before[k] + dt * velocity;
    }
    closing += 2.0 * dt * speed;
    force += 0.01 * (0.5 * taken - force);
  }

 private:
  double speed_;
  std::vector<std::size_t> pressed_;
};

Index broken(const State& state) {
  return static_cast<Index>(std::count_if(state.cohesive.status.begin(), state.cohesive.status.end(),
                                          [](CohesiveStatus s) { return s >= CohesiveStatus::broken; }));
}

constexpr double radius = 0.1, arc = std::numbers::pi / 36.0;  // of the disc, α

// The core of a wellbore's mesh is a disc.
std::shared_ptr<const Mesh> disc(double size) {
  MeshRecipe recipe;
  recipe.width = recipe.height = 3.0 * radius;
  recipe.wellbore_diameter = 2.0 * radius;
  recipe.wellbore_segments = 72;
  recipe.size_fine = recipe.size_coarse = size;
  recipe.fine_radius = 2.0 * radius;
  const Mesh whole = generate_mesh(recipe);
  Mesh core;
  std::vector<Index> number(whole.vertices.size(), -1);
  for (Index t = 0; t < whole.triangle_count(); ++t) {
    if (whole.regions[at(t)] != Region::wellbore_core) continue;
    core.triangles.push_back(whole.triangles[at(t)]);
    for (Index& v : core.triangles.back()) {
      if (number[at(v)] < 0) {
        number[at(v)] = core.vertex_count();
        core.vertices.push_back(whole.vertices[at(v)]);
      }
      v = number[at(v)];
    }
  }
  core.regions.assign(core.triangles.size(), Region::rock);
  build_edges(core);
  return granite::free_body(std::move(core));
}

TEST(RockSample, DiscSplitsAcrossItsMiddle) {
  const Check stress_check("B9 Brazilian disc: stress in the middle"),
      strength_check("B9 Brazilian disc: strength over f_t");
  const Scene scene = sample(disc(4e-3));
  Press press(scene, 0.03, [](Vec2 x) {
    return norm(x) > 0.995 * radius * std::cos(arc) && std::abs(x.x) < radius * std::sin(arc) + 1e-9;
  });
  const State& state = press.simulation.state();
  const double ideal = scene.cohesive.tensile_strength * std::numbers::pi * radius;  // force at 2F/(πD) = f_t
  double peak = 0.0, stress_error = 0.0;
  int samples = 0;
  Vec2 first;
  while (state.time < 8e-3 && press.force > 0.6 * peak - 0.05 * ideal) {
    press.step();
    peak = std::max(peak, press.force);
    if (press.force > 0.3 * ideal && press.force < 0.5 * ideal && peak == press.force) {
      Sym2 mean;
      double area = 0.0;
      for (Index t = 0; t < scene.mesh->triangle_count(); ++t) {
        if (norm(granite::centroid(*scene.mesh, t)) > 0.15 * radius) continue;
        mean = mean + press.simulation.bulk().area(t) * press.simulation.bulk().stress(state, t);
        area += press.simulation.bulk().area(t);
      }
      const double exact = press.force / (arc * radius * std::numbers::pi) * (std::sin(2.0 * arc) - arc);
      stress_error += mean.xx / area / exact - 1.0;
      ++samples;
    }
    if (!press.simulation.new_events().empty() && first == Vec2{})
      first = press.simulation.new_events()[0].place;
  }
  const double strength = peak / ideal;
  std::printf(
      "disc of %d triangles: stress in the middle %+.1f %%, strength %.3f f_t, first break %.0f mm from the "
      "middle, %d broken\n",
      scene.mesh->triangle_count(), 100 * stress_error / samples, strength, 1e3 * norm(first), broken(state));
  stress_check.result(stress_error / samples);
  strength_check.result(strength - 1.0);
  EXPECT_LT(std::abs(stress_error / samples), 0.05);
  EXPECT_GT(strength, 0.85);
  EXPECT_LT(strength, 1.15);
  EXPECT_LT(norm(first), 0.5 * radius);
}

TEST(RockSample, BlockFailsAtMohrAndCoulombsStress) {
  const Check check("B10 uniaxial compression: strength");
  MeshRecipe recipe;
  recipe.width = 0.05;
  recipe.height = 0.1;
  recipe.size_fine = recipe.size_coarse = 3e-3;
  recipe.fine_radius = 1.0;
  const Scene scene = sample(granite::free_body(generate_mesh(recipe)));
  Press press(scene, 0.1, [](Vec2 x) { return std::abs(x.y) > 0.05 - 1e-9; });
  const double phi = 38.0 * std::numbers::pi / 180.0;
  const double exact = 2.0 * scene.cohesive.cohesion * std::cos(phi) / (1.0 - std::sin(phi));
  double peak = 0.0;
  while (press.simulation.state().time < 5e-3 && press.force > 0.7 * peak - 1e5) {
    press.step();
    peak = std::max(peak, press.force);
  }
  const double strength = peak / 0.05;
  std::printf("block of %d triangles: strength %.1f MPa at a strain of %.2e (%+.1f %%), %d broken\n",
              scene.mesh->triangle_count(), 1e-6 * strength, press.closing / 0.1,
              100 * (strength / exact - 1.0), broken(press.simulation.state()));
  check.result(strength / exact - 1.0);
  EXPECT_GT(strength / exact, 0.85);
  EXPECT_LT(strength / exact, 1.15);
}

}  // namespace
}  // namespace crackle
