// SPDX-License-Identifier: GPL-3.0-or-later
//
// The step at which a slightly disturbed body blows up, by bisection.
#include "crackle/solve/lanczos.hpp"
#include "scenes.hpp"

namespace crackle::stability {
namespace {

using granite::at;

constexpr int cells = 6;
constexpr double h = 0.05;  // [m]

struct Body {
  std::shared_ptr<const Mesh> mesh;
  std::string setting;
  double penalty = 10.0;  // over E
  Bulk::Damping damping;
  double poisson = granite::poisson_ratio;
};

Scene scene_of(const Body& body) {
  Scene scene = granite::scene(body.mesh);
  scene.stiffness = isotropic_plane_strain(granite::young_modulus, body.poisson);
  scene.damping = body.damping;
  if (body.setting == "tied") return scene;
  scene.law = find_law("linear");
  scene.cohesive = granite::unbreakable(body.penalty * granite::young_modulus);
  scene.insertion.on_demand = body.setting == "on_demand";
  if (scene.insertion.on_demand) {
    scene.joint_materials = {scene.cohesive};
    for (Index e = 0; e < body.mesh->edge_count(); e += 5) {
      if (body.mesh->edges[at(e)].kind == EdgeKind::interior) scene.joints.push_back({e, 1, true});
    }
  }
  return scene;
}

bool stays_bounded(const Scene& scene, double dt) {
  Simulation simulation(scene);
  State& state = simulation.state();
  for (Index n = 0; n < state.node_count(); ++n) {
    state.velocity[at(n)] = {1e-9 * std::sin(37.0 * n), 1e-9 * std::cos(53.0 * n)};
  }
  const auto fastest = [&] {
    double most = 0.0;
    for (const Vec2 v : state.velocity) most = v.x == v.x ? std::max(most, norm(v)) : 1.0;
    return most;
  };
  for (int i = 0; i < 600; ++i) {
    simulation.step(dt);
    if (i % 50 == 0 && !(fastest() < 1e-5)) return false;
  }
  return fastest() < 1e-7;
}

// Steps over h √(ρ/E).
Row limit_of(const char* name, const Body& body, double x, double edge = h) {
  const Scene scene = scene_of(body);
  const Simulation simulation(scene);
  const double unit = edge * std::sqrt(granite::density / granite::young_modulus);
  Row row{name, body.setting, x};
  row.bound = simulation.stable_limit() / unit;
  row.predicted =
      highest_frequency(simulation.state(), simulation.bulk(), simulation.cohesive()).stable_step() / unit;
  double low = 0.5 * row.predicted, high = row.predicted;
  while (high < 30.0 * row.predicted && stays_bounded(scene, high * unit)) low = high, high *= 1.15;
  for (int i = 0; i < 9; ++i) {
    const double middle = 0.5 * (low + high);
    (stays_bounded(scene, middle * unit) ? low : high) = middle;
  }
  row.measured = low;
  return row;
}

Mesh square(int n, double side) {
  return structured_rectangle({0, 0}, {side, side}, n, n, MeshPattern::cross);
}

std::shared_ptr<const Mesh> jittered_square() {
  return granite::free_body(jittered(square(cells, cells * h), 0.25, 3));
}

}  // namespace

Row penalty(const std::string& setting, double x) {
  return limit_of("penalty", {jittered_square(), setting, x, {}}, x);
}

Row damping(const std::string& setting, double x) {
  return limit_of("damping", {jittered_square(), setting, 10.0, {0.0, x}}, x);
}

Row viscosity(const std::string& setting, double x) {
  const int n = static_cast<int>(std::lround(4 / x));
  const double critical = 2.0 * h * std::sqrt(granite::young_modulus * granite::density);
  return limit_of("viscosity", {granite::free_body(square(n, 4 * h)), setting, 10.0, {critical, 0.0}}, x);
}

Row poisson(const std::string& setting, double x) {
  return limit_of("poisson", {jittered_square(), setting, 10.0, {}, x}, x);
}

// Isosceles triangles of edge h with that angle at both ends.
Row skew(const std::string& setting, double x) {
  const double step = 0.5 * h * std::tan(x * std::numbers::pi / 180.0);
  Mesh mesh = structured_rectangle({0, 0}, {cells * h, 2 * cells * step}, cells, 2 * cells,
                                   MeshPattern::shifted_rows);
  return limit_of("skew", {granite::free_body(std::move(mesh)), setting, 10.0, {}}, x);
}

}  // namespace crackle::stability
