// SPDX-License-Identifier: GPL-3.0-or-later
#include "crackle/solve/fracture_path.hpp"

#include <algorithm>
#include <cmath>

namespace crackle {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

bool contains(const std::vector<Index>& sorted, Index i) {
  return std::binary_search(sorted.begin(), sorted.end(), i);
}

}  // namespace

FracturePath::FracturePath(std::shared_ptr<const Mesh> mesh, Held held, bool slip)
    : mesh_(std::move(mesh)), held_(std::move(held)), slip_(slip) {
  first_.assign(mesh_->vertices.size() + 1, 0);
  for (const auto& triangle : mesh_->triangles) {
    for (const Index v : triangle) ++first_[at(v) + 1];
  }
  for (std::size_t v = 1; v < first_.size(); ++v) first_[v] += first_[v - 1];
  triangles_.resize(3 * mesh_->triangles.size());
  std::vector<Index> next(first_.begin(), first_.end() - 1);
  for (Index t = 0; t < mesh_->triangle_count(); ++t) {
    for (const Index v : mesh_->triangles[at(t)]) triangles_[at(next[at(v)]++)] = t;
  }
  on_path_.assign(mesh_->edges.size(), 0);
}

std::vector<Index> FracturePath::fan(Index vertex) const {
  return {triangles_.begin() + first_[at(vertex)], triangles_.begin() + first_[at(vertex) + 1]};
}

std::vector<Index> FracturePath::mesh_edges_at(Index vertex) const {
  std::vector<Index> found;
  for (const Index t : fan(vertex)) {
    for (const Index e : mesh_->triangle_edges[at(t)]) {
      const auto& ends = mesh_->edges[at(e)].vertex;
      const bool known = std::find(found.begin(), found.end(), e) != found.end();
      if (!known && (ends[0] == vertex || ends[1] == vertex)) found.push_back(e);
    }
  }
  return found;
}

std::vector<Index> FracturePath::at_vertex(Index vertex) const {
  std::vector<Index> found;
  for (std::size_t e = 0; e < edges_.size(); ++e) {
    if (edges_[e].vertex[0] == vertex || edges_[e].vertex[1] == vertex)
      found.push_back(static_cast<Index>(e));
  }
  return found;
}

std::vector<std::vector<Index>> FracturePath::sectors(Index vertex) const {
  const std::vector<Index> around = fan(vertex);  // sorted
  std::vector<char> seen(around.size(), 0);
  std::vector<std::vector<Index>> found;
  for (std::size_t start = 0; start < around.size(); ++start) {
    if (seen[start]) continue;
    std::vector<Index> sector{around[start]};
    seen[start] = 1;
    for (std::size_t next = 0; next < sector.size(); ++next) {
      for (const Index e : mesh_->triangle_edges[at(sector[next])]) {
        const Edge& edge = mesh_->edges[at(e)];
        if (on_path_[at(e)] || (edge.vertex[0] != vertex && edge.vertex[1] != vertex)) continue;
        for (const Index t : edge.triangle) {
          if (t < 0) continue;
          const auto where = std::lower_bound(around.begin(), around.end(), t) - around.begin();
          if (seen[static_cast<std::size_t>(where)]) continue;
          seen[static_cast<std::size_t>(where)] = 1;
          sector.push_back(t);
        }
      }
    }
    std::sort(sector.begin(), sector.end());
    found.push_back(std::move(sector));
  }
  return found;
}

void FracturePath::split(Index vertex, Vec2 normal) {
  std::vector<std::vector<Index>> taken;  // unknowns that hold each sector met so far
  for (const std::vector<Index>& sector : sectors(vertex)) {
    std::vector<Index> holding;
    for (std::size_t k = 0; k < unknowns_.size(); ++k) {
      if (unknowns_[k].vertex == vertex && contains(unknowns_[k].triangles, sector.front()))
        holding.push_back(static_cast<Index>(k));
    }
    if (std::find(taken.begin(), taken.end(), holding) == taken.end()) {
      taken.push_back(std::move(holding));
      continue;
    }
    const int held = held_.empty() ? 0 : held_[at(vertex)];
    if (!slip_) {
      unknowns_.push_back({vertex, normal, sector});
    } else {
      if (!(held & 1)) unknowns_.push_back({vertex, {1.0, 0.0}, sector});
      if (!(held & 2)) unknowns_.push_back({vertex, {0.0, 1.0}, sector});
    }
  }
}

void FracturePath::renew_jumps(Index vertex) {
  for (const Index p : at_vertex(vertex)) {
    PathEdge& path = edges_[at(p)];
    const Edge& edge = mesh_->edges[at(path.edge)];
    const Vec2 tangent{-path.normal.y, path.normal.x};
    std::vector<JumpTerm>& terms = path.jump[path.vertex[0] == vertex ? 0 : 1];
    terms.clear();
    for (std::size_t k = 0; k < unknowns_.size(); ++k) {
      const JumpUnknown& unknown = unknowns_[k];
      if (unknown.vertex != vertex) continue;
      const int sign = int{contains(unknown.triangles, edge.triangle[1])} -
                       int{contains(unknown.triangles, edge.triangle[0])};
      if (sign != 0) {
        terms.push_back({static_cast<Index>(k), sign * dot(path.normal, unknown.direction),
                         sign * dot(tangent, unknown.direction)});
      }
    }
  }
}

Index FracturePath::add(Index edge, Index inner, Index parent, double aperture, Vec2 along) {
  const Edge& e = mesh_->edges[at(edge)];
  PathEdge path;
  path.edge = edge;
  path.parent = parent;
  path.aperture = aperture;
  path.vertex = {inner, e.vertex[0] == inner ? e.vertex[1] : e.vertex[0]};
  const Vec2 n = right_normal(mesh_->vertices[at(e.vertex[1])] - mesh_->vertices[at(e.vertex[0])]);
  const Vec2 across = norm(along) > 0.0 ? right_normal(along) : n;
  path.length = norm(across);
  path.normal = ((dot(across, n) < 0.0 ? -1.0 : 1.0) / path.length) * across;
  unknowns_before_.push_back(unknowns_.size());
  on_path_[at(edge)] = 1;
  edges_.push_back(path);
  for (const Index v : path.vertex) split(v, path.normal);
  for (const Index v : path.vertex) renew_jumps(v);
  return static_cast<Index>(edges_.size()) - 1;
}

void FracturePath::truncate(std::size_t count) {
  while (edges_.size() > count) {
    const std::array<Index, 2> ends = edges_.back().vertex;
    on_path_[at(edges_.back().edge)] = 0;
    unknowns_.resize(unknowns_before_.back());
    unknowns_before_.pop_back();
    edges_.pop_back();
    for (const Index v : ends) renew_jumps(v);
  }
}

}  // namespace crackle
