// SPDX-License-Identifier: GPL-3.0-or-later
#include "crackle/solve/loads.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "crackle/core/errors.hpp"

namespace crackle {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

double component(const Vec2& v, std::size_t i) { return i == 0 ? v.x : v.y; }
double& component(Vec2& v, std::size_t i) { return i == 0 ? v.x : v.y; }

double growth(double time, double ramp) {
  if (time <= 0.0) return 0.0;
  if (time >= ramp) return 1.0;
  const double x = time / ramp;
  return x * x * (3.0 - 2.0 * x);
}

// ∫ growth dt [s]
double grown(double time, double ramp) {
  if (time <= 0.0) return 0.0;
  if (time >= ramp) return time - 0.5 * ramp;
  const double x = time / ramp;
  return ramp * x * x * x * (1.0 - 0.5 * x);
}

double displacement_at(const GivenMotion& m, double time, double ramp) {
  return m.value * (m.is_velocity ? grown(time, ramp) : growth(time, ramp));
}

struct Box {
  Vec2 low{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  Vec2 high{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
};

bool on_side(const Box& box, Load::Side side, Vec2 x) {
  const double near = 1e-9 * norm(box.high - box.low);
  switch (side) {
    case Load::Side::left:
      return x.x < box.low.x + near;
    case Load::Side::right:
      return x.x > box.high.x - near;
    case Load::Side::bottom:
      return x.y < box.low.y + near;
    case Load::Side::top:
      return x.y > box.high.y - near;
  }
  return false;
}

bool across_x(Load::Side side) { return side == Load::Side::left || side == Load::Side::right; }
double outward(Load::Side side) { return side == Load::Side::right || side == Load::Side::top ? 1.0 : -1.0; }

double along(Load::Side side, Vec2 x) { return across_x(side) ? x.y : x.x; }

// Corners of the outer edges on a side, and the edges.
struct Outer {
  struct Side {
    Index first, second;  // corners
    bool loaded = false;
  };
  std::vector<Side> sides;
  Box box;
};

Outer outer_sides(const Mesh& mesh) {
  Outer outer;
  for (const Edge& edge : mesh.edges) {
    if (edge.kind != EdgeKind::outer) continue;
    outer.sides.push_back(
        {3 * edge.triangle[0] + edge.side[0], 3 * edge.triangle[0] + (edge.side[0] + 1) % 3});
    for (const Index v : edge.vertex) {
      const Vec2 x = mesh.vertices[at(v)];
      outer.box.low = {std::min(outer.box.low.x, x.x), std::min(outer.box.low.y, x.y)};
      outer.box.high = {std::max(outer.box.high.x, x.x), std::max(outer.box.high.y, x.y)};
    }
  }
  return outer;
}

}  // namespace

Loads::Loads(const Mesh& mesh, std::vector<Load> loads) : loads_(std::move(loads)), impulses_(loads_.size()) {
  Outer outer = outer_sides(mesh);
  const auto vertex = [&](Index corner) { return mesh.triangles[at(corner / 3)][at(corner % 3)]; };
  // Every corner of a vertex of the boundary, which may part: corners by vertex.
  std::map<Index, std::vector<Index>> corners;
  for (const auto& side : outer.sides) corners[vertex(side.first)], corners[vertex(side.second)];
  for (Index c = 0; c < 3 * mesh.triangle_count(); ++c) {
    if (const auto it = corners.find(vertex(c)); it != corners.end()) it->second.push_back(c);
  }
  std::map<Index, Place> places;  // by corner
  for (const auto& [v, list] : corners) {
    for (const Index c : list) places[c].corner = c;
  }
  const auto number_of = [&](Index corner) {
    return static_cast<std::size_t>(std::distance(places.begin(), places.find(corner)));
  };
  for (Index l = 0; l < static_cast<Index>(loads_.size()); ++l) {
    const Load& load = loads_[at(l)];
    const double near = 1e-9 * norm(outer.box.high - outer.box.low);
    const auto holds = [&](Index corner) {
      const double s = along(load.side, mesh.vertices[at(vertex(corner))]);
      return s > load.from - near && s < load.to + near;
    };
    std::vector<Index> vertices;
    Index nearest = -1;
    double distance = std::numeric_limits<double>::infinity();
    bool any = false;
    for (auto& side : outer.sides) {
      const std::array<Index, 2> ends{side.first, side.second};
      if (!std::ranges::all_of(
              ends, [&](Index c) { return on_side(outer.box, load.side, mesh.vertices[at(vertex(c))]); }))
        continue;
      for (const Index c : ends) {
        const double off =
            std::abs(along(load.side, mesh.vertices[at(vertex(c))]) - 0.5 * (load.from + load.to));
        if (off < distance) distance = off, nearest = vertex(c);
        if (holds(c)) vertices.push_back(vertex(c));
      }
      if (!holds(side.first) || !holds(side.second)) continue;
      side.loaded = any = true;
      const double half =
          0.5 * norm(mesh.vertices[at(vertex(side.second))] - mesh.vertices[at(vertex(side.first))]);
      if (load.traction == Vec2{}) continue;
      for (const Index c : ends) pulls_.push_back({number_of(c), l, half});
    }
    if (load.traction != Vec2{} && !any) {
      throw MeshError(
          fmt::format("load {} has a traction on a part of its side that holds no edge of the mesh: make the "
                      "part longer or the mesh finer there",
                      l + 1));
    }
    if (vertices.empty() && nearest >= 0) vertices.push_back(nearest);  // a point
    if (vertices.empty()) throw MeshError(fmt::format("load {}: the mesh has no edge on that side", l + 1));
    for (const Index v : vertices) {
      for (const Index c : corners[v]) {
        Place& place = places[c];
        if (place.owner < 0) place.owner = l;
        for (std::size_t i = 0; i < 2; ++i) {
          if (load.motion[i] && place.motion[i] < 0) place.motion[i] = l;
        }
      }
    }
  }
  for (const auto& side : outer.sides) {
    const double half =
        0.5 * norm(mesh.vertices[at(vertex(side.second))] - mesh.vertices[at(vertex(side.first))]);
    places[side.first].length += half;
    places[side.second].length += half;
    if (side.loaded) continue;
    unloaded_.push_back(side.first);
    unloaded_.push_back(side.second);
  }
  for (const auto& [corner, place] : places) places_.push_back(place);
  constant_.resize(places_.size());
}

void Loads::hold(State& state, bool others_free) const {
  if (others_free) return;
  for (const Index c : unloaded_) state.inverse_mass[at(state.node_of_corner[at(c)])] = 0.0;
}

void Loads::bear(const State& state, std::span<const Vec2> forces) {
  // Shared out by the edges of the boundary, as the corners of a node may part.
  struct Whole {
    Vec2 force;
    double length = 0.0;
  };
  std::map<Index, Whole> of_node;
  const auto node = [&](const Place& place) { return state.node_of_corner[at(place.corner)]; };
  for (const Place& place : places_) {
    Whole& whole = of_node[node(place)];
    whole.force += -forces[at(place.corner)];
    whole.length += place.length;
  }
  for (std::size_t i = 0; i < places_.size(); ++i) {
    const Whole& whole = of_node[node(places_[i])];
    constant_[i] = whole.length > 0.0 ? (places_[i].length / whole.length) * whole.force
                                      : -forces[at(places_[i].corner)];
  }
  node_count_ = -1;
}

void Loads::restore(LoadsMemory memory) {
  constant_ = std::move(memory.constant);
  impulses_ = std::move(memory.impulses);
}

// The nodes that the corners are of now.
void Loads::group(const State& state) {
  nodes_.clear();
  node_of_place_.resize(places_.size());
  std::map<Index, std::size_t> number;
  for (std::size_t i = 0; i < places_.size(); ++i) {
    const Place& place = places_[i];
    const Index node = state.node_of_corner[at(place.corner)];
    const auto [it, fresh] = number.try_emplace(node, nodes_.size());
    if (fresh) nodes_.push_back({node, {}, {}, place.motion, place.owner});
    nodes_[it->second].constant += constant_[i];
    node_of_place_[i] = it->second;
  }
  node_count_ = state.node_count();
}

void Loads::begin(const State& state) {
  if (node_count_ != state.node_count()) group(state);
  for (Node& n : nodes_) n.velocity_before = state.velocity[at(n.node)];
}

double Loads::apply(State& state, double dt) {
  force_.assign(nodes_.size(), {});
  for (LoadImpulse& i : impulses_) i.time += dt;
  for (const Pull& pull : pulls_) {
    const Load& load = loads_[at(pull.load)];
    const Vec2 f = (pull.length * growth(state.time, load.ramp)) * load.traction;
    force_[node_of_place_[pull.place]] += f;
    impulses_[at(pull.load)].impulse += dt * f;
  }
  double half = 0.0;
  for (std::size_t k = 0; k < nodes_.size(); ++k) {
    const Node& n = nodes_[k];
    const double inverse_mass = state.inverse_mass[at(n.node)];
    if (inverse_mass == 0.0) continue;
    Vec2& v = state.velocity[at(n.node)];
    Vec2 force = n.constant + force_[k];
    Vec2 now = v + (dt * inverse_mass) * force;
    for (std::size_t i = 0; i < 2; ++i) {
      if (n.motion[i] < 0) continue;
      const Load& load = loads_[at(n.motion[i])];
      const GivenMotion& m = *load.motion[i];
      const double target = displacement_at(m, state.time + dt, load.ramp);
      double given = (target - displacement_at(m, state.time, load.ramp)) / dt;
      if (load.one_sided && i == (across_x(load.side) ? 0U : 1U)) {
        const double before = component(state.displacement[at(n.node)], i) - dt * component(v, i);
        if (outward(load.side) * (before + dt * component(now, i) - target) < 0.0) continue;  // apart
        given = (target - before) / dt;
      }
      const double reaction = (given - component(v, i)) / (dt * inverse_mass);
      component(impulses_[at(n.motion[i])].impulse, i) += dt * (reaction - component(force_[k], i));
      component(force, i) = reaction;
      component(now, i) = given;
    }
    for (std::size_t i = 0; i < 2; ++i) {
      if (n.motion[i] < 0 && n.owner >= 0)
        component(impulses_[at(n.owner)].impulse, i) += dt * component(n.constant, i);
    }
    state.displacement[at(n.node)] += dt * (now - v);
    v = now;
    // Work of a force over a step is force times the mean of the velocities before and after.
    state.dissipation.boundary -= 0.5 * dt * dot(force, n.velocity_before + now);
    half -= 0.5 * dt * dot(force, n.velocity_before);
  }
  return half;
}

void Loads::balance(const State& state, std::span<Vec2> node_forces) const {
  for (std::size_t i = 0; i < places_.size(); ++i) {
    Vec2& f = node_forces[at(state.node_of_corner[at(places_[i].corner)])];
    f += constant_[i];
  }
  for (const Place& place : places_) {
    Vec2& f = node_forces[at(state.node_of_corner[at(place.corner)])];
    for (std::size_t i = 0; i < 2; ++i) {
      if (place.motion[i] >= 0) component(f, i) = 0.0;
    }
  }
}

std::vector<LoadRecord> Loads::take(const State& state) {
  std::vector<LoadRecord> records(loads_.size());
  std::vector<int> corners(loads_.size(), 0);
  for (const Place& place : places_) {
    if (place.owner < 0) continue;
    records[at(place.owner)].displacement += state.displacement[at(state.node_of_corner[at(place.corner)])];
    ++corners[at(place.owner)];
  }
  for (std::size_t l = 0; l < records.size(); ++l) {
    records[l].displacement = (1.0 / std::max(1, corners[l])) * records[l].displacement;
    if (impulses_[l].time > 0.0) records[l].force = (1.0 / impulses_[l].time) * impulses_[l].impulse;
    impulses_[l] = {};
  }
  return records;
}

}  // namespace crackle
