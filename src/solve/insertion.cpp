// SPDX-License-Identifier: GPL-3.0-or-later
//
// How the rock of a simulation comes apart where it is stressed: cohesive elements on demand, on cracks and
// joints from the start, and triangles that begin to be damaged.
#include <algorithm>
#include <cmath>

#include "crackle/core/parallel.hpp"
#include "crackle/solve/simulation.hpp"

namespace crackle {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

}  // namespace

void Simulation::set_screen() {
  // A utilisation of the threshold in opening and slip together is at least its √½ in one of them.
  const double share = std::sqrt(0.5) * scene_.insertion.threshold;
  const auto screen_of = [&](const RockMass& rock) {
    const CohesiveMaterial m = weakest_plane(rock.cohesive);
    return StressScreen{share * m.tensile_strength, share * m.cohesion, share * m.tan_friction};
  };
  screen_ = screen_of(scene_);
  for (const RockMass& layer : scene_.layers) screen_ = either(screen_, screen_of(layer));
}

void Simulation::begin_damage() {
  damage_.emplace(scene_.damage.law, scene_.damage.materials, scene_.damage.of_triangle);
  screen_ = damage_->screen();
  const std::size_t triangles = scene_.mesh->triangles.size();
  stressed_.resize(triangles);
  block_stressed_.resize(at(block_count(scene_.mesh->triangle_count())));
  state_.damage.of_triangle.resize(triangles, -1);
  for (const DamagedTriangle& d : state_.damage.triangles) bulk_.drop_viscosity(d.triangle);
}

// Triangles that came to their strength in the last step.
void Simulation::crack_stressed() {
  std::vector<Index> candidates;
  for (std::size_t block = 0; block < block_stressed_.size(); ++block) {
    if (!block_stressed_[block]) continue;
    const Index begin = static_cast<Index>(block) * block_size;
    const Index end = std::min(begin + block_size, scene_.mesh->triangle_count());
    for (Index t = begin; t < end; ++t) {
      if (stressed_[at(t)] && state_.damage.of_triangle[at(t)] < 0) candidates.push_back(t);
    }
  }
  const std::size_t before = state_.damage.triangles.size();
  damage_->initiate(state_, bulk_, candidates);
  std::vector<Index> cracked;
  for (std::size_t i = before; i < state_.damage.triangles.size(); ++i) {
    cracked.push_back(state_.damage.triangles[i].triangle);
    bulk_.drop_viscosity(cracked.back());
  }
  tiles_->triangles_changed(state_, physics(), cracked);
}

void Simulation::prepare_insertion() {
  set_screen();
  stressed_.assign(scene_.mesh->triangles.size(), 0);
  block_stressed_.assign(at(block_count(scene_.mesh->triangle_count())), 0);
  std::vector<Index> cracks = scene_.cracks;
  std::sort(cracks.begin(), cracks.end());
  insert(cracks);
  cut_cracks();
  insert_joints();
  if (!scene_.damage.law) part_tips();
}

// Rock that stress and excavation alone bring beyond its strength gives way before the pump starts.
void Simulation::break_overstressed() {
  std::ranges::fill(stressed_, std::uint8_t{1});
  std::ranges::fill(block_stressed_, char{1});
  if (damage_) {
    const std::size_t cut = state_.damage.triangles.size();
    crack_stressed();
    geostatic_slips_ += static_cast<Index>(state_.damage.triangles.size() - cut);
  } else {
    insert_stressed();
    geostatic_slips_ += rough_insertions_;
    rough_insertions_ = 0;
  }
  std::ranges::fill(stressed_, std::uint8_t{0});
  std::ranges::fill(block_stressed_, char{0});
}

void Simulation::insert_joints() {
  const auto materials = static_cast<int>(scene_.joint_materials.size());
  for (int number = 1; number <= materials; ++number) {
    const auto material = static_cast<std::uint16_t>(number);
    std::vector<Index> edges;
    for (const JointEdge& joint : scene_.joints) {
      if (joint.material == material) edges.push_back(joint.edge);
    }
    insert(edges, material);
  }
  geostatic_slips_ += rough_insertions_;  // bonded ones beyond their strength
  rough_insertions_ = 0;
}

void Simulation::unbond_joints() {
  for (const JointEdge& joint : scene_.joints) {
    if (!joint.bonded && cohesive_->unbond(state_, state_.cohesive.of_edge[at(joint.edge)]))
      ++geostatic_slips_;
  }
}

// Joints that the wellbore or a wetted crack touches hold fluid from the start.
void Simulation::wet_joints() {
  if (!fluid_ || scene_.joints.empty()) return;
  std::vector<Index> open;
  for (const JointEdge& joint : scene_.joints) {
    if (!joint.bonded) open.push_back(state_.cohesive.of_edge[at(joint.edge)]);
  }
  fluid_->connect(state_, open);
  fluid_->refill(state_, scene_.initial_pressure);
  const bool wet = std::any_of(scene_.joints.begin(), scene_.joints.end(), [&](const JointEdge& joint) {
    return state_.fluid.cavity_of_edge[at(joint.edge)] >= 0;
  });
  if (wet && scene_.initial_pressure != 0.0) ++geostatic_slips_;
}

void Simulation::cut_cracks() {
  for (const Index e : scene_.cracks) cohesive_->cut(state_, state_.cohesive.of_edge[at(e)]);
}

// At the tip of a cut crack stress is singular, and constant in triangles, which would see it late.
void Simulation::part_tips() {
  std::vector<Index> edges;
  for (const Index e : scene_.cracks) {
    const auto& n = state_.cohesive.nodes[at(state_.cohesive.of_edge[at(e)])];
    const auto& ends = scene_.mesh->edges[at(e)].vertex;
    if (n[0] == n[2]) add_tied_edges_at(ends[0], edges);
    if (n[1] == n[3]) add_tied_edges_at(ends[1], edges);
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  insert(edges);
}

void Simulation::add_tied_edges_at(Index vertex, std::vector<Index>& edges) const {
  for (const Index corner : corners_at(state_, vertex)) {
    for (const Index side : {corner % 3, (corner + 2) % 3}) {
      const Index e = scene_.mesh->triangle_edges[at(corner / 3)][at(side)];
      if (scene_.mesh->edges[at(e)].kind == EdgeKind::interior && state_.cohesive.of_edge[at(e)] < 0) {
        edges.push_back(e);
      }
    }
  }
}

void Simulation::insert_stressed() {
  const Mesh& mesh = *scene_.mesh;
  std::vector<std::vector<Index>> found(block_stressed_.size());
  for_each_block(mesh.triangle_count(), [&](Index begin, Index end, Index block) {
    if (!block_stressed_[at(block)]) return;
    for (Index t = begin; t < end; ++t) {
      if (!stressed_[at(t)]) continue;
      for (const Index e : mesh.triangle_edges[at(t)]) {
        const Edge& edge = mesh.edges[at(e)];
        if (edge.kind != EdgeKind::interior || state_.cohesive.of_edge[at(e)] >= 0) continue;
        const Index other = edge.triangle[edge.triangle[0] == t ? 1 : 0];
        if (other < t && stressed_[at(other)]) continue;  // looked at from there
        const Sym2 stress = 0.5 * (bulk_.stress(state_, t) + bulk_.stress(state_, other));
        const Vec2 side = mesh.vertices[at(edge.vertex[1])] - mesh.vertices[at(edge.vertex[0])];
        const CohesiveMaterial& material = materials_.all[materials_.number(e)];
        if (Cohesive::utilisation(material, stress, (1.0 / norm(side)) * side) >=
            scene_.insertion.threshold) {
          found[at(block)].push_back(e);
        }
      }
    }
  });
  std::vector<Index> edges;
  for (const auto& part : found) {
    for (const Index e : part) {
      for (const Index v : mesh.edges[at(e)].vertex) add_tied_edges_at(v, edges);
    }
  }
  // Elements that bear that much and have an end that is tied yet: the tip of a fracture to be.
  for (Index element = 0; element < state_.cohesive.count(); ++element) {
    const auto& n = state_.cohesive.nodes[at(element)];
    if (n[0] != n[2] && n[1] != n[3]) continue;
    // The end of a joint without cohesion stays tied until the rock there is near its strength.
    const CohesiveHistory& h = state_.cohesive.histories[at(state_.cohesive.history_of[at(element)])];
    const Edge& edge = mesh.edges[at(state_.cohesive.edge[at(element)])];
    const bool unbonded = state_.cohesive.status[at(element)] >= CohesiveStatus::broken &&
                          h.fracture_energy == 0.0 && edge.joint >= 0;
    if (unbonded || cohesive_->utilisation(state_, element) < scene_.insertion.threshold) continue;
    const auto& ends = edge.vertex;
    if (n[0] == n[2]) add_tied_edges_at(ends[0], edges);
    if (n[1] == n[3]) add_tied_edges_at(ends[1], edges);
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  insert(edges);
}

void Simulation::insert(const std::vector<Index>& edges, std::uint16_t material) {
  if (edges.empty()) return;
  std::vector<double> penalty;
  std::vector<std::uint16_t> numbers;
  penalty.reserve(edges.size());
  numbers.reserve(edges.size());
  for (const Index e : edges) {
    const Edge& edge = scene_.mesh->edges[at(e)];
    const double floor = 0.1 * std::min(scene_.rock_of(edge.triangle[0]).stiffness.c66,
                                        scene_.rock_of(edge.triangle[1]).stiffness.c66);
    numbers.push_back(material > 0 ? material : materials_.number(e));
    // Where a sliver leaves no room the step gives way instead.
    penalty.push_back(std::min(materials_.all[numbers.back()].penalty,
                               std::max(floor, penalty_below(state_, bulk_, e, stable_.limit))));
  }
  const Index nodes = state_.node_count();
  const Index first = state_.cohesive.count();
  std::vector<Fluid::CornerLoad> loads;
  const bool wet = fluid_ && std::ranges::any_of(edges, [&](Index e) {
                     return std::ranges::any_of(scene_.mesh->edges[at(e)].vertex, [&](Index v) {
                       return state_.fluid.cavity_of_vertex[at(v)] >= 0;
                     });
                   });
  if (wet) loads = fluid_->corner_loads(state_);
  const auto rock = [&](Index corner) { return bulk_.triangle_forces(state_, corner / 3)[at(corner % 3)]; };
  const auto load = [&](Index corner) {
    Vec2 sum;
    auto it = std::lower_bound(loads.begin(), loads.end(), corner,
                               [](const auto& l, Index value) { return l.corner < value; });
    for (; it != loads.end() && it->corner == corner; ++it) sum += it->force;
    return sum;
  };
  rough_insertions_ +=
      static_cast<Index>(cohesive_->insert(state_, edges, penalty, numbers, rock, load).size());
  if (tiles_) tiles_->inserted(state_, physics(), edges);
  if (state_.node_count() == nodes) return;
  if (wet) fluid_->rebuild(state_);
  for (Index i = first; i < state_.cohesive.count(); ++i) {
    for (const Index n : state_.cohesive.nodes[at(i)]) {
      slowed_ = std::min(slowed_, node_step(state_, bulk_, cohesive(), n) / stable_.limit);
    }
  }
}

}  // namespace crackle
