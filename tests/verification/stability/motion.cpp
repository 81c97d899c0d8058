// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "crackle/solve/estimates.hpp"
#include "scenes.hpp"

namespace crackle::stability {
namespace {

using granite::at;

constexpr double h = 3e-3;  // [m]

}  // namespace

Row activation(const std::string& setting, double x) {
  Scene scene = granite::scene(std::make_shared<const Mesh>(
      jittered(structured_rectangle({0, 0}, {40 * h, 8 * h}, 40, 8, MeshPattern::cross), 0.2, 2)));
  scene.law = find_law("linear");
  scene.cohesive = granite::cohesive();
  scene.insertion.on_demand = insertion_of(setting) == "on_demand";
  scene.insertion.threshold = 0.8 * x;  // elements come in the first steps
  scene.stress = {x * scene.cohesive.tensile_strength, 0.0, 0.0};
  Simulation begun(scene);
  const double dt = 0.5 * begun.stable_limit();
  for (int i = 0; i < 3; ++i) begun.step(dt);
  State loaded = begun.state();
  if (is_naive(setting)) {  // as if they came unloaded
    for (auto& offset : loaded.cohesive.offset) offset = {};
  }
  Simulation simulation(scene, std::move(loaded), begun.memory());
  const State& state = simulation.state();
  Row row{"activation", setting, x};
  row.predicted = is_naive(setting) ? 1.0 : 0.0;
  row.fastest = 0.0;
  for (int i = 0; i < 400; ++i) {
    simulation.step(dt);
    for (const Vec2 v : state.velocity) row.fastest = std::max(row.fastest, norm(v));
  }
  row.measured =
      scene.density * wave_speeds(scene.stiffness, scene.density).p * row.fastest / scene.stress.xx;
  row.broken = static_cast<long>(std::count_if(state.cohesive.status.begin(), state.cohesive.status.end(),
                                               [](CohesiveStatus s) { return s >= CohesiveStatus::broken; }));
  return row;
}

Row rotation(const std::string& setting, double x) {
  Scene scene = granite::scene(granite::free_body(
      jittered(structured_rectangle({0, 0}, {1, 0.7}, 6, 5, MeshPattern::cross), 0.25, 2)));
  scene.law = find_law("benzeggagh_kenane");
  scene.cohesive = granite::cohesive();
  scene.cohesive.calibration = Calibration::y_geo;
  scene.insertion.on_demand = insertion_of(setting) == "on_demand";
  std::vector<Index> edges;
  for (Index e = 0; e < scene.mesh->edge_count(); e += 5) {
    if (scene.mesh->edges[at(e)].kind == EdgeKind::interior) edges.push_back(e);
  }
  prepare_cut(scene, edges);
  Simulation simulation(scene);
  State& state = simulation.state();
  const double angle = x * std::numbers::pi / 180.0, c = std::cos(angle), s = std::sin(angle);
  for (Index n = 0; n < state.node_count(); ++n) {
    const Vec2 p = state.node_reference(n);
    state.displacement[at(n)] = Vec2{c * p.x - s * p.y, s * p.x + c * p.y} - p;
  }
  Row row{"rotation", setting, x};
  row.predicted = row.measured = 0.0;
  const Bulk& bulk = simulation.bulk();
  for (Index t = 0; t < state.mesh->triangle_count(); ++t) {
    Sym2 stress = bulk.stress(state, t);
    if (is_naive(setting)) {
      Sym2 strain;
      const auto gradient = bulk.shape_gradients(t);
      for (Index i = 0; i < 3; ++i) {
        const Vec2 u = state.displacement[at(state.node_of_corner[at(3 * t + i)])], g = gradient[at(i)];
        strain = strain + Sym2{u.x * g.x, u.y * g.y, 0.5 * (u.x * g.y + u.y * g.x)};
      }
      stress = scene.stiffness.stress(strain);
    }
    row.measured = std::max(row.measured, granite::larger_part(stress) / granite::young_modulus);
  }
  if (is_naive(setting)) {
    row.predicted = (scene.stiffness.c11 + scene.stiffness.c12) * (1.0 - c) / granite::young_modulus;
    return row;
  }
  simulation.step(1e-12);
  for (const EndForces& f : state.cohesive.force) {
    row.measured =
        std::max(row.measured, std::max(norm(f.end0), norm(f.end1)) / (0.1 * granite::young_modulus));
  }
  return row;
}

Row precision(const std::string& setting, double x) {
  Scene scene = granite::scene(granite::free_body(
      jittered(structured_rectangle({x, 0}, {x + 6 * h, 6 * h}, 6, 6, MeshPattern::cross), 0.2, 2)));
  const bool elements = insertion_of(setting) == "all";
  if (elements) {
    scene.law = find_law("linear");
    scene.cohesive = granite::unbreakable(120e9);
  }
  Simulation simulation(scene);
  State& state = simulation.state();
  const auto loads = [&] {  // tractions of the elements, or stresses where there are none [Pa]
    std::vector<double> all;
    for (Index e = 0; e < state.cohesive.count(); ++e) {
      const EndSeparation w = simulation.cohesive()->separation(state, e);
      const double k = 120e9 * state.cohesive.inverse_length[at(e)];
      for (const double d : {w.opening0, w.slip0, w.opening1, w.slip1}) all.push_back(k * d);
    }
    for (Index t = 0; !elements && t < state.mesh->triangle_count(); ++t) {
      const Sym2 stress = simulation.bulk().stress(state, t);
      all.insert(all.end(), {stress.xx, stress.yy, stress.xy});
    }
    return all;
  };
  // Motion as in the scenes: a fraction of the opening at which an edge has its strength.
  for (Index n = 0; n < state.node_count(); ++n)
    state.displacement[at(n)] = {3e-7 * std::sin(1.3 * n), 3e-7 * std::cos(1.7 * n)};
  const std::vector<double> exact = loads();
  const auto rounded = [&](double reference, double u) {
    return is_naive(setting) ? static_cast<double>(static_cast<float>(reference + u)) - reference
                             : static_cast<double>(static_cast<float>(u));
  };
  for (Index n = 0; n < state.node_count(); ++n) {
    const Vec2 p = state.node_reference(n);
    state.displacement[at(n)] = {rounded(p.x, state.displacement[at(n)].x),
                                 rounded(p.y, state.displacement[at(n)].y)};
  }
  const std::vector<double> now = loads();
  Row row{"precision", setting, x};
  row.measured = 0.0;
  for (std::size_t i = 0; i < now.size(); ++i)
    row.measured = std::max(row.measured, std::abs(now[i] - exact[i]) / granite::cohesive().tensile_strength);
  const double place = is_naive(setting) ? x + 6 * h : 3e-7;
  const float near = static_cast<float>(place);
  const double ulp = std::nextafter(near, std::numeric_limits<float>::infinity()) - near;
  const double stiffness = elements ? 120e9 : scene.stiffness.c11;
  row.predicted = stiffness * ulp / (h / std::sqrt(2.0)) / granite::cohesive().tensile_strength;
  return row;
}

}  // namespace crackle::stability
