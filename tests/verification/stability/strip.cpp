// SPDX-License-Identifier: GPL-3.0-or-later
#include <stdexcept>

#include "crackle/core/errors.hpp"
#include "crackle/solve/estimates.hpp"
#include "crackle/solve/guards.hpp"
#include "crackle/solve/lanczos.hpp"
#include "scenes.hpp"

namespace crackle::stability {

using granite::at;

std::vector<Index> edges_on_axis(const Mesh& mesh, double centre, double half) {
  std::vector<Index> found;
  for (Index e = 0; e < mesh.edge_count(); ++e) {
    const Edge& edge = mesh.edges[at(e)];
    const auto off = [&](Index v) {
      const Vec2 x = mesh.vertices[at(v)];
      return std::abs(x.y) > 1e-9 || std::abs(x.x - centre) > half + 1e-9;
    };
    if (edge.kind == EdgeKind::interior && !off(edge.vertex[0]) && !off(edge.vertex[1])) found.push_back(e);
  }
  return found;
}

void prepare_cut(Scene& scene, const std::vector<Index>& edges) {
  CohesiveMaterial strong = scene.cohesive;
  strong.tensile_strength = strong.cohesion = 1e15;
  strong.fracture_energy_mode1 = strong.fracture_energy_mode2 = 1e15;
  strong.calibration = Calibration::y_geo;
  scene.joint_materials = {strong};
  for (const Index e : edges) scene.joints.push_back({e, 1, true});
}

void cut(Simulation& simulation, const std::vector<Index>& edges) {
  State& state = simulation.state();
  for (const Index e : edges) simulation.cohesive()->cut(state, state.cohesive.of_edge[at(e)]);
}

Row strip(const std::string& setting, double x) {
  constexpr double h = 15e-3, height = 40 * h, width = 50 * h;
  constexpr double energy = 20.0;  // G_I: five edges in the cohesive zone of 74 mm [J/m2]
  Mesh mesh = structured_rectangle({-0.5 * width, -0.5 * height}, {0.5 * width, 0.5 * height}, 50, 40,
                                   MeshPattern::cross);
  Scene scene = granite::scene(
      granite::with_free_sides(std::move(mesh), [&](Vec2 p) { return std::abs(p.x) > 0.5 * width - 1e-9; }));
  scene.law = find_law("benzeggagh_kenane");
  scene.cohesive = granite::cohesive();
  scene.cohesive.fracture_energy_mode1 = energy;
  scene.cohesive.fracture_energy_mode2 = 16.0 * energy;
  scene.cohesive.penalty = scene.cohesive.tangential_penalty = 10.0 * granite::young_modulus;
  scene.insertion.on_demand = setting != "all";
  if (setting == "damage") {  // elements on the notch alone
    const CohesiveMaterial& c = scene.cohesive;
    scene.damage.law = find_softening("linear");
    scene.damage.materials = {DamageMaterial{c.tensile_strength, c.cohesion, c.tan_friction, c.tan_residual,
                                             c.fracture_energy_mode1, c.fracture_energy_mode2}};
  }
  scene.contact = {scene.cohesive.penalty, scene.cohesive.penalty, scene.cohesive.tan_residual};
  // A smeared crack that starts from a slit along a line of the mesh damages the triangles on both its sides.
  const double drive = setting == "damage" ? 3.0 : 1.2;
  scene.stress.yy = std::sqrt(2.0 * plane_strain_modulus(scene.stiffness) * drive * energy / height);
  const std::vector<Index> notch = edges_on_axis(*scene.mesh, -0.5 * width, 0.3 * width);
  prepare_cut(scene, notch);
  Simulation simulation(scene);
  const double limit =
      setting == "all"
          ? highest_frequency(simulation.state(), simulation.bulk(), simulation.cohesive()).stable_step()
          : simulation.stable_limit();
  cut(simulation, notch);
  Guards guards(simulation);
  Row row{"strip", setting, x};
  row.predicted = 1.0;
  row.bound = simulation.stable_limit() / limit;
  row.fastest = 0.0;
  const State& state = simulation.state();
  const double dt = x * limit, end = 0.4 * width / 1500.0;
  Energies last;
  try {
    while (state.time < end) {
      Energies e = simulation.step_and_account(dt);
      e.residual = 0.0;  // the cut is not in the ledger
      last = e;
      for (const Finding& f : guards.after_step(simulation, e)) {
        if (!f.stops || row.alarm_step >= 0) continue;
        row.alarm = f.text.substr(0, f.text.find_first_of(":(,"));
        row.alarm_step = state.step;
      }
      for (const Vec2 v : state.velocity) row.fastest = std::max(row.fastest, norm(v));
    }
  } catch (const NumericalError& error) {
    row.measured = 0.0;
    if (row.alarm_step < 0) row.alarm = "not finite", row.alarm_step = state.step;
  }
  double area = 0.0;
  for (Index i = 0; i < state.cohesive.count(); ++i) {
    const CohesiveStatus status = state.cohesive.status[at(i)];
    if (status >= CohesiveStatus::broken && state.cohesive.material[at(i)] == 0)
      area += norm(state.cohesive.direction[at(i)]);
  }
  const Dissipation& d = state.dissipation;
  row.broken = guards.memory().broken;
  for (const DamagedTriangle& t : state.damage.triangles) {
    if (t.failed == 0) continue;
    ++row.broken;
    area += simulation.bulk().area(t.triangle) / t.length;
  }
  row.stray = guards.memory().stray;
  row.joint_work = (last.cohesive + d.fracture + d.friction - d.made) / (energy * area);
  row.dissipated = d.fracture / (energy * area);
  row.made = d.made / std::max(d.fracture + d.friction, 1e-300);
  row.measured = area / (end * 1500.0);
  return row;
}

Row run(const std::string& scene, const std::string& setting, double x, double y) {
  if (scene == "strip") return strip(setting, x);
  if (scene == "penalty") return penalty(setting, x);
  if (scene == "damping") return damping(setting, x);
  if (scene == "viscosity") return viscosity(setting, x);
  if (scene == "poisson") return poisson(setting, x);
  if (scene == "skew") return skew(setting, x);
  if (scene == "handover") return handover(setting, x);
  if (scene == "thin_crack") return thin_crack(setting, x, y);
  if (scene == "activation") return activation(setting, x);
  if (scene == "rotation") return rotation(setting, x);
  if (scene == "precision") return precision(setting, x);
  if (scene == "drawing") return drawing(setting, x);
  if (scene == "turned") return turned(setting, x);
  throw std::invalid_argument("no such scene: " + scene);
}

}  // namespace crackle::stability
