// SPDX-License-Identifier: GPL-3.0-or-later
#include "crackle/fluid/viscous_flow.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "crackle/core/errors.hpp"

namespace crackle {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

bool on_wall(const Edge& edge) { return edge.triangle[1] < 0; }

// Corners of the two faces of an edge at one of its vertices, in the order in which the border of the fluid
// at that vertex, rock to its left, passes the edge's end.
std::array<Index, 2> cap(const Mesh& mesh, Index e, Index vertex) {
  const Edge& edge = mesh.edges[at(e)];
  std::array<std::array<Index, 2>, 2> ends;  // start and end of the side of each face
  for (std::size_t f = 0; f < 2; ++f) {
    ends[f] = {3 * edge.triangle[f] + edge.side[f], 3 * edge.triangle[f] + (edge.side[f] + 1) % 3};
  }
  const Index start = mesh.triangles[at(edge.triangle[0])][at(edge.side[0])];
  if (start == vertex) return {ends[0][0], ends[1][1]};
  return {ends[1][0], ends[0][1]};
}

double turned(double angle) {  // into (0, 2π]
  const double full = 2.0 * std::numbers::pi;
  while (angle <= 0.0) angle += full;
  while (angle > full) angle -= full;
  return angle;
}

}  // namespace

ViscousFlow::ViscousFlow(CompressibleFluid fluid, FlowChoice choice)
    : fluid_(fluid), choice_(std::move(choice)) {}

void ViscousFlow::take_up(State& state) {
  FluidState& f = state.fluid;
  std::vector<FlowCell> cells;
  bool wall = false;
  for (std::size_t e = 0; e < f.cavity_of_edge.size(); ++e) {
    if (f.cavity_of_edge[e] >= 0 && on_wall(state.mesh->edges[e])) wall = true;
  }
  auto old = f.cells.begin();
  const auto add = [&](Index edge) {
    if (old != f.cells.end() && old->edge == edge) {
      cells.push_back(*old++);
    } else {
      cells.push_back({edge, 0.0, choice_.law.cavitation_pressure});
    }
  };
  if (wall) add(-1);
  for (std::size_t e = 0; e < f.cavity_of_edge.size(); ++e) {
    if (f.cavity_of_edge[e] >= 0 && !on_wall(state.mesh->edges[e])) add(static_cast<Index>(e));
  }
  f.cells = std::move(cells);
  rebuild(state);
  std::vector<double> moved(f.cells.size(), 0.0);  // V in the last step
  for (const Touch& t : touches_)
    moved[at(t.cell)] += state.time_step * dot(t.gradient, state.velocity[at(t.node)]);
  for (std::size_t c = 0; c < f.cells.size(); ++c) {
    FlowCell& cell = f.cells[c];
    if (cell.mass == 0.0) {
      cell.volume = start_[c];
      cell.gained = moved[c];
      state.dissipation.viscous -= 0.5 * cell.pressure * cell.gained;  // half of the first push's work
    }
  }
}

void ViscousFlow::rebuild(const State& state) {
  const auto& cells = state.fluid.cells;
  cell_of_edge_.assign(state.mesh->edges.size(), -1);
  length_.assign(cells.size(), 0.0);
  for (std::size_t c = 0; c < cells.size(); ++c) {
    if (cells[c].edge < 0) continue;
    cell_of_edge_[at(cells[c].edge)] = static_cast<Index>(c);
    const auto& v = state.mesh->edges[at(cells[c].edge)].vertex;
    length_[c] = norm(state.mesh->vertices[at(v[1])] - state.mesh->vertices[at(v[0])]);
  }
  polygons_.clear();
  stars_.clear();
  links_.clear();
  add_polygons(state);
  std::map<std::pair<Index, Index>, std::size_t> slot;
  for (const Polygon& p : polygons_) {
    for (const Index corner : p.corners) slot.try_emplace({state.node_of_corner[at(corner)], p.cell}, 0);
  }
  touches_.clear();
  for (auto& [key, place] : slot) {
    place = touches_.size();
    touches_.push_back({key.first, key.second, {}});
  }
  slots_.clear();
  for (const Polygon& p : polygons_) {
    std::vector<std::size_t>& list = slots_.emplace_back();
    for (const Index corner : p.corners) list.push_back(slot.at({state.node_of_corner[at(corner)], p.cell}));
  }
  fresh_ = true;
  measure(state);
}

// Edges as quadrilaterals between their faces, the wellbore along its wall, and what is left round vertices
// where several meet, in equal shares.
void ViscousFlow::add_polygons(const State& state) {
  const Mesh& mesh = *state.mesh;
  const auto& cells = state.fluid.cells;
  const auto place = [&](Index v) { return mesh.vertices[at(v)]; };
  std::map<Index, std::vector<Index>> at_vertex;  // cells
  for (std::size_t c = 0; c < cells.size(); ++c) {
    if (cells[c].edge < 0) continue;
    const auto& v = mesh.edges[at(cells[c].edge)].vertex;
    const auto a = cap(mesh, cells[c].edge, v[0]), b = cap(mesh, cells[c].edge, v[1]);
    polygons_.push_back({static_cast<Index>(c), 1.0, {a[1], a[0], b[1], b[0]}});
    for (const Index end : v) at_vertex[end].push_back(static_cast<Index>(c));
  }
  std::map<Index, Index> wall;  // vertex -> side that starts there, rock to its left
  if (!cells.empty() && cells.front().edge < 0) {
    for (std::size_t e = 0; e < mesh.edges.size(); ++e) {
      const Edge& edge = mesh.edges[e];
      if (!on_wall(edge) || state.fluid.cavity_of_edge[e] < 0) continue;
      wall[mesh.triangles[at(edge.triangle[0])][at(edge.side[0])]] = 3 * edge.triangle[0] + edge.side[0];
    }
  }
  const auto end_of = [&](Index side) { return 3 * (side / 3) + (side % 3 + 1) % 3; };
  const auto vertex_of = [&](Index corner) { return mesh.triangles[at(corner / 3)][at(corner % 3)]; };
  std::map<Index, Index> before;  // vertex -> side that ends there
  for (const auto& [vertex, side] : wall) before[vertex_of(end_of(side))] = side;
  std::map<Index, Index> left = wall;
  while (!left.empty()) {
    Polygon p{0, 1.0, {}};
    for (auto next = left.begin(); next != left.end();) {
      const Index side = next->second;
      left.erase(next);
      p.corners.insert(p.corners.end(), {side, end_of(side)});
      next = left.find(vertex_of(end_of(side)));
    }
    polygons_.push_back(std::move(p));
  }
  for (auto& entry : at_vertex) {
    const Index vertex = entry.first;
    std::vector<Index>& round = entry.second;
    const auto from = before.find(vertex), to = wall.find(vertex);
    const bool walled = from != before.end() && to != wall.end();
    double first = 0.0;
    if (walled) {
      const Vec2 back = place(vertex_of(from->second)) - place(vertex);
      first = std::atan2(back.y, back.x);
    }
    const auto angle = [&](Index c) {  // clockwise from the wall
      const auto& v = mesh.edges[at(cells[at(c)].edge)].vertex;
      const Vec2 out = place(v[0] == vertex ? v[1] : v[0]) - place(vertex);
      return turned(first - std::atan2(out.y, out.x));
    };
    std::ranges::stable_sort(round, {}, angle);
    Polygon p{-1, 1.0 / static_cast<double>(round.size()), {}};
    if (walled) p.corners.push_back(end_of(from->second));
    for (const Index c : round) {
      const auto passed = cap(mesh, cells[at(c)].edge, vertex);
      p.corners.insert(p.corners.end(), passed.begin(), passed.end());
    }
    if (walled) p.corners.push_back(to->second);
    for (const Index c : round) {
      if (p.corners.size() < 4) break;
      p.cell = c;
      polygons_.push_back(p);
    }
    if (walled) {
      for (const Index c : round) links_.push_back({0, c, stars_.size()});
      stars_.push_back({});
    } else {
      for (std::size_t i = 0; i < round.size(); ++i) {
        for (std::size_t j = i + 1; j < round.size(); ++j)
          links_.push_back({round[i], round[j], stars_.size()});
      }
      stars_.push_back(round);
    }
  }
  inlets_.clear();
  if (!cells.empty() && cells.front().edge < 0) {
    inlets_ = {0};
  } else {
    double nearest = 1e300;
    for (const auto& [vertex, round] : at_vertex) {
      if (state.fluid.cavity_of_vertex[at(vertex)] != 0 || norm(place(vertex)) >= nearest) continue;
      nearest = norm(place(vertex));
      inlets_ = round;
    }
  }
}

// V and its gradients at the present place of the rock. Closed faces leave the smallest aperture open.
void ViscousFlow::measure(const State& state) {
  start_.assign(length_.size(), 0.0);
  for (Touch& t : touches_) t.gradient = {};
  for (std::size_t k = 0; k < polygons_.size(); ++k) {
    const Polygon& p = polygons_[k];
    const Vec2 origin = state.reference(p.corners.front());
    Vec2 before = state.position(p.corners.back()) - origin,
         here = state.position(p.corners.front()) - origin;
    for (std::size_t i = 0; i < p.corners.size(); ++i) {
      const Vec2 after = state.position(p.corners[i + 1 < p.corners.size() ? i + 1 : 0]) - origin;
      start_[at(p.cell)] -= p.weight * 0.5 * cross(here, after);
      touches_[slots_[k][i]].gradient +=
          p.weight * Vec2{0.5 * (before.y - after.y), 0.5 * (after.x - before.x)};
      before = here;
      here = after;
    }
  }
  for (std::size_t c = 0; c < start_.size(); ++c) {
    const double least = choice_.law.smallest_aperture * length_[c];
    start_[c] = std::max(start_[c] + least, 0.01 * least);
  }
}

void ViscousFlow::fill(State& state) {
  for (std::size_t c = 0; c < state.fluid.cells.size(); ++c) {
    FlowCell& cell = state.fluid.cells[c];
    const Index cavity = cell.edge < 0 ? 0 : state.fluid.cavity_of_edge[at(cell.edge)];
    cell.pressure = state.fluid.cavities[at(cavity)].pressure;
    cell.volume = start_[c];
    cell.mass = fluid_.mass(cell.volume, cell.pressure);
  }
  for (Cavity& cavity : state.fluid.cavities) cavity.mass = 0.0;
  for (const FlowCell& cell : state.fluid.cells)
    state.fluid.cavities[cell.edge < 0 ? 0 : at(state.fluid.cavity_of_edge[at(cell.edge)])].mass += cell.mass;
}

void ViscousFlow::set_conductances(const State& state, double dt) {
  const auto aperture = [&](Index c) { return start_[at(c)] / length_[at(c)]; };
  conductance_.assign(links_.size(), 0.0);
  for (std::size_t k = 0; k < links_.size(); ++k) {
    const auto [a, b, star] = links_[k];
    double t = 0.0;
    if (stars_[star].empty()) {  // from the wellbore into half an edge
      t = choice_.law.conductivity(aperture(b)).value * 2.0 / length_[at(b)];
    } else {
      double sum = 0.0, width = 0.0;
      for (const Index c : stars_[star]) {
        sum += 2.0 / length_[at(c)];
        width += aperture(c) / static_cast<double>(stars_[star].size());
      }
      t = choice_.law.conductivity(width).value * 4.0 / (length_[at(a)] * length_[at(b)] * sum);
    }
    const double laminar =
        t * std::abs(state.fluid.cells[at(a)].pressure - state.fluid.cells[at(b)].pressure);
    if (laminar > 0.0) t *= choice_.law.flow(laminar).value / laminar;
    conductance_[k] = dt * t;
  }
}

double ViscousFlow::mass_at(std::size_t cell, double pressure) const {
  return volume_[cell] * std::exp((pressure - fluid_.reference_pressure) / fluid_.bulk_modulus);
}

// Newton's method; cells fill and empty on the way.
bool ViscousFlow::find_pressures(const State& state, double dt, const std::vector<double>& inflow) {
  const auto& cells = state.fluid.cells;
  const std::size_t n = cells.size();
  const double cavitation = choice_.law.cavitation_pressure, modulus = fluid_.bulk_modulus;
  softness_.clear();
  for (std::size_t i = 0; i < touches_.size();) {
    std::size_t end = i;
    while (end < touches_.size() && touches_[end].node == touches_[i].node) ++end;
    const double mobility = dt * dt * state.inverse_mass[at(touches_[i].node)];
    for (std::size_t a = i; a < end; ++a) {
      for (std::size_t b = i; b < end; ++b) {
        softness_.push_back(
            {touches_[a].cell, touches_[b].cell, mobility * dot(touches_[a].gradient, touches_[b].gradient)});
      }
    }
    i = end;
  }
  // A soft cell is pushed by the pressure at the step's beginning, which conserves energy (Fluid::advance).
  implicit_.assign(n, 0.0);
  for (const MatrixEntry& s : softness_) {
    if (s.row == s.column) implicit_[at(s.row)] += s.value;
  }
  for (std::size_t c = 0; c < n; ++c)
    implicit_[c] = std::clamp((implicit_[c] * modulus / std::max(start_[c], 1e-300) - 0.1) / 0.2, 0.0, 1.0);
  pressure_.resize(n);
  push_.resize(n);
  full_.resize(n);
  volume_ = start_;
  for (std::size_t c = 0; c < n; ++c) {
    pressure_[c] = cells[c].pressure;
    full_[c] = cells[c].mass + inflow[c] * fluid_.density >= 0.999 * fluid_.density * mass_at(c, cavitation);
  }
  constexpr int most = 100;
  for (int iteration = 0; iteration < most; ++iteration) {
    for (std::size_t c = 0; c < n; ++c) {
      if (!full_[c]) pressure_[c] = cavitation;
      push_[c] = (1.0 - implicit_[c]) * cells[c].pressure + implicit_[c] * pressure_[c];
    }
    volume_ = start_;
    for (const MatrixEntry& s : softness_) volume_[at(s.row)] += s.value * push_[at(s.column)];
    // residuals of mass over reference density; right_ becomes Newton's step
    matrix_.clear();
    right_.assign(n, 0.0);
    for (std::size_t c = 0; c < n; ++c) {
      right_[c] = cells[c].mass / fluid_.density + inflow[c];
      const double scale = std::exp((pressure_[c] - fluid_.reference_pressure) / modulus);
      matrix_.push_back({static_cast<Index>(c), static_cast<Index>(c),
                         full_[c] ? scale * std::max(volume_[c], 0.01 * start_[c]) / modulus : 1.0});
    }
    for (const MatrixEntry& s : softness_) {
      const double scale = std::exp((pressure_[at(s.row)] - fluid_.reference_pressure) / modulus);
      matrix_.push_back(
          {s.row, s.column, full_[at(s.row)] ? scale * s.value * implicit_[at(s.column)] : 0.0});
    }
    for (std::size_t k = 0; k < links_.size(); ++k) {
      const Index a = links_[k].a, b = links_[k].b;
      const double q = conductance_[k] * (pressure_[at(a)] - pressure_[at(b)]);
      right_[at(a)] -= q;
      right_[at(b)] += q;
      for (const auto& [here, there] : {std::pair{a, b}, std::pair{b, a}}) {
        const double t = full_[at(here)] ? conductance_[k] : 0.0;
        matrix_.push_back({here, here, t});
        matrix_.push_back({here, there, -t});
      }
    }
    bool changed = false;
    for (std::size_t c = 0; c < n; ++c) {
      if (full_[c]) {
        right_[c] -= mass_at(c, pressure_[c]);
      } else {
        if (right_[c] > mass_at(c, cavitation)) full_[c] = 1, changed = true;
        right_[c] = 0.0;
      }
    }
    if (changed) continue;
    choice_.solver(matrix_, right_, fresh_);
    fresh_ = false;
    double largest = 0.0;
    for (std::size_t c = 0; c < n; ++c) {
      const double step = std::clamp(right_[c], -0.5 * modulus, 0.5 * modulus);
      largest = std::max(largest, std::abs(step) / (std::abs(pressure_[c]) + 1e-3 * modulus));
      pressure_[c] += step;
      if (full_[c] && pressure_[c] < cavitation - 1e-9 * modulus) full_[c] = 0, changed = true;
    }
    if (!changed && largest <= 1e-12) return true;
  }
  return false;
}

double ViscousFlow::held_energy(double mass, double volume) const {
  const double full = fluid_.mass(volume, choice_.law.cavitation_pressure);
  const double p = mass > full ? fluid_.pressure(mass, volume) : choice_.law.cavitation_pressure;
  return fluid_.energy(mass, volume, p);
}

void ViscousFlow::advance(State& state, double dt, double injected) {
  FluidState& f = state.fluid;
  if (f.cells.empty()) return;
  measure(state);
  set_conductances(state, dt);
  std::vector<double> inflow(f.cells.size(), 0.0);
  for (const Index c : inlets_) inflow[at(c)] += injected / static_cast<double>(inlets_.size());
  if (!find_pressures(state, dt, inflow)) {
    throw NumericalError(
        fmt::format("flow in the fractures finds no pressures at step {}, time {:.6g} s: take a smaller "
                    "run.safety, or fluid.flow = \"uniform\"",
                    state.step, state.time));
  }
  Cavity& well = f.cavities.front();
  std::vector<double> gained = inflow;
  for (std::size_t k = 0; k < links_.size(); ++k) {
    const double q = conductance_[k] * (pressure_[at(links_[k].a)] - pressure_[at(links_[k].b)]);
    gained[at(links_[k].a)] -= q;
    gained[at(links_[k].b)] += q;
  }
  double late = 0.0;
  lost_ahead_ = 0.0;
  for (std::size_t c = 0; c < f.cells.size(); ++c) {
    FlowCell& cell = f.cells[c];
    const double pumped = inflow[c] * fluid_.density;
    const double work = pumped * 0.5 * (fluid_.enthalpy(cell.pressure) + fluid_.enthalpy(pressure_[c]));
    // The rock's leapfrog takes the mean of the pressures that push before and after a move as the work on
    // it: this step's pressure was not yet known when the one before was booked.
    late -= 0.5 * (push_[c] - cell.pressure) * cell.gained;
    lost_ahead_ += work + held_energy(cell.mass, cell.volume);
    lost_ahead_ -= 0.5 * (push_[c] + pressure_[c]) * (volume_[c] - cell.volume);
    well.work += work;
    cell.mass += gained[c] * fluid_.density;
    cell.pressure = pressure_[c];
    cell.gained = volume_[c] - cell.volume;
    cell.volume = volume_[c];
    lost_ahead_ -= held_energy(cell.mass, cell.volume);
  }
  state.dissipation.viscous += late + lost_ahead_;
  move(state, dt);
  well.injected += injected;
  for (Cavity& cavity : f.cavities) cavity.mass = cavity.volume = cavity.pressure = 0.0;
  for (const FlowCell& cell : f.cells) {
    Cavity& cavity = f.cavities[cell.edge < 0 ? 0 : at(f.cavity_of_edge[at(cell.edge)])];
    cavity.mass += cell.mass;
    cavity.volume += cell.volume;
    cavity.pressure += cell.volume * cell.pressure;
  }
  for (Cavity& cavity : f.cavities) cavity.pressure /= cavity.volume > 0.0 ? cavity.volume : 1.0;
  well.pressure = 0.0;
  for (const Index c : inlets_)
    well.pressure += f.cells[at(c)].pressure / static_cast<double>(inlets_.size());
}

void ViscousFlow::move(State& state, double dt) const {
  for (const Touch& t : touches_) {
    const Vec2 kick = (dt * push_[at(t.cell)] * state.inverse_mass[at(t.node)]) * t.gradient;
    state.velocity[at(t.node)] += kick;
    state.displacement[at(t.node)] += dt * kick;
  }
}

double ViscousFlow::energy(const State& state) const {
  double sum = 0.0;
  for (const FlowCell& cell : state.fluid.cells) sum += held_energy(cell.mass, cell.volume);
  return sum;
}

double ViscousFlow::pressure(const State& state, Index edge) const {
  return state.fluid.cells[at(cell_of_edge_[at(edge)])].pressure;
}

void ViscousFlow::for_each_load(const State& state, const std::function<void(Index, Vec2)>& add) const {
  for (const Polygon& p : polygons_) {
    const double push = p.weight * state.fluid.cells[at(p.cell)].pressure;
    for (std::size_t i = 0; i < p.corners.size(); ++i) {
      const Vec2 before = state.position(p.corners[i > 0 ? i - 1 : p.corners.size() - 1]);
      const Vec2 after = state.position(p.corners[i + 1 < p.corners.size() ? i + 1 : 0]);
      add(p.corners[i], {0.5 * push * (before.y - after.y), 0.5 * push * (after.x - before.x)});
    }
  }
}

}  // namespace crackle
