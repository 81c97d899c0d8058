// SPDX-License-Identifier: GPL-3.0-or-later
#include <map>

#include "crackle/core/errors.hpp"
#include "crackle/solve/estimates.hpp"
#include "scenes.hpp"

namespace crackle::stability {
namespace {

using granite::at;

double fastest_node(const State& state) {
  double most = 0.0;
  for (const Vec2 v : state.velocity) most = v.x == v.x ? std::max(most, norm(v)) : 1e300;
  return most;
}

}  // namespace

Row handover(const std::string& setting, double x) {
  constexpr double h = 0.01, compression = 20e6;
  Scene scene = granite::scene(std::make_shared<const Mesh>(
      structured_rectangle({-10 * h, -10 * h}, {10 * h, 10 * h}, 20, 20, MeshPattern::cross)));
  scene.stress = {-compression, -compression, 0.0};
  scene.law = find_law("benzeggagh_kenane");
  scene.cohesive = granite::unbreakable(120e9);
  scene.insertion.on_demand = insertion_of(setting) == "on_demand";
  scene.insertion.threshold = 1e6;
  scene.contact = {x * scene.cohesive.penalty, x * scene.cohesive.penalty, scene.cohesive.tan_residual};
  const std::vector<Index> edges = edges_on_axis(*scene.mesh, 0.0, 5 * h);
  prepare_cut(scene, edges);
  Simulation simulation(scene);
  State& state = simulation.state();
  cut(simulation, edges);
  const double penalty =
      simulation.cohesive()->material(state, state.cohesive.of_edge[at(edges.front())]).penalty;
  const double per_area = compression * compression * h / penalty;  // [J/m2]
  double length = 0.0;
  for (const Index e : edges) length += norm(state.cohesive.direction[at(state.cohesive.of_edge[at(e)])]);
  Row row{"handover", setting, x};
  row.predicted = 0.0;
  if (is_naive(setting)) {  // nothing is handed over: general contact meets the faces anew
    for (const Index e : edges)
      state.cohesive.status[at(state.cohesive.of_edge[at(e)])] = CohesiveStatus::released;
    row.predicted = 0.5 * penalty / scene.contact.normal_penalty;
  }
  // The step follows the contact only once it is there.
  const double share = 0.7 / std::sqrt(1.0 + scene.contact.normal_penalty / penalty);
  double burst = 0.0;
  for (int i = 0; i < 300; ++i) {
    burst = std::max(burst, simulation.step_and_account(share * simulation.stable_limit()).kinetic);
  }
  row.measured = burst / (length * per_area);
  row.fastest = fastest_node(state);
  return row;
}

Row thin_crack(const std::string& setting, double x, double y) {
  constexpr double side = 0.4, half = 0.1;
  constexpr int cells = 20;
  Scene scene = granite::scene(std::make_shared<const Mesh>(structured_rectangle(
      {-0.5 * side, -0.5 * side}, {0.5 * side, 0.5 * side}, cells, cells, MeshPattern::right)));
  scene.law = find_law("benzeggagh_kenane");
  scene.cohesive = granite::unbreakable(10.0 * granite::young_modulus);
  scene.insertion.on_demand = insertion_of(setting) == "on_demand";
  scene.insertion.threshold = 1e6;
  const std::vector<Index> crack = edges_on_axis(*scene.mesh, 0.0, half);
  prepare_cut(scene, crack);
  Simulation simulation(scene);
  State& state = simulation.state();
  cut(simulation, crack);
  // Ajar like an ellipse, the rock about it bent as far as the crack is long.
  for (Index n = 0; n < state.node_count(); ++n) {
    const Vec2 p = state.node_reference(n);
    if (std::abs(p.x) >= half || state.inverse_mass[at(n)] == 0.0) continue;
    const Index corner = state.node_corners[at(state.node_first[at(n)])];
    const bool upper = std::abs(p.y) > 1e-9 ? p.y > 0.0 : granite::centroid(*state.mesh, corner / 3).y > 0.0;
    const double bend =
        std::sqrt(1.0 - p.x * p.x / (half * half)) * std::max(0.0, 1.0 - std::abs(p.y) / half);
    state.displacement[at(n)].y = (upper ? 0.5 : -0.5) * y * bend;
  }
  Fluid fluid(state, {x, 1000.0, 0.0}, Pump{});
  fluid.fill(state, crack, 0.0);
  Cavity& cavity = state.fluid.cavities[0];
  const double dt = 0.8 * simulation.stable_limit();
  Row row{"thin_crack", setting, x, y};
  // (ω_f Δt)² = Δt² K/V Σ |a|²/m, a the wall's force at unit pressure
  cavity.pressure = 1.0;
  std::map<Index, Vec2> gradient;
  for (const Fluid::CornerLoad& load : fluid.corner_loads(state))
    gradient[state.node_of_corner[at(load.corner)]] += load.force;
  cavity.pressure = 0.0;
  double sum = 0.0;
  for (const auto& [node, a] : gradient) sum += dot(a, a) * state.inverse_mass[at(node)];
  row.predicted = dt * dt * x / cavity.volume * sum;
  const double rebound = wave_speeds(scene.stiffness, scene.density).p * y / half;
  row.fastest = 0.0;
  int steps = 0;
  try {
    for (; steps < 500; ++steps) {
      if (is_naive(setting)) {
        for (const Fluid::CornerLoad& load : fluid.corner_loads(state)) {
          const Index n = state.node_of_corner[at(load.corner)];
          state.velocity[at(n)] += (dt * state.inverse_mass[at(n)]) * load.force;
        }
        simulation.step(dt);
        fluid.rebuild(state);
        if (!(fluid.volume(0) > 0.0)) throw NumericalError("the walls have gone through one another");
        cavity.volume = fluid.volume(0);
        cavity.pressure = fluid.properties().pressure(cavity.mass, cavity.volume);
      } else {
        simulation.step(dt);
        fluid.advance(state, dt);
      }
      row.fastest = std::max(row.fastest, fastest_node(state));
      if (row.fastest > 1e3 * rebound) throw NumericalError("the walls fly apart");
    }
  } catch (const NumericalError& error) {
    row.alarm = error.what();
    row.alarm_step = steps;
  }
  row.measured = row.fastest / rebound;
  return row;
}

Row drawing(const std::string& setting, double x) {
  Scene scene =
      granite::scene(granite::make({.segments = 24, .width = 2.0, .fine_radius = 0.06, .size_coarse = 0.3}));
  scene.law = find_law("benzeggagh_kenane");
  scene.cohesive = granite::unbreakable(10.0 * granite::young_modulus);
  scene.insertion.on_demand = setting == "on_demand";
  scene.insertion.threshold = 1e6;
  scene.damping.ratio = 0.5;
  scene.fluid = CompressibleFluid{2.2e9, 1000.0, 0.0};
  const double area = granite::hole_area(*scene.mesh), time = 0.1e-3;
  scene.pump = Pump({{0.0, time, -x * area / time}});
  Simulation simulation(scene);
  Row row{"drawing", setting, x};
  try {
    const double dt = 0.8 * simulation.stable_limit();
    while (simulation.state().time < 2.0 * time) simulation.step(dt);
    row.measured = simulation.wellbore_pressure();
  } catch (const NumericalError& error) {
    row.alarm = error.what();
    row.alarm_step = simulation.state().step;
  }
  // m/m₀ = 1 − x in the volume V₀ (1 + p/μ): p = K ln((1 − x)/(1 + p/μ))
  double p = 0.0;
  for (int i = 0; i < 200 && x < 1.0; ++i)
    p = 0.5 * (p + 2.2e9 * std::log((1.0 - x) / (1.0 + p / scene.stiffness.c66)));
  if (x < 1.0) row.predicted = p;
  return row;
}

}  // namespace crackle::stability
