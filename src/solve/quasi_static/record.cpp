// SPDX-License-Identifier: GPL-3.0-or-later
#include "record.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "bore.hpp"
#include "crackle/seismic/listener.hpp"

namespace crackle::quasi_static {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

// How far behind the front of a cohesive zone a crack without cohesion would end that opens as much away from
// it [m]. Cohesion σ at x behind the front takes (8 σ/π E') √(x/r) of the opening at r >> x, and the front's
// stress intensity of 0 sets K = √(2/π) ∫ σ/√x dx; a shift by s takes K s/(2 r) of the opening of K, so
//   s = 2 ∫ σ √x dx / ∫ σ/√x dx     (half openings by point forces: Tada, Paris, Irwin 2000)
double behind_front(const Equations& e, const State& state, Index front) {
  double x = 0.0, moment = 0.0, force = 0.0;
  for (Index c = front; c >= 0; c = state.cells[at(c)].parent) {
    const double sigma = e.laws[at(c)].cohesion(state.cells[at(c)].points[0].max_opening);
    const Index parent = state.cells[at(c)].parent;
    if (sigma == 0.0 || parent < 0) break;
    const double to = x + 0.5 * (e.path.edges()[at(c)].length + e.path.edges()[at(parent)].length);
    moment += sigma * 2.0 / 3.0 * (std::pow(to, 1.5) - std::pow(x, 1.5));
    force += sigma * 2.0 * (std::sqrt(to) - std::sqrt(x));
    x = to;
  }
  return force > 0.0 ? 2.0 * moment / force : 0.0;
}

bool is_damaged(const Equations& e, const State& state, Index cell) {
  return state.cells[at(cell)].points[0].max_opening > e.laws[at(cell)].elastic_opening();
}

// The damaged cells that no damage goes on from, one for all tips that leave it.
std::vector<Index> fronts(const Equations& e, const State& state) {
  std::vector<Index> found;
  for (const Tip& tip : state.tips) {
    Index c = state.cells[at(tip.cell)].parent;
    while (c >= 0 && !is_damaged(e, state, c)) c = state.cells[at(c)].parent;
    if (c < 0 || std::ranges::find(found, c) != found.end()) continue;
    bool passed = false;
    for (std::size_t d = 0; d < state.cells.size() && !passed; ++d)
      passed = state.cells[d].parent == c && is_damaged(e, state, static_cast<Index>(d));
    if (!passed) found.push_back(c);
  }
  return found;
}

}  // namespace

double fluid_in_cell(const Equations& e, const State& state, std::size_t c) {
  const Index source = pressure_source(e, state, static_cast<Index>(c));
  if (source < 0) return 0.0;
  const auto w = openings(e.path.edges()[c], state.jumps);
  return e.path.edges()[c].length * 0.5 * (w[0] + w[1]) *
         e.scene.fluid.density(state.cells[at(source)].pressure).value;
}

double fracture_volume(const State& state) {
  double sum = 0.0;
  for (const Cell& cell : state.cells) sum += cell.mass;
  return sum;
}

QuasiStaticRow row_of(const Equations& e, const State& state) {
  QuasiStaticRow row;
  row.time = state.time;
  row.well_pressure = state.well_pressure;
  row.injected = state.injected;
  row.well_stored =
      e.scene.well.storage * (state.well_pressure - state.initial_well) + state.bore - state.initial_bore;
  row.fracture_volume = fracture_volume(state);
  row.leaked = state.leaked;
  row.energies = state.energies;
  row.mass_defect =
      row.injected - row.well_stored - (row.fracture_volume - state.initial_fracture) - row.leaked;
  row.least_pressure = std::numeric_limits<double>::infinity();
  double wet = 0.0, touching = 0.0;
  for (std::size_t c = 0; c < state.cells.size(); ++c) {
    const Cell& cell = state.cells[c];
    const PathEdge& edge = e.path.edges()[c];
    const auto w = openings(edge, state.jumps);
    for (std::size_t i = 0; i < 2; ++i) {
      const double half = 0.5 * edge.length, most = cell.points[i].max_opening;
      if (cell.parent == of_joint) continue;
      row.dissipated += half * e.laws[c].dissipated(most);
      if (most >= e.laws[c].broken_opening()) row.broken_length += half;
      if (most > e.laws[c].elastic_opening()) row.damaged_length += half;
      if (cell.wet && w[i] < std::min(most, e.scene.closure.residual_aperture)) touching += half;
    }
    if (!cell.wet || cell.parent == of_joint) continue;
    wet += edge.length;
    row.mean_opening += 0.5 * edge.length * (w[0] + w[1]);
    row.least_pressure = std::min(row.least_pressure, cell.pressure);
  }
  row.elastic_length = row.damaged_length;
  for (const Index front : fronts(e, state)) row.elastic_length -= behind_front(e, state, front);
  if (wet > 0.0) {
    row.mean_opening /= wet;
    row.contact_fraction = touching / wet;
  } else {
    row.least_pressure = e.scene.pore_pressure;
  }
  for (const Inlet& inlet : state.inlets) {
    const auto n = static_cast<double>(state.inlets.size());
    row.fracture_pressure += state.cells[at(inlet.cell)].pressure / n;
    row.opening += openings(e.path.edges()[at(inlet.cell)], state.jumps)[0] / n;
  }
  return row;
}

std::vector<FractureCell> cells_of(const Equations& e, const State& state) {
  std::vector<FractureCell> list;
  for (std::size_t c = 0; c < state.cells.size(); ++c) {
    const Cell& cell = state.cells[c];
    const PathEdge& edge = e.path.edges()[c];
    const Index source = pressure_source(e, state, static_cast<Index>(c));
    FractureCell f;
    f.edge = edge.edge;
    f.length = edge.length;
    f.joint = cell.parent == of_joint;
    f.opening = openings(edge, state.jumps);
    f.slip = slips(edge, state.jumps);
    for (std::size_t i = 0; i < 2; ++i) f.damage[i] = e.laws[c].damage(cell.points[i].max_opening);
    f.wet = cell.wet;
    f.pressure = source < 0 ? e.scene.pore_pressure : state.cells[at(source)].pressure;
    f.leaked = cell.leaked;
    list.push_back(f);
  }
  return list;
}

Faces faces_of(const Equations& e, const State& state, std::size_t c) {
  const PathEdge& edge = e.path.edges()[c];
  const auto w = openings(edge, state.jumps), s = slips(edge, state.jumps);
  Faces faces{0.5 * (w[0] + w[1]), 0.5 * (s[0] + s[1]), 0.0};
  for (const Point& point : state.cells[c].points) {
    if (state.cells[c].parent != of_joint && point.max_opening > e.laws[c].elastic_opening())
      faces.damaged += 0.5 * edge.length;
  }
  return faces;
}

SeismicEvent snap_of(const Equations& e, const State& state) {
  const Motion& before = state.motion;
  const Mesh& mesh = *e.scene.mesh;
  SeismicEvent event;
  event.time = before.begin;
  event.duration = state.time - before.begin;
  event.energy = state.energies.radiated - before.radiated;
  event.fracture_energy = state.energies.fracture - before.fracture;
  event.friction_energy = state.energies.friction - before.friction;
  event.mode = failure_mode(event.friction_energy / (event.friction_energy + event.fracture_energy));
  event.edges = 0;
  for (std::size_t c = 0; c < state.cells.size(); ++c) {
    const PathEdge& edge = e.path.edges()[c];
    const Faces was = c < before.faces.size() ? before.faces[c] : Faces{}, is = faces_of(e, state, c);
    const double opened = is.opening - was.opening, slid = is.slip - was.slip;
    const PlaneStiffness& rock = e.bulk.stiffness(mesh.edges[at(edge.edge)].triangle[0]);
    event.moment +=
        moment_of_jump({rock.c12, rock.c66}, {-edge.normal.y, edge.normal.x}, edge.length, opened, slid);
    const double torn = is.damaged - was.damaged;
    if (torn <= 0.0) continue;
    if (event.edges++ == 0) event.edge = edge.edge;
    event.length += torn;
    event.opening += torn * opened;
    event.slip += torn * slid;
    event.place += 0.5 * torn * (mesh.vertices[at(edge.vertex[0])] + mesh.vertices[at(edge.vertex[1])]);
  }
  if (event.length == 0.0) {  // faces that slid
    event.place = mesh.vertices[at(e.scene.wings.front().start)];
    return event;
  }
  event.opening /= event.length;
  event.slip /= event.length;
  event.place = 1.0 / event.length * event.place;
  return event;
}

std::vector<Vec2> corners_of(const Equations& e, const State& state) {
  if (state.motion.moves()) return state.motion.place;
  const Mesh& mesh = *e.scene.mesh;
  const std::vector<Vec2> u = displacement(e, state);
  std::vector<Vec2> corners;
  for (const auto& triangle : mesh.triangles) {
    for (const Index v : triangle) corners.push_back(u[at(v)]);
  }
  for (std::size_t k = 0; k < state.jumps.size(); ++k) {
    const JumpUnknown& unknown = e.path.unknowns()[k];
    for (const Index t : unknown.triangles) {
      for (std::size_t i = 0; i < 3; ++i) {
        if (mesh.triangles[at(t)][i] == unknown.vertex)
          corners[3 * at(t) + i] += state.jumps[k] * unknown.direction;
      }
    }
  }
  return corners;
}

std::vector<Sym2> stress_of(const Equations& e, const std::vector<Vec2>& corners) {
  std::vector<Sym2> stress;
  for (Index t = 0; t < e.scene.mesh->triangle_count(); ++t) {
    const Vec2* u = &corners[3 * at(t)];
    stress.push_back(e.bulk.small_stress(t, {u[0], u[1], u[2]}));
  }
  return stress;
}

}  // namespace crackle::quasi_static
