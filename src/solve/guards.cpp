// SPDX-License-Identifier: GPL-3.0-or-later
#include "crackle/solve/guards.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace crackle {
namespace {

constexpr double energy_made_warning = 0.02, energy_made_stop = 0.2;  // over what was dissipated
constexpr double given_warning = 0.05;                                // by the method, over the same
constexpr double negative_kinetic = 0.1;                              // over the largest energy
constexpr double borne_by_stray = 0.5;                                // of the strength
constexpr double fracture_damage = 0.5;                               // of an element in a cohesive zone
constexpr std::int64_t few_strays = 5;                                // no alarm up to here,
constexpr double strays_of_broken = 0.02;                             // nor up to this share
constexpr double motion_per_step = 0.02;                              // of an edge
constexpr double area_left = 0.2;                                     // of a triangle
constexpr double residual_warning = 1e-3, residual_stop = 1e-2;
constexpr double kinetic_share = 0.5;  // of the pump's work, in a quiet phase
constexpr double transits = 10.0;      // of a wave round the wellbore until it can be quiet
constexpr std::int64_t motion_every = 32, area_every = 256;  // steps

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

std::string when(const Simulation& s) {
  const State& state = s.state();
  return fmt::format("at step {}, time {:.6g} s, step size {:.3g} s (stable: {:.3g} s)", state.step,
                     state.time, state.time_step, s.stable_limit());
}

std::string cause(const Simulation& s) {
  const double ratio = s.state().time_step / s.stable_limit();
  if (ratio > 1.0 + 1e-9)
    return fmt::format("the step is {:.3g} times the stable one: leave run.time_step to \"auto\"", ratio);
  return "most likely the step is too long for what happens there: take a smaller run.safety";
}

Vec2 middle(const Mesh& mesh, Index triangle) {
  Vec2 sum;
  for (const Index v : mesh.triangles[at(triangle)]) sum += mesh.vertices[at(v)];
  return (1.0 / 3.0) * sum;
}

double shortest_side(const Mesh& mesh, Index triangle) {
  const auto& v = mesh.triangles[at(triangle)];
  double shortest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < 3; ++i)
    shortest = std::min(shortest, norm(mesh.vertices[at(v[(i + 1) % 3])] - mesh.vertices[at(v[i])]));
  return shortest;
}

// Broken, or in the cohesive zone of a fracture: within it elements break in any order.
bool softens(const State& state, Index element) {
  if (state.cohesive.status[at(element)] >= CohesiveStatus::broken) return true;
  const Index history = state.cohesive.history_of[at(element)];
  if (history < 0) return false;
  const auto& points = state.cohesive.histories[at(history)].point;
  return std::ranges::any_of(points, [](const CohesivePoint& p) { return p.damage > fracture_damage; });
}

// Triangles round one end of an edge, and whether any other edge there is open: a boundary, broken or
// softening.
struct Surroundings {
  std::vector<Index> triangles;
  bool open = false;
};

void add_round_vertex(const State& state, Index edge, Index vertex, Surroundings& round) {
  const Mesh& mesh = *state.mesh;
  for (const Index start : mesh.edges[at(edge)].triangle) {
    Index t = start, from = edge;
    while (true) {
      round.triangles.push_back(t);
      Index next = -1;
      for (const Index e : mesh.triangle_edges[at(t)]) {
        const auto& v = mesh.edges[at(e)].vertex;
        if (e != from && (v[0] == vertex || v[1] == vertex)) next = e;
      }
      if (next == edge) break;  // all the way round
      const Index element = state.cohesive.of_edge[at(next)];
      if (mesh.edges[at(next)].kind != EdgeKind::interior || (element >= 0 && softens(state, element)))
        round.open = true;
      if (mesh.edges[at(next)].kind != EdgeKind::interior) break;
      const auto& sides = mesh.edges[at(next)].triangle;
      t = sides[0] == t ? sides[1] : sides[0];
      from = next;
    }
  }
}

// An element that broke where nothing asked for it.
bool is_stray(const Simulation& s, Index element) {
  const State& state = s.state();
  const Mesh& mesh = *state.mesh;
  const Index edge = state.cohesive.edge[at(element)];
  if (mesh.edges[at(edge)].joint >= 0) return false;
  Surroundings round;
  for (const Index v : mesh.edges[at(edge)].vertex) {
    add_round_vertex(state, edge, v, round);
    if (round.open) return false;
  }
  std::sort(round.triangles.begin(), round.triangles.end());
  round.triangles.erase(std::unique(round.triangles.begin(), round.triangles.end()), round.triangles.end());
  Sym2 sum;
  double area = 0.0;
  for (const Index t : round.triangles) {
    sum = sum + s.bulk().area(t) * s.bulk().stress(state, t);
    area += s.bulk().area(t);
  }
  const Vec2 along = state.cohesive.direction[at(element)];
  return Cohesive::utilisation(s.cohesive()->material(state, element), (1.0 / area) * sum,
                               (1.0 / norm(along)) * along) < borne_by_stray;
}

}  // namespace

Guards::Guards(const Simulation& simulation, const GuardMemory& memory) : memory_(memory) {
  const Mesh& mesh = *simulation.state().mesh;
  shortest_ = std::numeric_limits<double>::infinity();
  for (Index t = 0; t < mesh.triangle_count(); ++t) {
    shortest_ = std::min(shortest_, shortest_side(mesh, t));
    least_energy_ += 1e-13 * simulation.scene().stiffness.largest() * simulation.bulk().area(t);
  }
}

void Guards::raise(std::vector<Finding>& found, Alarm alarm, bool stops, const std::string& text) {
  if (stops) ++memory_.alarms;
  const std::int64_t bit = std::int64_t{1} << (static_cast<unsigned>(alarm) + (stops ? 0U : 16U));
  if ((memory_.raised & bit) != 0) return;
  memory_.raised |= bit;
  found.push_back({alarm, stops, (stops ? "" : "warning: ") + text});
}

void Guards::look_at_breaks(const Simulation& s, std::vector<Finding>& found) {
  if (s.cohesive() == nullptr) return;
  for (const Index element : s.cohesive()->newly_broken()) {
    ++memory_.broken;
    if (!is_stray(s, element)) continue;
    ++memory_.stray;
    const Vec2 x = Cohesive::place(s.state(), element);
    if (memory_.stray <= few_strays ||
        static_cast<double>(memory_.stray) < strays_of_broken * static_cast<double>(memory_.broken))
      continue;
    raise(found, Alarm::stray_breaks, true,
          fmt::format("the rock shatters: {} of {} elements broke away from any fracture where it bore less "
                      "than half its strength, the last is element {} at ({:.4g}, {:.4g}) m, {}; {}",
                      memory_.stray, memory_.broken, element, x.x, x.y, when(s), cause(s)));
  }
  const Dissipation& d = s.state().dissipation;
  const double spent = d.fracture + d.friction;
  if (d.made > energy_made_warning * spent && d.made > least_energy_) {
    Index worst = -1;
    double most = 0.0;
    for (const CohesiveHistory& h : s.state().cohesive.histories) {
      if (h.made_energy > most) most = h.made_energy, worst = h.element;
    }
    const Vec2 x = worst < 0 ? Vec2{} : Cohesive::place(s.state(), worst);
    raise(found, Alarm::made_energy, d.made > energy_made_stop * spent,
          fmt::format("cohesive elements make energy: {:.3g} J/m against {:.3g} J/m dissipated, most in "
                      "element {} at ({:.4g}, {:.4g}) m, {}; {}",
                      d.made, spent, worst, x.x, x.y, when(s), cause(s)));
  }
  const double given = std::abs(d.inserted) + std::abs(d.path);
  if (given > given_warning * spent && given > least_energy_) {
    raise(found, Alarm::given_energy, false,
          fmt::format("the method gave the rock {:.3g} J/m (elements inserted under load or wetted closed "
                      "{:.3g}, a law "
                      "without potential "
                      "{:.3g}) against {:.3g} J/m dissipated, {}: take shorter edges or a larger "
                      "cohesive.penalty",
                      given, d.inserted, d.path, spent, when(s)));
  }
}

void Guards::look_at_motion(const Simulation& s, std::vector<Finding>& found) {
  const State& state = s.state();
  const Mesh& mesh = *state.mesh;
  if (state.step % motion_every == 0) {
    double fastest = 0.0;
    for (const Vec2 v : state.velocity) fastest = std::max(fastest, dot(v, v));
    // Of all nodes the fastest against the shortest of all edges: only then it is worth a closer look.
    if (std::sqrt(fastest) * state.time_step > motion_per_step * shortest_) {
      for (Index t = 0; t < mesh.triangle_count(); ++t) {
        double moved = 0.0;
        for (Index i = 0; i < 3; ++i)
          moved = std::max(moved,
                           state.time_step * norm(state.velocity[at(state.node_of_corner[at(3 * t + i)])]));
        const double side = shortest_side(mesh, t);
        if (moved <= motion_per_step * side) continue;
        const Vec2 x = middle(mesh, t);
        raise(found, Alarm::large_motion, true,
              fmt::format("triangle {} at ({:.4g}, {:.4g}) m moves by {:.2g} of its edge in one step, {}; {}",
                          t, x.x, x.y, moved / side, when(s), cause(s)));
        break;
      }
    }
  }
  if (state.step % area_every == 0) {
    for (Index t = 0; t < mesh.triangle_count(); ++t) {
      const double left = s.bulk().area_ratio(state, t);
      if (left >= area_left) continue;
      const Vec2 x = middle(mesh, t);
      raise(found, Alarm::crushed_triangle, true,
            fmt::format("triangle {} at ({:.4g}, {:.4g}) m is crushed to {:.2g} of its area, {}; {}", t, x.x,
                        x.y, left, when(s), cause(s)));
      break;
    }
  }
}

std::vector<Finding> Guards::after_step(const Simulation& s) {
  std::vector<Finding> found;
  look_at_breaks(s, found);
  look_at_motion(s, found);
  return found;
}

std::vector<Finding> Guards::after_step(const Simulation& s, const Energies& e) {
  std::vector<Finding> found = after_step(s);
  const double spent = e.fracture + e.friction + e.viscous;
  memory_.largest_energy = std::max({memory_.largest_energy, least_energy_, std::abs(e.external),
                                     std::abs(e.strain), std::abs(e.fluid), spent});
  if (e.kinetic < -negative_kinetic * memory_.largest_energy) {
    raise(
        found, Alarm::grid_oscillation, true,
        fmt::format("the mesh oscillates from step to step (kinetic energy {:.3g} J/m of {:.3g} J/m in all), "
                    "{}; {}",
                    e.kinetic, memory_.largest_energy, when(s), cause(s)));
  }
  if (e.residual > residual_warning) {
    const bool stops = e.residual > residual_stop;
    raise(found, Alarm::energy_residual, stops,
          fmt::format("energy residual {:.3g} passes {}, {}; {}", e.residual,
                      stops ? residual_stop : residual_warning, when(s), cause(s)));
  }
  // Quiet: pumped for long enough, nothing broken yet.
  double round = 0.0;
  if (memory_.broken == 0 && e.external > least_energy_ && e.kinetic > kinetic_share * e.external) {
    const Mesh& mesh = *s.state().mesh;
    for (const Edge& edge : mesh.edges) {
      if (edge.kind == EdgeKind::wellbore)
        round += norm(mesh.vertices[at(edge.vertex[1])] - mesh.vertices[at(edge.vertex[0])]);
    }
    const double quiet = transits * round / slowest_shear_wave(s.scene());
    if (s.state().time > quiet) {
      raise(
          found, Alarm::shaking, false,
          fmt::format("{:.0f} % of the pump's work is in motion before anything has broken, {}: the scene is "
                      "shaken, not pressed; take a slower pump, or look for what moves",
                      100.0 * e.kinetic / e.external, when(s)));
    }
  }
  return found;
}

}  // namespace crackle
