// SPDX-License-Identifier: GPL-3.0-or-later
#include "frames.hpp"

#include <algorithm>
#include <array>

#include "crackle/seismic/listener.hpp"

namespace crackle {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

}  // namespace

const std::vector<std::string>& field_names() {
  static const std::vector<std::string> names{"displacement_m", "velocity_m_s", "stress_Pa",
                                              "region",         "layer",        "damage"};
  return names;
}

FieldFrame field_frame(const Simulation& simulation, const std::vector<std::string>& fields) {
  const State& state = simulation.state();
  const auto wanted = [&](const char* name) {
    return fields.empty() || std::find(fields.begin(), fields.end(), name) != fields.end();
  };
  FieldFrame frame;
  frame.time = state.time;
  const Index triangles = state.mesh->triangle_count();
  // One field after the other, and none that is not wanted: a frame is the largest thing in memory. A point
  // is a node: where faces may part there are several at a place.
  const auto nodes = at(state.node_count());
  frame.points.reserve(nodes);
  for (Index n = 0; n < state.node_count(); ++n) {
    const bool used = state.node_size[at(n)] > 0;  // else a vertex that no triangle has
    frame.points.push_back(used ? state.node_reference(n) + state.displacement[at(n)] : Vec2{});
  }
  frame.triangles.reserve(at(triangles));
  for (Index t = 0; t < triangles; ++t) {
    const Index* n = &state.node_of_corner[at(3 * t)];
    frame.triangles.push_back({n[0], n[1], n[2]});
  }
  const auto add_of_nodes = [&](const char* name, const std::vector<Vec2>& values) {
    if (!wanted(name)) return;
    Field field{name, 2, {}};
    field.values.reserve(2 * nodes);
    for (const Vec2 v : values) {
      field.add(v.x);
      field.add(v.y);
    }
    frame.point_fields.push_back(std::move(field));
  };
  add_of_nodes("displacement_m", state.displacement);
  add_of_nodes("velocity_m_s", state.velocity);
  if (wanted("stress_Pa")) {
    Field stress{"stress_Pa", 3, {}};
    stress.values.reserve(at(3 * triangles));
    for (Index t = 0; t < triangles; ++t) {
      const Sym2 s = simulation.stress(t);
      for (const double value : {s.xx, s.yy, s.xy}) stress.add(value);
    }
    frame.cell_fields.push_back(std::move(stress));
  }
  if (wanted("region")) {
    Field region{"region", 1, {}};
    region.values.reserve(at(triangles));
    for (const Region r : state.mesh->regions) region.add(static_cast<double>(r));
    frame.cell_fields.push_back(std::move(region));
  }
  const std::vector<std::uint16_t>& layers = simulation.scene().layer_of_triangle;
  if (wanted("layer") && !layers.empty()) frame.cell_fields.push_back(layer_field(layers));
  if (wanted("damage") && !state.damage.of_triangle.empty()) {
    Field damage{"damage", 1, std::vector<float>(at(triangles))};
    for (const DamagedTriangle& d : state.damage.triangles)
      damage.values[at(d.triangle)] = static_cast<float>(d.damage);
    frame.cell_fields.push_back(std::move(damage));
  }
  return frame;
}

Field layer_field(const std::vector<std::uint16_t>& layers) {
  Field field{"layer", 1, {}};
  field.values.reserve(layers.size());
  for (const std::uint16_t layer : layers) field.add(layer);
  return field;
}

FractureFrame fracture_frame(const Simulation& simulation) {
  const State& state = simulation.state();
  FractureFrame frame;
  frame.time = state.time;
  Field opening{"opening_m", 1, {}}, slip{"slip_m", 1, {}}, damage{"damage", 1, {}}, mode{"mode", 1, {}},
      pressure{"pressure_Pa", 1, {}}, broken{"broken", 1, {}};
  for (const CohesiveHistory& h : state.cohesive.histories) {
    const double d = std::max({h.point[0].damage, h.point[1].damage, h.point[2].damage});
    if (d == 0.0) continue;
    const std::size_t i = at(h.element);
    const auto& n = state.cohesive.nodes[i];
    const auto middle = [&](Index a, Index b) {
      return 0.5 * (state.node_reference(a) + state.displacement[at(a)] + state.node_reference(b) +
                    state.displacement[at(b)]);
    };
    const Index p = static_cast<Index>(frame.points.size());
    frame.points.push_back(middle(n[0], n[2]));
    frame.points.push_back(middle(n[1], n[3]));
    frame.lines.push_back({p, p + 1});
    const bool is_broken = state.cohesive.status[i] >= CohesiveStatus::broken;
    const Index cavity = state.fluid.cavity_of_edge[at(state.cohesive.edge[i])];
    opening.add(h.point[2].opening);
    slip.add(h.point[2].slip);
    damage.add(d);
    const double share = h.fracture_energy > 0.0 ? h.sliding_work / h.fracture_energy : 0.0;
    // a joint that never had cohesion is broken in no mode
    const bool unbonded =
        h.fracture_energy == 0.0 && state.mesh->edges[at(state.cohesive.edge[i])].joint >= 0;
    mode.add(is_broken && !unbonded ? static_cast<double>(failure_mode(share)) : 0.0);
    pressure.add(cavity >= 0 ? simulation.scene().pore_pressure +
                                   simulation.fluid()->pressure(state, state.cohesive.edge[i])
                             : 0.0);
    broken.add(is_broken ? 1.0 : 0.0);
  }
  // A smeared crack as a line through the middle of its triangle, as long as it stands for.
  for (const DamagedTriangle& d : state.damage.triangles) {
    const double half = 0.5 * simulation.bulk().area(d.triangle) / d.length;
    std::array<Vec2, 3> x;
    for (Index i = 0; i < 3; ++i) x[at(i)] = state.position(3 * d.triangle + i);
    const Vec2 centre = (1.0 / 3.0) * (x[0] + x[1] + x[2]), along{-d.normal.y, d.normal.x};
    const Index p = static_cast<Index>(frame.points.size());
    frame.points.push_back(centre + -half * along);
    frame.points.push_back(centre + half * along);
    frame.lines.push_back({p, p + 1});
    opening.add(d.opening);
    slip.add(d.slip);
    damage.add(d.damage);
    const double share = d.fracture_energy > 0.0 ? d.sliding_work / d.fracture_energy : 0.0;
    mode.add(d.failed ? static_cast<double>(failure_mode(share)) : 0.0);
    pressure.add(d.cavity >= 0 ? state.fluid.cavities[at(d.cavity)].pressure : 0.0);
    broken.add(d.failed);
  }
  frame.cell_fields = {std::move(opening), std::move(slip),     std::move(damage),
                       std::move(mode),    std::move(pressure), std::move(broken)};
  return frame;
}

}  // namespace crackle
