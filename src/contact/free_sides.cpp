// SPDX-License-Identifier: GPL-3.0-or-later
#include "free_sides.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace crackle {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

constexpr double pi = 3.141592653589793;
// Corners that turn by at least this [rad] are rounded, with this share of the shorter side as radius,
// and not so much that more than that share of a side goes.
constexpr double least_turn = 0.2, radius_of_side = 0.05, cut_of_side = 0.3;

// True if the mesh falls into several parts, joined by no edge.
bool falls_apart(const Mesh& mesh) {
  std::vector<char> reached(mesh.triangles.size(), 0);
  std::vector<Index> todo;
  if (!reached.empty()) {
    reached[0] = 1;
    todo.push_back(0);
  }
  std::size_t seen = 0;
  while (!todo.empty()) {
    const Index t = todo.back();
    todo.pop_back();
    ++seen;
    for (const Index e : mesh.triangle_edges[at(t)]) {
      for (const Index other : mesh.edges[at(e)].triangle) {
        if (other < 0 || reached[at(other)]) continue;
        reached[at(other)] = 1;
        todo.push_back(other);
      }
    }
  }
  return seen < mesh.triangles.size();
}

// The broken element on a side; -1 if the side is tied or on a boundary.
Index broken_element(const State& state, Index corner) {
  const Index code = state.element_on_side[at(corner)];
  if (code < 0) return -1;
  const Index element = code / 2;
  const CohesiveStatus status = state.cohesive.status[at(element)];
  return status == CohesiveStatus::broken || status == CohesiveStatus::released ? element : -1;
}

bool is_free(const State& state, Index corner) {
  const Edge& edge = state.mesh->edges[at(state.mesh->triangle_edges[at(corner / 3)][at(corner % 3)])];
  return edge.triangle[1] < 0 || broken_element(state, corner) >= 0;
}

Index next_corner(Index corner) { return corner % 3 == 2 ? corner - 2 : corner + 1; }

double angle_at(const State& state, Index corner) {
  const Vec2 x = state.reference(corner);
  const Vec2 out = state.reference(next_corner(corner)) - x;
  const Vec2 in = state.reference(next_corner(next_corner(corner))) - x;
  return std::atan2(cross(out, in), dot(out, in));
}

}  // namespace

FreeSides::FreeSides(const Mesh& mesh) : separate_bodies_(falls_apart(mesh)) {
  for (const Edge& edge : mesh.edges) {
    if (edge.triangle[1] < 0) boundary_.push_back(3 * edge.triangle[0] + edge.side[0]);
  }
}

void FreeSides::build(const State& state) {
  std::vector<Index> corners = boundary_;
  for (const CohesiveHistory& h : state.cohesive.histories) {
    const Edge& edge = state.mesh->edges[at(state.cohesive.edge[at(h.element)])];
    const Index a = 3 * edge.triangle[0] + edge.side[0];
    if (broken_element(state, a) != h.element) continue;
    corners.push_back(a);
    corners.push_back(3 * edge.triangle[1] + edge.side[1]);
  }
  std::sort(corners.begin(), corners.end());
  sides_.assign(corners.size(), {});
  for (std::size_t i = 0; i < corners.size(); ++i) {
    FreeSide& side = sides_[i];
    side.corner = corners[i];
    side.node = {state.node_of_corner[at(side.corner)], state.node_of_corner[at(next_corner(side.corner))]};
    side.element = broken_element(state, side.corner);
    if (side.element >= 0) {
      side.face_b = state.element_on_side[at(side.corner)] % 2 == 1;
      side.matched = state.cohesive.status[at(side.element)] == CohesiveStatus::broken;
    }
    const Vec2 along = state.reference(next_corner(side.corner)) - state.reference(side.corner);
    const Vec2 up = state.reference(next_corner(next_corner(side.corner))) - state.reference(side.corner);
    side.length = norm(along);
    side.reach = 0.5 * std::min(side.length, cross(along, up) / side.length);
  }
  for (FreeSide& side : sides_) connect(state, side);
  for (Index i = 0; i < count(); ++i) {
    FreeSide& side = sides_[at(i)];
    FreeSide& next = sides_[at(side.next)];
    next.previous = i;
    const double turn = pi - side.angle_at_end;
    if (turn < least_turn) continue;
    const double shorter = std::min(side.length, next.length);
    side.radius_at_end = std::min(
        {radius_of_side * shorter, cut_of_side * shorter / std::tan(0.5 * turn), side.reach, next.reach});
  }
}

void FreeSides::connect(const State& state, FreeSide& side) const {
  // Round the vertex at the side's end, through rock that is tied together, to the next free side.
  Index corner = next_corner(side.corner);
  side.angle_at_end = angle_at(state, corner);
  while (!is_free(state, corner)) {
    const Edge& edge = state.mesh->edges[at(state.mesh->triangle_edges[at(corner / 3)][at(corner % 3)])];
    const std::size_t other = edge.triangle[0] == corner / 3 ? 1 : 0;
    corner = next_corner(3 * edge.triangle[other] + edge.side[other]);
    side.angle_at_end += angle_at(state, corner);
  }
  side.next = find(corner);
}

Index FreeSides::find(Index corner) const {
  const auto found = std::lower_bound(sides_.begin(), sides_.end(), corner,
                                      [](const FreeSide& side, Index value) { return side.corner < value; });
  if (found == sides_.end() || found->corner != corner) return -1;
  return static_cast<Index>(found - sides_.begin());
}

bool FreeSides::near(Index a, Index b, int steps) const {
  Index forward = a, backward = a;
  for (int i = 0; i < steps && forward != b && backward != b; ++i) {
    forward = sides_[at(forward)].next;
    backward = sides_[at(backward)].previous;
  }
  return forward == b || backward == b;
}

void FreeSides::mark_taken_over(const std::vector<Index>& elements) {
  for (FreeSide& side : sides_) {
    side.taken_over = side.element >= 0 && std::binary_search(elements.begin(), elements.end(), side.element);
  }
}

void FreeSides::place(const State& state, std::vector<PlacedSide>& placed) const {
  placed.resize(sides_.size());
  for (std::size_t i = 0; i < sides_.size(); ++i) {
    placed[i] = {state.position(sides_[i].corner), state.position(next_corner(sides_[i].corner))};
  }
}

}  // namespace crackle
