// SPDX-License-Identifier: GPL-3.0-or-later
//
// Tractions that hold a split mesh in equilibrium: round every vertex the corners form a fan, joined
// by cohesive elements; corner j of the fan is in balance when
//   R_j + f_j − f_{j−1} = 0
// with R_j its rock and load force and f_j the force that element j puts on it. In an open fan the
// first corner fixes all; in a closed one a constant is free, and is taken where the tractions come
// nearest (in the mean) to those of the stresses on both sides.
#include <algorithm>
#include <cmath>

#include "crackle/cohesive/cohesive.hpp"

namespace crackle {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

// The other triangle's corner at the same vertex across side `side` of corner's triangle, when that
// side carries an unbroken element; -1 otherwise.
struct Neighbour {
  Index corner = -1;
  Index element = -1;
  bool on_face_a = false;  // whether the corner we came from is on face a
};

Neighbour across(const State& state, Index triangle, Index side, Index vertex) {
  const Mesh& mesh = *state.mesh;
  const Index code = state.element_on_side[at(3 * triangle + side)];
  if (code >= 2 * state.cohesive.count()) return {};
  const Index element = code / 2;
  if (state.cohesive.status[at(element)] >= CohesiveStatus::broken) return {};
  const bool a = code % 2 == 0;
  const Edge& edge = mesh.edges[at(state.cohesive.edge[at(element)])];
  const Index other = edge.triangle[a ? 1 : 0];
  for (Index i = 0; i < 3; ++i) {
    if (mesh.triangles[at(other)][at(i)] == vertex) return {3 * other + i, element, a};
  }
  return {};
}

// The force on face a that the stresses of the two triangles ask for at each end of an element: a
// triangle's corner force is half the traction resultant of the side opposite to that corner.
Vec2 stress_force(const State& state, std::span<const Vec2> corner_forces, Index element) {
  const Edge& edge = state.mesh->edges[at(state.cohesive.edge[at(element)])];
  const Index opposite_a = 3 * edge.triangle[0] + (edge.side[0] + 2) % 3;
  const Index opposite_b = 3 * edge.triangle[1] + (edge.side[1] + 2) % 3;
  return 0.5 * (corner_forces[at(opposite_a)] - corner_forces[at(opposite_b)]);
}

}  // namespace

std::vector<Index> Cohesive::balance(State& state, std::span<const Vec2> corner_forces) const {
  const Mesh& mesh = *state.mesh;
  CohesiveElements& c = state.cohesive;
  std::vector<EndForces> target(c.edge.size());
  std::vector<char> done(mesh.vertices.size(), 0);

  // Force on the corner of the walk, turned to "force on face a at this end".
  const auto set = [&](const Neighbour& n, Index vertex, Vec2 on_corner) {
    const Edge& edge = mesh.edges[at(c.edge[at(n.element)])];
    const Vec2 on_a = n.on_face_a ? on_corner : -on_corner;
    (edge.vertex[0] == vertex ? target[at(n.element)].end0 : target[at(n.element)].end1) = on_a;
  };

  for (Index start = 0; start < 3 * mesh.triangle_count(); ++start) {
    const Index vertex = mesh.triangles[at(start / 3)][at(start % 3)];
    if (done[at(vertex)]) continue;
    done[at(vertex)] = 1;
    // Back (clockwise) to the first corner of an open fan.
    Index first = start;
    bool closed = false;
    for (;;) {
      const Neighbour n = across(state, first / 3, first % 3, vertex);
      if (n.corner < 0) break;
      first = n.corner;
      if (first == start) {
        closed = true;
        break;
      }
    }
    std::vector<Index> fan{first};
    std::vector<Neighbour> links;
    for (;;) {
      const Neighbour n = across(state, fan.back() / 3, (fan.back() % 3 + 2) % 3, vertex);
      if (n.corner < 0) break;
      links.push_back(n);
      if (n.corner == first) break;
      fan.push_back(n.corner);
    }
    const bool fixed = state.inverse_mass[at(state.node_of_corner[at(first)])] == 0.0;
    std::vector<Vec2> wanted(links.size());
    for (std::size_t k = 0; k < links.size(); ++k) {
      const Vec2 on_a = stress_force(state, corner_forces, links[k].element);
      wanted[k] = links[k].on_face_a ? on_a : -on_a;
    }
    std::vector<Vec2> force(links.size());
    if (fixed) {
      force = wanted;
    } else {
      Vec2 f;
      Vec2 shift;
      for (std::size_t k = 0; k < links.size(); ++k) {
        f -= corner_forces[at(fan[k])];
        force[k] = f;
        shift += wanted[k] - f;
      }
      if (closed && !links.empty()) {
        shift *= 1.0 / static_cast<double>(links.size());
        for (Vec2& g : force) g += shift;
      }
    }
    for (std::size_t k = 0; k < links.size(); ++k) set(links[k], vertex, force[k]);
  }

  // The separations that bear those forces. Where the law is curved the middle does not bear the
  // mean of the ends: a few corrections of the end tractions settle that.
  std::vector<Index> beyond;
  const double tensile_limit = 0.999 * material_.tensile_strength;
  for (Index e = 0; e < c.count(); ++e) {
    const double length = norm(c.direction[at(e)]);
    c.offset[at(e)] = {};
    const EndSeparation geometry = separation(state, e);
    const Vec2 t = geometry.direction;
    const Vec2 n = right_normal(t);
    const auto end_traction = [&](Vec2 own, Vec2 other) { return (2.0 / length) * (2.0 * own - other); };
    Vec2 ask0 = end_traction(target[at(e)].end0, target[at(e)].end1);
    Vec2 ask1 = end_traction(target[at(e)].end1, target[at(e)].end0);
    bool over = false;
    std::array<double, 4> separations{};
    for (int pass = 0; pass < 60; ++pass) {
      const auto place = [&](Vec2 traction, double& opening, double& slip) {
        double normal = dot(traction, n);
        double shear = dot(traction, t);
        const double strength = material_.cohesion - std::min(normal, 0.0) * material_.tan_friction;
        if (normal > tensile_limit || std::abs(shear) > 0.999 * strength) over = true;
        normal = std::min(normal, tensile_limit);
        shear = std::clamp(shear, -0.999 * strength, 0.999 * strength);
        opening = law_->elastic_opening(material_, length, normal);
        slip = law_->elastic_slip(material_, length, normal, shear);
      };
      place(ask0, separations[0], separations[1]);
      place(ask1, separations[2], separations[3]);
      if (over) break;
      const auto traction = [&](double o, double s) {
        const ElasticTraction q =
            elastic_traction(material_.penalty / length, law_->curvature(), material_.tensile_strength,
                             material_.cohesion, material_.tan_friction, o, s);
        return q.normal * n + q.shear * t;
      };
      const Vec2 middle =
          traction(0.5 * (separations[0] + separations[2]), 0.5 * (separations[1] + separations[3]));
      const Vec2 t0 = traction(separations[0], separations[1]);
      const Vec2 t1 = traction(separations[2], separations[3]);
      const Vec2 miss0 = target[at(e)].end0 - (length / 6.0) * (t0 + 2.0 * middle);
      const Vec2 miss1 = target[at(e)].end1 - (length / 6.0) * (t1 + 2.0 * middle);
      const double scale = norm(target[at(e)].end0) + norm(target[at(e)].end1);
      if (norm(miss0) + norm(miss1) <= 1e-15 * scale) break;
      ask0 += end_traction(miss0, miss1);
      ask1 += end_traction(miss1, miss0);
    }
    if (over) beyond.push_back(e);
    c.offset[at(e)] = {separations[0] - geometry.opening0, separations[1] - geometry.slip0,
                       separations[2] - geometry.opening1, separations[3] - geometry.slip1};
  }
  return beyond;
}

}  // namespace crackle
