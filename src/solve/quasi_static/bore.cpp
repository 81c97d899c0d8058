// SPDX-License-Identifier: GPL-3.0-or-later
#include "bore.hpp"

#include <algorithm>

#include "dynamics.hpp"

namespace crackle::quasi_static {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

// Of an edge of the wall, out of the rock; as long as the edge.
Vec2 out_of_rock(const Mesh& mesh, const Edge& edge) {
  return right_normal(mesh.vertices[at(edge.vertex[1])] - mesh.vertices[at(edge.vertex[0])]);
}

template <class Traction>  // on the rock, by triangle and outward normal
std::vector<PointLoad> on_the_wall(const Mesh& mesh, Traction&& traction) {
  std::vector<PointLoad> forces;
  for (const Edge& edge : mesh.edges) {
    if (edge.kind != EdgeKind::wellbore) continue;
    for (const Index v : edge.vertex)
      forces.push_back({edge.triangle[0], v, 0.5 * traction(edge.triangle[0], out_of_rock(mesh, edge))});
  }
  return forces;
}

double volume(const Equations& e, const State& state) {
  if (e.moving) return e.moving->bore_volume(state.jumps);
  const double p = state.well_pressure - e.scene.pore_pressure;
  double v = e.bore + e.rock.compliance(excavated, pressed) + p * e.rock.compliance(pressed, pressed);
  for (std::size_t k = 0; k < state.jumps.size(); ++k) v += e.rock.force(pressed, k) * state.jumps[k];
  return v;
}

}  // namespace

double bore_volume(const Mesh& mesh) {
  double twice = 0.0;
  for (const Edge& edge : mesh.edges) {
    if (edge.kind != EdgeKind::wellbore) continue;
    twice -= dot(mesh.vertices[at(edge.vertex[0])], out_of_rock(mesh, edge));
  }
  return 0.5 * twice;
}

bool on_wall(const Mesh& mesh, Index vertex) {
  return std::ranges::any_of(mesh.edges, [vertex](const Edge& edge) {
    return edge.kind == EdgeKind::wellbore && (edge.vertex[0] == vertex || edge.vertex[1] == vertex);
  });
}

void load_wall(const Mesh& mesh, const Bulk& bulk, Condensation& rock) {
  rock.add_load(on_the_wall(mesh, [&](Index t, Vec2 normal) { return -1.0 * (bulk.in_situ(t) * normal); }));
  rock.add_load(on_the_wall(mesh, [](Index, Vec2 normal) { return -1.0 * normal; }));
}

std::array<double, 2> wall_loads(const Equations& e, const State& state) {
  return {1.0, state.well_pressure - e.scene.pore_pressure};
}

std::vector<Vec2> displacement(const Equations& e, const State& state) {
  if (e.moving) return e.moving->displacement();
  if (e.bore == 0.0) return e.rock.displacement(state.jumps);
  return e.rock.displacement(state.jumps, wall_loads(e, state));
}

double fluid_in_bore(const Equations& e, const State& state) {
  return e.bore == 0.0 ? 0.0 : volume(e, state) * e.scene.fluid.density(state.well_pressure).value;
}

double well_storage(const Equations& e, const State& state) {
  if (e.bore == 0.0) return e.scene.well.storage;
  const ValueSlope density = e.scene.fluid.density(state.well_pressure);
  const double yields = e.moving ? 0.0 : e.rock.compliance(pressed, pressed);  // within an explicit step not
  return e.scene.well.storage + density.slope * volume(e, state) + density.value * yields;
}

void add_bore_energies(const Equations& e, const State& state, Energies& kept) {
  if (e.bore == 0.0) return;
  const double p = state.well_pressure - e.scene.pore_pressure;
  if (e.moving) {
    const double drilled = e.rock.compliance(excavated, excavated);
    kept.strain -= 0.5 * drilled;
    kept.confinement -= e.moving->work(excavated) - drilled;
  } else {
    const double moved = p * e.rock.compliance(excavated, pressed);
    kept.strain += moved + 0.5 * p * p * e.rock.compliance(pressed, pressed);
    kept.confinement -= moved;
    for (std::size_t k = 0; k < state.jumps.size(); ++k)
      kept.confinement -= e.rock.force(excavated, k) * state.jumps[k];
  }
  const double h =
      e.scene.fluid.enthalpy(state.well_pressure) - e.scene.fluid.enthalpy(e.scene.pore_pressure);
  kept.fluid += state.bore * h - p * volume(e, state);
}

}  // namespace crackle::quasi_static
