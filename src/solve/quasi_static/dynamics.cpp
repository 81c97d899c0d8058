// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "bore.hpp"
#include "record.hpp"

namespace crackle::quasi_static {
namespace {

constexpr double safety = 0.8;
constexpr double damping_ratio = 0.1;
// α at the boundary is this many times the speed of waves over the depth of what absorbs them: with its
// square growth a fifth of a wave comes back.
constexpr double absorption = 5.0;

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

bool holds(const JumpUnknown& unknown, Index triangle) {
  return std::ranges::binary_search(unknown.triangles, triangle);
}

Vec2 free_part(Vec2 v, std::uint8_t held) { return {held & 1 ? 0.0 : v.x, held & 2 ? 0.0 : v.y}; }

std::size_t corner_of(const std::array<Index, 3>& triangle, Index vertex) {
  return triangle[0] == vertex ? 0 : triangle[1] == vertex ? 1 : 2;
}

}  // namespace

Motion set_in_motion(const Equations& e, const State& state) {
  Motion motion;
  motion.place = corners_of(e, state);
  motion.velocity.resize(motion.place.size());
  motion.begin = state.time;
  motion.length = row_of(e, state).damaged_length;
  motion.radiated = state.energies.radiated;
  motion.fracture = state.energies.fracture;
  motion.friction = state.energies.friction;
  for (std::size_t c = 0; c < state.cells.size(); ++c) motion.faces.push_back(faces_of(e, state, c));
  return motion;
}

Dynamics::Dynamics(const Equations& e, const State& state)
    : e_(e), vertices_(static_cast<std::ptrdiff_t>(e.scene.mesh->vertices.size())) {
  const Mesh& mesh = *e_.scene.mesh;
  const auto nodes = static_cast<std::size_t>(vertices_);
  mass_.assign(nodes, 0.0);
  rows_.assign(nodes, 0.0);
  for (Index t = 0; t < mesh.triangle_count(); ++t) {
    const double area = e_.bulk.area(t);
    PlaneStiffness c = e_.bulk.stiffness(t);
    for (double* entry : {&c.c11, &c.c12, &c.c22, &c.c16, &c.c26, &c.c66}) *entry *= area;
    const auto rows = e_.bulk.stiffness_rows(t);
    const double highest = *std::ranges::max_element(rows) / (e_.bulk.density(t) * area / 3.0);
    elements_.push_back({e_.bulk.shape_gradients(t), c, 2.0 * damping_ratio / std::sqrt(highest)});
    for (std::size_t i = 0; i < 3; ++i) {
      const Index v = mesh.triangles[at(t)][i];
      node_of_corner_.push_back(v);
      mass_[at(v)] += e_.bulk.density(t) * area / 3.0;
      rows_[at(v)] += rows[i];
    }
  }
  place_.resize(nodes);
  velocity_.resize(nodes);
  held_ = e_.scene.held;
  set_absorption();
  take_path();
  for (std::size_t c = 0; c < node_of_corner_.size(); ++c) {
    place_[at(node_of_corner_[c])] = state.motion.place[c];
    velocity_[at(node_of_corner_[c])] = state.motion.velocity[c];
  }
  faces_.assign(state.jumps.size(), 0.0);
}

// Grows with the square of the way through the outer half of the domain, seen from where fractures start.
void Dynamics::set_absorption() {
  const Mesh& mesh = *e_.scene.mesh;
  const Vec2 centre = e_.bore > 0.0 ? Vec2{} : mesh.vertices[at(e_.scene.wings.front().start)];
  Vec2 reach;
  for (const Vec2 v : mesh.vertices)
    reach = {std::max(reach.x, std::abs(v.x - centre.x)), std::max(reach.y, std::abs(v.y - centre.y))};
  double speed = 0.0;
  for (Index t = 0; t < mesh.triangle_count(); ++t)
    speed = std::max(speed, std::sqrt(e_.bulk.stiffness(t).c11 / e_.bulk.density(t)));
  const double most = absorption * speed / (0.5 * std::min(reach.x, reach.y));
  for (const Vec2 v : mesh.vertices) {
    const double out = std::max(std::abs(v.x - centre.x) / reach.x, std::abs(v.y - centre.y) / reach.y);
    absorption_.push_back(most * std::pow(std::max(0.0, 2.0 * out - 1.0), 2));
  }
}

Index Dynamics::node_at(Index triangle, Index vertex) const {
  return node_of_corner_[3 * at(triangle) + corner_of(e_.scene.mesh->triangles[at(triangle)], vertex)];
}

// Gives every sector round a vertex a node of its own, which goes on as the one it comes from; the vertex's
// own node is that of the sector that no unknown holds.
void Dynamics::split(Index vertex) {
  std::vector<std::vector<Index>> sectors = e_.path.sectors(vertex);
  const auto held = [&](const std::vector<Index>& sector) {
    return std::ranges::count_if(e_.path.unknowns(), [&](const JumpUnknown& u) {
      return u.vertex == vertex && holds(u, sector.front());
    });
  };
  std::ranges::stable_sort(sectors, {}, held);
  std::vector<Index> nodes;
  for (const std::vector<Index>& sector : sectors) {
    Index node = node_at(sector.front(), vertex);
    if (std::ranges::find(nodes, node) != nodes.end()) {
      place_.push_back(place_[at(node)]);
      velocity_.push_back(velocity_[at(node)]);
      held_.push_back(held_[at(node)]);
      absorption_.push_back(absorption_[at(node)]);
      mass_.push_back(0.0);
      rows_.push_back(0.0);
      node = static_cast<Index>(place_.size()) - 1;
    }
    nodes.push_back(node);
    mass_[at(node)] = rows_[at(node)] = 0.0;
    for (const Index t : sector) {
      const std::size_t i = corner_of(e_.scene.mesh->triangles[at(t)], vertex);
      node_of_corner_[3 * at(t) + i] = node;
      mass_[at(node)] += e_.bulk.density(t) * e_.bulk.area(t) / 3.0;
      rows_[at(node)] += e_.bulk.stiffness_rows(t)[i];
    }
  }
}

// An unknown is what a sector moves beside another one that the same other unknowns hold.
void Dynamics::set_pairs(Index vertex) {
  const std::vector<JumpUnknown>& unknowns = e_.path.unknowns();
  Block block;
  for (std::size_t k = 0; k < unknowns.size(); ++k) {
    if (unknowns[k].vertex == vertex) block.unknowns.push_back(static_cast<Index>(k));
  }
  if (block.unknowns.empty()) return;
  const std::vector<std::vector<Index>> sectors = e_.path.sectors(vertex);
  const auto same_but = [&](Index k, Index a, Index b) {
    return std::ranges::all_of(block.unknowns, [&](Index other) {
      const bool of_k = unknowns[at(other)].triangles == unknowns[at(k)].triangles;
      return of_k || holds(unknowns[at(other)], a) == holds(unknowns[at(other)], b);
    });
  };
  for (const Index k : block.unknowns) {
    for (const auto& plus : sectors) {
      for (const auto& minus : sectors) {
        if (!holds(unknowns[at(k)], plus.front()) || holds(unknowns[at(k)], minus.front()) ||
            !same_but(k, plus.front(), minus.front()))
          continue;
        pairs_[at(k)] = {node_at(plus.front(), vertex), node_at(minus.front(), vertex)};
      }
    }
  }
  set_block(block);
  const auto same = std::ranges::find_if(
      blocks_, [&](const Block& b) { return unknowns[at(b.unknowns.front())].vertex == vertex; });
  if (same != blocks_.end()) {
    *same = std::move(block);
  } else {
    blocks_.push_back(std::move(block));
  }
}

// The inverse of L M⁻¹ Lᵀ.
void Dynamics::set_block(Block& block) const {
  const auto n = static_cast<Eigen::Index>(block.unknowns.size());
  Eigen::MatrixXd mobility(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < n; ++j) {
      const Index a = block.unknowns[static_cast<std::size_t>(i)],
                  b = block.unknowns[static_cast<std::size_t>(j)];
      double sum = 0.0;
      for (const auto& [node, sign] : {std::pair{pairs_[at(a)].plus, 1.0}, {pairs_[at(a)].minus, -1.0}}) {
        const double other = node == pairs_[at(b)].plus ? 1.0 : node == pairs_[at(b)].minus ? -1.0 : 0.0;
        sum += sign * other / mass_[at(node)] *
               dot(free_part(e_.path.unknowns()[at(a)].direction, held_[at(node)]),
                   e_.path.unknowns()[at(b)].direction);
      }
      mobility(i, j) = sum;
    }
  }
  const Eigen::MatrixXd inverse = mobility.inverse();
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < n; ++j) block.inertia.push_back(inverse(i, j));
  }
}

void Dynamics::take_path() {
  pairs_.resize(e_.path.unknowns().size());
  std::vector<Index> touched;
  for (; edges_ < e_.path.edges().size(); ++edges_) {
    const auto& ends = e_.path.edges()[edges_].vertex;
    touched.insert(touched.end(), ends.begin(), ends.end());
  }
  std::ranges::sort(touched);
  touched.erase(std::unique(touched.begin(), touched.end()), touched.end());
  for (const Index v : touched) split(v);
  for (const Index v : touched) set_pairs(v);
  bound_step();
}

void Dynamics::bound_step() {
  double highest = 0.0;
  for (std::size_t n = 0; n < mass_.size(); ++n) highest = std::max(highest, rows_[n] / mass_[n]);
  stable_step_ =
      safety * 2.0 / std::sqrt(highest) * (std::sqrt(1.0 + damping_ratio * damping_ratio) - damping_ratio);
}

void Dynamics::follow_path(const State& state) {
  take_path();
  predict(state, dt_);
}

void Dynamics::set_faces(const std::vector<double>& forces, std::size_t first) {
  faces_.resize(forces.size());
  std::copy(forces.begin() + static_cast<std::ptrdiff_t>(first), forces.end(),
            faces_.begin() + static_cast<std::ptrdiff_t>(first));
}

void Dynamics::find_forces(const State& state) {
  force_.assign(place_.size(), {});
  damping_.assign(place_.size(), {});
  strain_ = 0.0;
  const auto strain_of = [](const Element& element, const std::array<Vec2, 3>& u) {
    Sym2 strain;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec2 g = element.gradient[i];
      strain.xx += u[i].x * g.x;
      strain.yy += u[i].y * g.y;
      strain.xy += 0.5 * (u[i].x * g.y + u[i].y * g.x);
    }
    return strain;
  };
  for (std::size_t t = 0; t < elements_.size(); ++t) {
    const Element& element = elements_[t];
    const Index* node = &node_of_corner_[3 * t];
    const std::size_t a = at(node[0]), b = at(node[1]), c = at(node[2]);
    const Sym2 strain = strain_of(element, {place_[a], place_[b], place_[c]});
    const Sym2 stress = element.stiffness.stress(strain);
    const Sym2 damped = element.beta * element.stiffness.stress(
                                           strain_of(element, {velocity_[a], velocity_[b], velocity_[c]}));
    strain_ += 0.5 * (stress.xx * strain.xx + stress.yy * strain.yy + 2.0 * stress.xy * strain.xy);
    for (std::size_t i = 0; i < 3; ++i) {
      force_[at(node[i])] -= stress * element.gradient[i];
      damping_[at(node[i])] -= damped * element.gradient[i];
    }
  }
  for (std::size_t n = 0; n < place_.size(); ++n) damping_[n] -= absorption_[n] * mass_[n] * velocity_[n];
  if (e_.bore == 0.0) return;
  const std::array<double, 2> loads = wall_loads(e_, state);
  for (std::size_t l = 0; l < loads.size(); ++l) {
    for (const PointLoad& corner : e_.rock.load(l))
      force_[at(node_at(corner.triangle, corner.vertex))] += loads[l] * corner.force;
  }
}

void Dynamics::predict(const State& state, double dt) {
  dt_ = dt;
  find_forces(state);
  predicted_.resize(place_.size());
  for (std::size_t n = 0; n < place_.size(); ++n)
    predicted_[n] = free_part(velocity_[n] + dt / mass_[n] * (force_[n] + damping_[n]), held_[n]);
  if (!e_.scene.slip) tie_faces();
  target_.resize(pairs_.size());
  for (std::size_t k = 0; k < pairs_.size(); ++k) {
    const std::size_t a = at(pairs_[k].minus), b = at(pairs_[k].plus);
    target_[k] =
        dot(place_[b] - place_[a] + dt * (predicted_[b] - predicted_[a]), e_.path.unknowns()[k].direction);
  }
  set_bore();
}

// Faces that do not slip move together along the path.
void Dynamics::tie_faces() {
  for (std::size_t k = 0; k < pairs_.size(); ++k) {
    const std::size_t a = at(pairs_[k].minus), b = at(pairs_[k].plus);
    const Vec2 d = e_.path.unknowns()[k].direction, along{-d.y, d.x};
    const double off = dot(predicted_[b] - predicted_[a], along) / (mass_[a] + mass_[b]);
    predicted_[b] -= off * mass_[a] * along;
    predicted_[a] += off * mass_[b] * along;
  }
}

void Dynamics::set_bore() {
  bore_by_jump_.assign(pairs_.size(), 0.0);
  if (e_.bore == 0.0) return;
  bore_target_ = e_.bore;
  std::vector<Vec2> wall(pairs_.empty() ? 0 : place_.size());
  for (const PointLoad& corner : e_.rock.load(pressed)) {
    const std::size_t n = at(node_at(corner.triangle, corner.vertex));
    bore_target_ += dot(corner.force, place_[n] + dt_ * predicted_[n]);
    if (!wall.empty()) wall[n] += corner.force;
  }
  for (const Block& block : blocks_) {
    const std::size_t n = block.unknowns.size();
    for (std::size_t k = 0; k < n; ++k) {
      const Pair& pair = pairs_[at(block.unknowns[k])];
      const Vec2 d = e_.path.unknowns()[at(block.unknowns[k])].direction;
      const double moved =
          dot(wall[at(pair.plus)], free_part(d, held_[at(pair.plus)])) / mass_[at(pair.plus)] -
          dot(wall[at(pair.minus)], free_part(d, held_[at(pair.minus)])) / mass_[at(pair.minus)];
      if (moved == 0.0) continue;
      for (std::size_t l = 0; l < n; ++l)
        bore_by_jump_[at(block.unknowns[l])] += moved * block.inertia[k * n + l];
    }
  }
}

double Dynamics::bore_volume(const std::vector<double>& jumps) const {
  double v = bore_target_;
  for (std::size_t k = 0; k < jumps.size(); ++k) v += bore_by_jump_[k] * (jumps[k] - target_[k]);
  return v;
}

double Dynamics::inertia(const Block& block, std::size_t k, const std::vector<double>& jumps,
                         const std::vector<double>& target, double dt) {
  const std::size_t n = block.unknowns.size();
  double force = 0.0;
  for (std::size_t l = 0; l < n; ++l) {
    const std::size_t j = at(block.unknowns[l]);
    force += block.inertia[k * n + l] * (jumps[j] - target[j]);
  }
  return force / (dt * dt);
}

void Dynamics::move(const State& state) {
  before_ = velocity_;
  velocity_ = predicted_;
  std::vector<double> faces(pairs_.size(), 0.0);
  for (const Block& block : blocks_) {
    for (std::size_t k = 0; k < block.unknowns.size(); ++k) {
      const std::size_t j = at(block.unknowns[k]);
      faces[j] = inertia(block, k, state.jumps, target_, dt_);
      const Vec2 push = dt_ * faces[j] * e_.path.unknowns()[j].direction;
      const std::size_t a = at(pairs_[j].minus), b = at(pairs_[j].plus);
      velocity_[b] += free_part(1.0 / mass_[b] * push, held_[b]);
      velocity_[a] -= free_part(1.0 / mass_[a] * push, held_[a]);
    }
  }
  // What central differences with velocities between the steps do not give back:
  double lost = 0.0;
  for (std::size_t n = 0; n < place_.size(); ++n) {
    place_[n] += dt_ * velocity_[n];
    lost -= 0.5 * dot(damping_[n], velocity_[n] + before_[n]);
  }
  for (std::size_t k = 0; k < pairs_.size(); ++k) {
    const std::size_t a = at(pairs_[k].minus), b = at(pairs_[k].plus);
    lost -= 0.5 * (faces[k] - faces_[k]) *
            dot(velocity_[b] + before_[b] - velocity_[a] - before_[a], e_.path.unknowns()[k].direction);
  }
  damped_ += dt_ * lost;
  faces_ = std::move(faces);
}

double Dynamics::kinetic_energy() const {
  double twice = 0.0;
  for (std::size_t n = 0; n < place_.size(); ++n)
    twice += dot(velocity_[n], mass_[n] * velocity_[n] + dt_ * force_[n]);
  for (std::size_t k = 0; k < pairs_.size(); ++k) {
    twice +=
        dt_ * faces_[k] *
        dot(velocity_[at(pairs_[k].plus)] - velocity_[at(pairs_[k].minus)], e_.path.unknowns()[k].direction);
  }
  return 0.5 * twice;
}

double Dynamics::work(std::size_t load) const {
  double sum = 0.0;
  for (const PointLoad& corner : e_.rock.load(load))
    sum += dot(corner.force, place_[at(node_at(corner.triangle, corner.vertex))]);
  return sum;
}

void Dynamics::give_back(State& state) const {
  Motion& motion = state.motion;
  motion.place.clear();
  motion.velocity.clear();
  for (const Index n : node_of_corner_) {
    motion.place.push_back(place_[at(n)]);
    motion.velocity.push_back(velocity_[at(n)]);
  }
  motion.damped += damped_;
  motion.kinetic = kinetic_energy();
}

}  // namespace crackle::quasi_static
