// SPDX-License-Identifier: GPL-3.0-or-later
//
// Tractions that hold a split mesh in equilibrium, or in the motion that it has. Round a vertex lie
// nodes (fans of tied corners), joined by cohesive elements; node j is carried on as it should when
//   F_j + f_j − f_{j−1} = m_j a
// with F_j the rock and load force on it, f_j the force that element j puts on it and a the
// acceleration of the whole. In an open row the first node fixes all; in a closed one a constant is
// free, and is taken where the tractions come nearest (in the mean) to those of the stresses on both
// sides.
#include <algorithm>
#include <cmath>
#include <map>

#include "crackle/cohesive/cohesive.hpp"

namespace crackle {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

// What joins a corner to the next one round its vertex: a tied edge, or an unbroken element.
struct Link {
  Index corner = -1;   // the next corner; -1: nothing joins
  Index element = -1;  // -1: tied
  bool on_face_a = false;
};

Link across(const State& state, Index triangle, Index side, Index vertex) {
  const Mesh& mesh = *state.mesh;
  const Index e = mesh.triangle_edges[at(triangle)][at(side)];
  const Edge& edge = mesh.edges[at(e)];
  if (edge.triangle[1] < 0) return {};
  const Index element = state.cohesive.of_edge[at(e)];
  if (element >= 0 && state.cohesive.status[at(element)] >= CohesiveStatus::broken) return {};
  const bool a = edge.triangle[0] == triangle;
  const Index other = edge.triangle[a ? 1 : 0];
  for (Index i = 0; i < 3; ++i) {
    if (mesh.triangles[at(other)][at(i)] == vertex) return {3 * other + i, element, a};
  }
  return {};
}

Link clockwise(const State& state, Index corner, Index vertex) {
  return across(state, corner / 3, corner % 3, vertex);
}
Link counterclockwise(const State& state, Index corner, Index vertex) {
  return across(state, corner / 3, (corner % 3 + 2) % 3, vertex);
}

// Nodes of a vertex in counter-clockwise order, and the elements between them.
struct Row {
  std::vector<Index> nodes;
  std::vector<Vec2> force;  // on each node, without the elements' between them
  std::vector<Link> links;  // links[k] joins node k to the next; closed: the last to the first
  bool closed = false;
};

// The row that a corner belongs to, as far as `belongs(node)`.
template <class Belongs>
Row row_of(const State& state, Index start, Index vertex, const CornerForce& force, const Belongs& belongs) {
  const auto node_of = [&](Index corner) { return state.node_of_corner[at(corner)]; };
  Row row;
  Index first = start;
  for (;;) {
    const Link link = clockwise(state, first, vertex);
    if (link.corner < 0 || !belongs(node_of(link.corner))) break;
    first = link.corner;
    if (first == start) {
      row.closed = true;
      break;
    }
  }
  if (row.closed) {  // begin where a node begins
    while (clockwise(state, first, vertex).element < 0) first = clockwise(state, first, vertex).corner;
  }
  row.nodes.push_back(node_of(first));
  row.force.push_back(force(first));
  for (Index corner = first;;) {
    const Link link = counterclockwise(state, corner, vertex);
    if (link.corner < 0 || !belongs(node_of(link.corner))) break;
    if (link.element >= 0) row.links.push_back(link);
    if (link.corner == first) break;
    corner = link.corner;
    if (link.element >= 0) {
      row.nodes.push_back(node_of(corner));
      row.force.emplace_back();
    }
    row.force.back() += force(corner);
  }
  return row;
}

// Force on a corner of elements at its vertex that part nodes already: not between two that belong.
template <class Belongs>
Vec2 force_of_open_elements(const State& state, Index corner, Index vertex, const Belongs& belongs) {
  const CohesiveElements& c = state.cohesive;
  Vec2 sum;
  for (const Index side : {corner % 3, (corner + 2) % 3}) {
    const Index e = state.mesh->triangle_edges[at(corner / 3)][at(side)];
    const Index element = c.of_edge[at(e)];
    if (element < 0) continue;
    const Edge& edge = state.mesh->edges[at(e)];
    const std::size_t end = edge.vertex[0] == vertex ? 0 : 1;
    const auto& nodes = c.nodes[at(element)];
    if (belongs(nodes[end]) && belongs(nodes[2 + end])) continue;
    const Vec2 on_a = end == 0 ? c.force[at(element)].end0 : c.force[at(element)].end1;
    sum += edge.triangle[0] == corner / 3 ? on_a : -on_a;
  }
  return sum;
}

// The force on face a that the stresses of the two triangles ask for at each end of an element: a
// triangle's corner force is half the traction resultant of the side opposite to that corner.
Vec2 stress_force(const State& state, const CornerForce& force, Index element) {
  const Edge& edge = state.mesh->edges[at(state.cohesive.edge[at(element)])];
  const Index opposite_a = 3 * edge.triangle[0] + (edge.side[0] + 2) % 3;
  const Index opposite_b = 3 * edge.triangle[1] + (edge.side[1] + 2) % 3;
  return 0.5 * (force(opposite_a) - force(opposite_b));
}

// Forces that the links put on the node before each, so that every node goes on at `acceleration`.
// @param rock internal force of a corner
std::vector<Vec2> share(const State& state, const Row& row, Vec2 acceleration, const CornerForce& rock) {
  std::vector<Vec2> wanted;
  for (const Link& link : row.links) {
    const Vec2 on_a = stress_force(state, rock, link.element);
    wanted.push_back(link.on_face_a ? on_a : -on_a);
  }
  if (state.inverse_mass[at(row.nodes.front())] == 0.0) return wanted;  // held: nothing to balance
  std::vector<Vec2> result;
  Vec2 f, shift;
  for (std::size_t k = 0; k < row.links.size(); ++k) {
    f += (1.0 / state.inverse_mass[at(row.nodes[k])]) * acceleration - row.force[k];
    result.push_back(f);
    shift += wanted[k] - f;
  }
  if (row.closed && !row.links.empty()) {
    shift *= 1.0 / static_cast<double>(row.links.size());
    for (Vec2& g : result) g += shift;
  }
  return result;
}

// The force on an element's face a at each end, and which of them are given.
struct Target {
  EndForces force;
  bool given0 = false, given1 = false;
};

// Gives the force at the element's end at `vertex`.
void aim(const State& state, const Link& link, Index vertex, Vec2 on_node_before, Target& target) {
  const Vec2 on_a = link.on_face_a ? on_node_before : -on_node_before;
  const Edge& edge = state.mesh->edges[at(state.cohesive.edge[at(link.element)])];
  const bool first = edge.vertex[0] == vertex;
  (first ? target.force.end0 : target.force.end1) = on_a;
  (first ? target.given0 : target.given1) = true;
}

// Those at vertices where nodes have parted, as far as they were there before: what they bear is not known.
std::vector<Index> intact_elements_at(const State& state, std::span<const Parting> partings,
                                      Index first_new) {
  const CohesiveElements& c = state.cohesive;
  std::vector<Index> elements;
  for (const Parting& parting : partings) {
    for (const Index corner : corners_at(state, parting.vertex)) {
      for (const Index side : {corner % 3, (corner + 2) % 3}) {
        const Index element = c.of_edge[at(state.mesh->triangle_edges[at(corner / 3)][at(side)])];
        if (element >= 0 && element < first_new && c.status[at(element)] == CohesiveStatus::intact)
          elements.push_back(element);
      }
    }
  }
  std::sort(elements.begin(), elements.end());
  elements.erase(std::unique(elements.begin(), elements.end()), elements.end());
  return elements;
}

}  // namespace

// Sets the offsets with which an element bears end forces where it is now. Where the law is curved the
// middle does not bear the mean of the ends: a few corrections of the end tractions settle that.
// False if that is beyond its elastic branch: it bears the most it can there.
bool Cohesive::bear(State& state, Index e, const EndForces& target) const {
  CohesiveElements& c = state.cohesive;
  const CohesiveMaterial m = material(state, e);
  const double tensile_limit = 0.999 * m.tensile_strength;
  const double length = norm(c.direction[at(e)]);
  c.offset[at(e)] = {};
  const EndSeparation geometry = separation(state, e);
  const Vec2 t = geometry.direction;
  const Vec2 n = right_normal(t);
  const auto end_traction = [&](Vec2 own, Vec2 other) { return (2.0 / length) * (2.0 * own - other); };
  Vec2 ask0 = end_traction(target.end0, target.end1);
  Vec2 ask1 = end_traction(target.end1, target.end0);
  bool over = false;
  std::array<double, 4> separations{};
  for (int pass = 0; pass < 60; ++pass) {
    const auto place = [&](Vec2 traction, double& opening, double& slip) {
      double normal = dot(traction, n);
      double shear = dot(traction, t);
      const double strength = m.cohesion - std::min(normal, 0.0) * m.tan_friction;
      if (normal > tensile_limit || std::abs(shear) > 0.999 * strength) over = true;
      normal = std::min(normal, tensile_limit);
      shear = std::clamp(shear, -0.999 * strength, 0.999 * strength);
      opening = law_->elastic_opening(m, length, normal);
      slip = law_->elastic_slip(m, length, normal, shear);
    };
    place(ask0, separations[0], separations[1]);
    place(ask1, separations[2], separations[3]);
    if (over) break;
    const auto traction = [&](double o, double s) {
      const ElasticTraction q = elastic_traction(m.penalty / length, law_->curvature(), m.tensile_strength,
                                                 m.cohesion, m.tan_friction, o, s);
      return q.normal * n + q.shear * t;
    };
    const Vec2 middle =
        traction(0.5 * (separations[0] + separations[2]), 0.5 * (separations[1] + separations[3]));
    const Vec2 t0 = traction(separations[0], separations[1]);
    const Vec2 t1 = traction(separations[2], separations[3]);
    const Vec2 miss0 = target.end0 - (length / 6.0) * (t0 + 2.0 * middle);
    const Vec2 miss1 = target.end1 - (length / 6.0) * (t1 + 2.0 * middle);
    const double scale = norm(target.end0) + norm(target.end1);
    if (norm(miss0) + norm(miss1) <= 1e-15 * scale) break;
    ask0 += end_traction(miss0, miss1);
    ask1 += end_traction(miss1, miss0);
  }
  c.offset[at(e)] = {separations[0] - geometry.opening0, separations[1] - geometry.slip0,
                     separations[2] - geometry.opening1, separations[3] - geometry.slip1};
  return !over;
}

std::vector<Index> Cohesive::balance(State& state, std::span<const Vec2> corner_forces) const {
  const Mesh& mesh = *state.mesh;
  const CornerForce force = [&](Index corner) { return corner_forces[at(corner)]; };
  const auto any = [](Index) { return true; };
  std::vector<Target> target(state.cohesive.edge.size());
  std::vector<char> done(mesh.vertices.size(), 0);
  for (Index start = 0; start < 3 * mesh.triangle_count(); ++start) {
    const Index vertex = mesh.triangles[at(start / 3)][at(start % 3)];
    if (done[at(vertex)]) continue;
    done[at(vertex)] = 1;
    const Row row = row_of(state, start, vertex, force, any);
    const std::vector<Vec2> forces = share(state, row, {}, force);
    for (std::size_t k = 0; k < row.links.size(); ++k) {
      aim(state, row.links[k], vertex, forces[k], target[at(row.links[k].element)]);
    }
  }
  std::vector<Index> beyond;
  for (Index e = 0; e < state.cohesive.count(); ++e) {
    if (!bear(state, e, target[at(e)].force)) beyond.push_back(e);
  }
  return beyond;
}

std::vector<Index> Cohesive::insert(State& state, std::span<const Index> edges,
                                    std::span<const double> penalty, std::span<const std::uint16_t> number,
                                    const CornerForce& rock, const CornerForce& load) const {
  CohesiveElements& c = state.cohesive;
  const Index first_new = c.count();
  const std::vector<Parting> partings = insert_elements(state, edges, number);
  // Elements whose ends change what they bear, and what that is; a new one bears what the stresses ask.
  std::map<Index, Target> target;
  for (Index e = first_new; e < c.count(); ++e) {
    begin_history(state, e);
    c.histories.back().penalty = penalty[at(e - first_new)];
    const Vec2 f = stress_force(state, rock, e);
    target[e] = {{f, f}};
  }
  for (const Index e : intact_elements_at(state, partings, first_new)) place_points(state, e);
  for (const Parting& parting : partings) {
    const auto belongs = [&](Index node) {
      return std::find(parting.nodes.begin(), parting.nodes.end(), node) != parting.nodes.end();
    };
    const CornerForce force = [&](Index corner) {
      return rock(corner) + load(corner) + force_of_open_elements(state, corner, parting.vertex, belongs);
    };
    std::vector<Index> done;
    for (const Index node : parting.nodes) {
      if (std::find(done.begin(), done.end(), node) != done.end()) continue;
      const Row row =
          row_of(state, state.node_corners[at(state.node_first[at(node)])], parting.vertex, force, belongs);
      done.insert(done.end(), row.nodes.begin(), row.nodes.end());
      Vec2 sum;
      double mass = 0.0;
      for (std::size_t k = 0; k < row.nodes.size(); ++k) {
        sum += row.force[k];
        mass += 1.0 / state.inverse_mass[at(row.nodes[k])];
      }
      const std::vector<Vec2> forces = share(state, row, (1.0 / mass) * sum, rock);
      for (std::size_t k = 0; k < row.links.size(); ++k) {
        const Index e = row.links[k].element;
        aim(state, row.links[k], parting.vertex, forces[k],
            target.try_emplace(e, Target{c.force[at(e)], true, true}).first->second);
      }
    }
  }
  std::vector<Index> beyond;
  for (auto& [element, wanted] : target) {
    // An end that is tied bears nothing: as the other one.
    if (wanted.given0 && !wanted.given1) wanted.force.end1 = wanted.force.end0;
    if (wanted.given1 && !wanted.given0) wanted.force.end0 = wanted.force.end1;
    const auto& points = c.histories[at(c.history_of[at(element)])].point;
    const bool damaged =
        std::any_of(points.begin(), points.end(), [](const auto& p) { return p.damage > 0.0; });
    if (damaged || !bear(state, element, wanted.force)) beyond.push_back(element);
    if (!damaged) load_springs(state, element);
  }
  return beyond;
}

}  // namespace crackle
