// SPDX-License-Identifier: GPL-3.0-or-later
#include "growth.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <set>

#include "bore.hpp"
#include "crackle/core/errors.hpp"
#include "dynamics.hpp"
#include "record.hpp"

namespace crackle::quasi_static {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

constexpr double in_line = 0.985;  // cosine of 10 degrees

// Displacement of a corner of a triangle, with the jumps [m].
Vec2 corner(const Equations& e, const State& state, const std::vector<Vec2>& intact, Index t, Index v) {
  Vec2 d = intact[at(v)];
  for (std::size_t k = 0; k < state.jumps.size(); ++k) {
    const JumpUnknown& unknown = e.path.unknowns()[k];
    if (unknown.vertex == v && std::binary_search(unknown.triangles.begin(), unknown.triangles.end(), t))
      d += state.jumps[k] * unknown.direction;
  }
  return d;
}

// Triangles ahead of a vertex at most two edges off.
std::vector<Index> ahead_of(const Equations& e, Index vertex, Vec2 direction) {
  const Mesh& mesh = *e.scene.mesh;
  std::set<Index> near;
  for (const Index t : e.path.fan(vertex)) {
    for (const Index v : mesh.triangles[at(t)]) {
      const std::vector<Index> round = e.path.fan(v);
      near.insert(round.begin(), round.end());
    }
  }
  std::vector<Index> ahead;
  for (const Index t : near) {
    const auto& v = mesh.triangles[at(t)];
    const Vec2 centre =
        (1.0 / 3.0) * (mesh.vertices[at(v[0])] + mesh.vertices[at(v[1])] + mesh.vertices[at(v[2])]);
    if (dot(centre - mesh.vertices[at(vertex)], direction) > 0.0) ahead.push_back(t);
  }
  return ahead;
}

// Mean effective stress of triangles [Pa], by area.
Sym2 mean_stress(const Equations& e, const State& state, const std::vector<Index>& triangles) {
  const std::vector<Vec2> u = displacement(e, state);
  Sym2 sum;
  double area = 0.0;
  for (const Index t : triangles) {
    std::array<Vec2, 3> d;
    for (std::size_t i = 0; i < 3; ++i) d[i] = corner(e, state, u, t, e.scene.mesh->triangles[at(t)][i]);
    sum = sum + e.bulk.area(t) * e.bulk.small_stress(t, d);
    area += e.bulk.area(t);
  }
  return (1.0 / area) * sum;
}

// Unit vector across the largest principal stress, on the side of `forward`; that where it is the same all
// round.
Vec2 across_largest(const Sym2& s, Vec2 forward) {
  if (std::hypot(0.5 * (s.xx - s.yy), s.xy) <= 1e-9 * std::abs(s.xx + s.yy)) return forward;
  const double angle = 0.5 * std::atan2(2.0 * s.xy, s.xx - s.yy);
  const Vec2 along{-std::sin(angle), std::cos(angle)};
  return dot(along, forward) < 0.0 ? -1.0 * along : along;
}

double pressure_over_pores(const Equations& e, const State& state, std::size_t cell) {
  const Index source = pressure_source(e, state, static_cast<Index>(cell));
  return source < 0 ? 0.0 : state.cells[at(source)].pressure - e.scene.pore_pressure;
}

}  // namespace

std::vector<Index> joints_met(const Equations& e, Index vertex) {
  if (e.scene.joints.empty()) return {};
  std::vector<Index> met = e.path.mesh_edges_at(vertex);
  std::erase_if(met, [&](Index edge) { return e.path.holds(edge) || e.scene.joint_at(edge) == nullptr; });
  return met;
}

NextEdge next_in_joint(const Equations& e, const Tip& tip) {
  if (tip.cell < 0) return {};
  const Mesh& mesh = *e.scene.mesh;
  const PathEdge& from = e.path.edges()[at(tip.cell)];
  const JointEdge* joint = e.scene.joint_at(from.edge);
  if (joint == nullptr) return {};
  for (const Index next : joints_met(e, from.vertex[1])) {
    if (mesh.edges[at(next)].joint == mesh.edges[at(from.edge)].joint) return {next, {}};
  }
  return {};
}

NextEdge choose_edge(const Equations& e, const State& state, const Tip& tip) {
  const Mesh& mesh = *e.scene.mesh;
  const PathEdge& from = e.path.edges()[at(tip.cell)];
  const Vec2 here = mesh.vertices[at(from.vertex[1])];
  Vec2 forward = right_normal(from.normal);  // along the fracture
  if (dot(forward, here - mesh.vertices[at(from.vertex[0])]) < 0.0) forward = -1.0 * forward;
  const std::vector<Index> ahead = ahead_of(e, from.vertex[1], forward);
  const Vec2 along = ahead.empty() ? forward : across_largest(mean_stress(e, state, ahead), forward);
  // A point of the smooth fracture a little further on than an edge reaches.
  const Vec2 goal = tip.place + (dot(here - tip.place, along) + 1.5 * from.length) * along;
  const Vec2 way = (1.0 / norm(goal - here)) * (goal - here);
  NextEdge best;
  double most = -0.17;  // turns by less than 100 degrees
  for (const Index candidate : e.path.mesh_edges_at(from.vertex[1])) {
    const Edge& edge = mesh.edges[at(candidate)];
    if (e.path.holds(candidate) || edge.triangle[1] < 0) continue;
    const Vec2 end = mesh.vertices[at(edge.vertex[edge.vertex[0] == from.vertex[1] ? 1 : 0])];
    const double length = norm(end - here), aligned = dot(end - here, way) / length;
    const bool aside = e.scene.joint_at(candidate) != nullptr && dot(end - here, along) < in_line * length;
    if (aligned <= most || aside) continue;
    most = aligned;
    best = {candidate, std::max(dot(end - tip.place, along), 0.2 * length) * along};
  }
  if (best.edge < 0) {
    throw NumericalError(
        fmt::format("quasi-static stage: at {:g} s the fracture has come to the boundary at "
                    "({:g}, {:g}); make the domain larger, or end the run earlier",
                    state.time, here.x, here.y));
  }
  return best;
}

void take_over(const Equations& e, State& state, std::size_t first) {
  const auto count = static_cast<Index>(state.jumps.size() - first);
  if (count == 0) return;
  const auto joined = [&](Index unknown) {
    return at(unknown) >= first ? unknown - static_cast<Index>(first) : -1;
  };
  // Forces that hold the new jumps shut, less what older points bear of them.
  Eigen::VectorXd force = Eigen::VectorXd::Zero(count);
  Eigen::MatrixXd share = Eigen::MatrixXd::Zero(count, count);
  for (Index k = 0; k < count && !e.moving; ++k) {
    const double* row = e.rock.row(first + at(k));
    for (std::size_t j = 0; j < first; ++j) force[k] += row[j] * state.jumps[j];
  }
  if (e.moving) {
    for (const Dynamics::Block& block : e.moving->blocks()) {
      for (std::size_t k = 0; k < block.unknowns.size(); ++k) {
        if (const Index i = joined(block.unknowns[k]); i >= 0)
          force[i] += Dynamics::inertia(block, k, state.jumps, e.moving->target(), e.moving->dt());
      }
    }
  }
  std::vector<std::pair<std::size_t, std::size_t>> points;
  for (std::size_t c = 0; c < state.cells.size(); ++c) {
    const PathEdge& edge = e.path.edges()[c];
    for (std::size_t i = 0; i < 2; ++i) {
      const bool touched =
          std::ranges::any_of(edge.jump[i], [&](const JumpTerm& t) { return joined(t.unknown) >= 0; });
      const bool fresh =
          std::ranges::all_of(edge.jump[i], [&](const JumpTerm& t) { return joined(t.unknown) >= 0; });
      if (!touched) continue;
      const double half = 0.5 * edge.length;
      if (fresh && state.cells[c].parent != of_joint) {
        points.emplace_back(c, i);
        for (const JumpTerm& a : edge.jump[i]) {
          for (const JumpTerm& b : edge.jump[i])
            share(joined(a.unknown), joined(b.unknown)) +=
                half * (a.normal * b.normal + a.tangent * b.tangent);
        }
        continue;
      }
      const Point& p = state.cells[c].points[i];
      const MixedTraction t = traction_at(e, state, c, i);
      const double load = pressure_over_pores(e, state, c) - t.normal + p.in_situ,
                   drag = p.in_situ_shear - t.shear;
      for (const JumpTerm& a : edge.jump[i]) {
        if (joined(a.unknown) >= 0) force[joined(a.unknown)] -= half * (load * a.normal + drag * a.tangent);
      }
    }
  }
  const Eigen::VectorXd traction = share.completeOrthogonalDecomposition().solve(force);
  for (const auto& [c, i] : points) {
    Point& p = state.cells[c].points[i];
    p.bond = p.in_situ + pressure_over_pores(e, state, c);
    p.bond_shear = p.in_situ_shear;
    for (const JumpTerm& t : e.path.edges()[c].jump[i]) {
      p.bond -= traction[joined(t.unknown)] * t.normal;
      p.bond_shear -= traction[joined(t.unknown)] * t.tangent;
    }
    p.bond = std::min(p.bond, e.laws[c].strength());
  }
}

}  // namespace crackle::quasi_static
