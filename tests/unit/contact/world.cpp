// SPDX-License-Identifier: GPL-3.0-or-later
#include "world.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "crackle/solve/time_step.hpp"

namespace crackle::test {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

}  // namespace

Mesh placed(Mesh mesh, double angle, Vec2 shift) {
  for (Vec2& x : mesh.vertices) {
    x = Vec2{std::cos(angle) * x.x - std::sin(angle) * x.y, std::sin(angle) * x.x + std::cos(angle) * x.y} +
        shift;
  }
  return mesh;
}

Mesh one_triangle(Vec2 a, Vec2 b, Vec2 c) {
  Mesh mesh;
  mesh.vertices = {a, b, c};
  mesh.triangles = {{0, 1, 2}};
  mesh.regions = {Region::rock};
  build_edges(mesh);
  return mesh;
}

Mesh together(const std::vector<Mesh>& bodies) {
  Mesh all;
  for (const Mesh& body : bodies) {
    const Index first = all.vertex_count();
    all.vertices.insert(all.vertices.end(), body.vertices.begin(), body.vertices.end());
    for (const auto& t : body.triangles) all.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  }
  all.regions.assign(all.triangles.size(), Region::rock);
  build_edges(all);
  return all;
}

World::World(const std::vector<Mesh>& bodies, const WorldMaterial& m)
    : state(make_tied_state(std::make_shared<const Mesh>(together(bodies)))),
      bulk_(*state.mesh, isotropic_plane_strain(m.young_modulus, m.poisson_ratio), m.density, {},
            {0.0, m.damping_ratio}),
      contact_(state, m.contact),
      corner_force_(3 * state.mesh->triangles.size()) {
  set_mass(state, m.density);
  if (bulk_.viscous()) state.strain_rate.resize(at(block_count(state.mesh->triangle_count())));
  for (const double inverse : state.inverse_mass) mass_.push_back(1.0 / inverse);
  Index node = 0;
  for (const Mesh& body : bodies) {
    first_.push_back(node);
    node += body.vertex_count();
  }
  first_.push_back(node);
  contact_.update(state);
  const double rock = stable_step(state, bulk_, nullptr).limit;
  dt = 0.8 * 2.0 / std::sqrt(4.0 / (rock * rock) + contact_.largest_frequency_squared(state));
}

void World::advance(WorldEnergy* energy) {
  contact_.update(state);
  if (energy != nullptr) {
    energy->strain = bulk_.strain_energy(state);
    energy->contact = contact_.stored_energy(state);
    for (Index n = 0; n < state.node_count(); ++n) {
      energy->height -= mass_[at(n)] * dot(gravity, state.displacement[at(n)]);
    }
  }
  before_ = state.velocity;
  state.dissipation.viscous +=
      dt * bulk_.corner_forces(state, 0, state.mesh->triangle_count(), corner_force_.data());
  for (std::size_t n = 0; n < mass_.size(); ++n) {
    Vec2 f;
    for (Index j = 0; j < state.node_size[n]; ++j)
      f += corner_force_[at(state.node_corners[at(state.node_first[n] + j)])];
    if (state.inverse_mass[n] == 0.0) continue;
    state.velocity[n] += dt * (state.inverse_mass[n] * f + gravity - mass_damping * before_[n]);
    state.displacement[n] += dt * state.velocity[n];
  }
  contact_.apply(state, dt);
  for (std::size_t n = 0; energy != nullptr && n < mass_.size(); ++n) {
    if (state.inverse_mass[n] > 0.0) energy->kinetic += 0.5 * mass_[n] * dot(before_[n], state.velocity[n]);
  }
  state.time += dt;
  state.time_step = dt;
  ++state.step;
}

void World::fix(std::size_t body) {
  for (Index n = first_[body]; n < first_[body + 1]; ++n) state.inverse_mass[at(n)] = 0.0;
}

double World::vertical_force(std::size_t body) {
  // Contact's kick on a copy in which the body can move.
  State copy = state;
  for (Index n = first_[body]; n < first_[body + 1]; ++n) copy.inverse_mass[at(n)] = 1.0 / mass_[at(n)];
  contact_.update(copy);
  copy.velocity.assign(copy.velocity.size(), {});
  contact_.apply(copy, 1.0);
  double sum = 0.0;
  for (Index n = first_[body]; n < first_[body + 1]; ++n) sum += mass_[at(n)] * copy.velocity[at(n)].y;
  return sum;
}

void World::throw_body(std::size_t body, Vec2 velocity) {
  for (Index n = first_[body]; n < first_[body + 1]; ++n) state.velocity[at(n)] = velocity;
}

Vec2 World::centre(std::size_t body) const {
  Vec2 sum;
  for (Index n = first_[body]; n < first_[body + 1]; ++n) {
    sum += mass_[at(n)] * (state.node_reference(n) + state.displacement[at(n)]);
  }
  return (1.0 / mass(body)) * sum;
}

Vec2 World::momentum(std::size_t body) const {
  Vec2 sum;
  for (Index n = first_[body]; n < first_[body + 1]; ++n) sum += mass_[at(n)] * state.velocity[at(n)];
  return sum;
}

double World::mass(std::size_t body) const {
  double sum = 0.0;
  for (Index n = first_[body]; n < first_[body + 1]; ++n) sum += mass_[at(n)];
  return sum;
}

void World::settle(double duration, double damping) {
  mass_damping = damping;
  for (const double end = state.time + duration; state.time < end;) step();
  mass_damping = 0.0;
}

}  // namespace crackle::test
