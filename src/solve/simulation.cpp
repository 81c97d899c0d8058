// SPDX-License-Identifier: GPL-3.0-or-later
#include "crackle/solve/simulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <span>

#include "crackle/core/errors.hpp"
#include "crackle/core/parallel.hpp"
#include "crackle/seismic/listener.hpp"
#include "crackle/solve/equilibrium.hpp"
#include "sparse_solver.hpp"

namespace crackle {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

// Forces that the three cohesive elements round a triangle put on its corners; on face a they are
// the element's end forces, on face b the opposite at exchanged ends.
inline void add_element_forces(const Index* element_on_side, const EndForces* force, Vec2* corner) {
  for (int i = 0; i < 3; ++i) {
    const Index code = element_on_side[i];
    if (code < 0) continue;
    const EndForces& f = force[code >> 1];
    const bool b = code & 1;
    const double sign = b ? -1.0 : 1.0;
    const Vec2 here = b ? f.end1 : f.end0;
    const Vec2 next = b ? f.end0 : f.end1;
    Vec2& c0 = corner[i];
    Vec2& c1 = corner[i == 2 ? 0 : i + 1];
    c0.x += sign * here.x;
    c0.y += sign * here.y;
    c1.x += sign * next.x;
    c1.y += sign * next.y;
  }
}

// Wall of the wellbore and pre-cut cracks: where the fluid is at the start.
std::vector<Index> wetted_edges(const Scene& scene) {
  std::vector<Index> edges;
  for (Index e = 0; e < scene.mesh->edge_count(); ++e) {
    if (scene.mesh->edges[at(e)].kind == EdgeKind::wellbore) edges.push_back(e);
  }
  std::ranges::copy_if(scene.cracks, std::back_inserter(edges),
                       [&](Index e) { return !std::ranges::binary_search(scene.dry_cracks, e); });
  return edges;
}

// Loads of the fluid's pressure on the walls of a tied state, which `wet` holds the fluid of.
AddLoads wall_loads(State& wet, std::optional<Fluid>& fluid) {
  return [&](const State& tied, std::span<Vec2> forces) {
    if (!fluid) return;
    wet.displacement = tied.displacement;
    fluid->add_corner_forces(wet, forces);
  };
}

}  // namespace

double Simulation::longest_joint_edge(const Mesh& mesh) {
  double longest = 0.0;
  for (const Edge& edge : mesh.edges) {
    if (edge.joint < 0) continue;
    longest = std::max(longest, norm(mesh.vertices[at(edge.vertex[1])] - mesh.vertices[at(edge.vertex[0])]));
  }
  return longest;
}

Simulation::Simulation(Scene scene)
    : scene_(std::move(scene)), materials_(edge_materials(scene_)), bulk_(bulk_of(scene_)) {
  // First, while there is little else in memory: the factorisation is the largest thing of all.
  const std::vector<Vec2> displacement = geostatic_displacement();
  const bool split = scene_.law && !scene_.insertion.on_demand;
  state_ = split ? make_split_state(scene_.mesh) : make_tied_state(scene_.mesh);
  for (std::size_t c = 0; c < state_.node_of_corner.size(); ++c) {
    state_.displacement[at(state_.node_of_corner[c])] =
        displacement[at(scene_.mesh->triangles[c / 3][c % 3])];
  }
  set_mass(state_, bulk_);
  if (bulk_.viscous()) state_.strain_rate.assign(scene_.mesh->triangles.size(), {});
  if (scene_.law) {
    cohesive_.emplace(scene_.law, materials_.all);
    if (split) {
      insert_all(state_);
      set_materials(state_, scene_, materials_);
      cut_cracks();
    }
  }
  if (scene_.contact.normal_penalty > 0.0) contact_.emplace(state_, scene_.contact);
  if (scene_.fluid) {
    fluid_.emplace(state_, *scene_.fluid, scene_.pump);
    if (scene_.joints_edge_by_edge) fluid_->enter_joints_as_they_open();
    fluid_->fill(state_, wetted_edges(scene_), scene_.initial_pressure);
  }
  if (scene_.free_boundary || !scene_.loads.empty()) {
    loads_.emplace(*scene_.mesh, scene_.loads);
    loads_->hold(state_, scene_.free_boundary);
  } else if (!scene_.absorbing_boundary) {
    fix_nodes(state_, EdgeKind::outer);
  }
  stable_ = stable_step(state_, bulk_, cohesive());
  if (!split && scene_.law) {
    stable_.limit *= scene_.insertion.step;
    prepare_insertion();
  }
  if (scene_.damage.law) {
    begin_damage();
    for (const CutTriangle& cut : scene_.damage.cut) {
      damage_->cut(state_, bulk_, cut.triangle, cut.normal);
      bulk_.drop_viscosity(cut.triangle);
    }
    if (fluid_) {
      std::vector<Index> cut(scene_.damage.cut.size());
      std::iota(cut.begin(), cut.end(), 0);
      fluid_->connect_triangles(state_, cut);
      fluid_->refill(state_, scene_.initial_pressure);
    }
  }
  settle();
}

Simulation::Simulation(Scene scene, State state, SimulationMemory memory)
    : scene_(std::move(scene)),
      materials_(edge_materials(scene_)),
      state_(std::move(state)),
      bulk_(bulk_of(scene_)),
      stable_(memory.stable),
      stressed_(std::move(memory.stressed)),
      slowed_(memory.slowed),
      rough_insertions_(memory.rough_insertions),
      reference_(memory.reference),
      scale_(memory.scale),
      geostatic_slips_(memory.geostatic_slips) {
  const Index triangles = scene_.mesh->triangle_count();
  block_stressed_.assign(at(block_count(triangles)), 0);
  for (Index t = 0; t < triangles && !stressed_.empty(); ++t) {
    if (stressed_[at(t)]) block_stressed_[at(t / block_size)] = 1;
  }
  if (!stressed_.empty()) set_screen();
  if (scene_.damage.law) begin_damage();
  if (scene_.law) cohesive_.emplace(scene_.law, materials_.all);
  if (scene_.contact.normal_penalty > 0.0) {
    contact_.emplace(state_, scene_.contact);
    contact_->rebuild(state_);
  }
  if (scene_.fluid) {
    fluid_.emplace(state_, *scene_.fluid, scene_.pump);
    if (scene_.joints_edge_by_edge) fluid_->enter_joints_as_they_open();
    if (scene_.flow) fluid_->flow(state_, {*scene_.flow, sparse_solver()});
  }
  if (scene_.absorbing_boundary) boundary_.emplace(std::move(memory.boundary));
  if (scene_.free_boundary || !scene_.loads.empty()) {
    loads_.emplace(*scene_.mesh, scene_.loads);
    loads_->restore(std::move(memory.loads));
  }
  tiles_.emplace(state_, physics());
}

Sym2 Simulation::stress(Index triangle) const {
  const auto& numbers = state_.damage.of_triangle;
  const Index d = numbers.empty() ? -1 : numbers[at(triangle)];
  return d < 0 ? bulk_.stress(state_, triangle) : state_.damage.triangles[at(d)].stress;
}

SimulationMemory Simulation::memory() const {
  return {reference_,
          scale_,
          stable_,
          geostatic_slips_,
          slowed_,
          rough_insertions_,
          stressed_,
          boundary_ ? boundary_->nodes() : std::vector<BoundaryNode>{},
          loads_ ? loads_->memory() : LoadsMemory{}};
}

// Displacement of every vertex by the excavation and the initial pressure, the rock still whole and
// its outer boundary fixed.
std::vector<Vec2> Simulation::geostatic_displacement() {
  std::vector<char> fixed(scene_.mesh->vertices.size(), 0);
  bool any = false;
  for (const Edge& edge : scene_.mesh->edges) {
    if (edge.kind == EdgeKind::outer) fixed[at(edge.vertex[0])] = fixed[at(edge.vertex[1])] = 1, any = true;
  }
  if (!any) return std::vector<Vec2>(scene_.mesh->vertices.size());
  std::optional<Fluid> fluid;
  State wet = make_tied_state(scene_.mesh);
  if (scene_.fluid) {
    fluid.emplace(wet, *scene_.fluid, Pump{});
    fluid->fill(wet, wetted_edges(scene_), scene_.initial_pressure);
  }
  const StaticSolver solver(scene_.mesh, bulk_, fixed);
  std::vector<Vec2> displacement = solver.displacement(wall_loads(wet, fluid));
  const bool whole = (scene_.law && scene_.insertion.on_demand) || scene_.damage.law;
  if (fluid && scene_.fast_forward && whole && scene_.damage.cut.empty() && scene_.cracks.empty() &&
      scene_.joints.empty() && !scene_.absorbing_boundary && !scene_.free_boundary && scene_.loads.empty()) {
    find_ramp(solver, wet, fluid, displacement);
  }
  return displacement;
}

void Simulation::find_ramp(const StaticSolver& solver, State& wet, std::optional<Fluid>& fluid,
                           const std::vector<Vec2>& first) {
  const auto point = [&](double pressure, std::vector<Vec2> displacement) {
    wet.displacement = displacement;
    fluid->rebuild(wet);
    return Ramp::Point{pressure, fluid->volume(0), std::move(displacement)};
  };
  const auto equilibrium = [&](double pressure, const std::vector<Vec2>& start) {
    wet.fluid.cavities[0].pressure = pressure;
    return solver.displacement(wall_loads(wet, fluid), start);
  };
  const double p0 = scene_.initial_pressure;
  const double p1 = p0 + scene_.cohesive.tensile_strength;
  const Ramp::Point at_rest = point(p0, first);
  const Ramp::Point second = point(p1, equilibrium(p1, first));
  const std::optional<double> onset = onset_pressure(
      wet, bulk_, [&](Index e) -> const CohesiveMaterial& { return materials_.all[materials_.number(e)]; },
      scene_.insertion.threshold, at_rest, second);
  if (!onset || *onset <= p0) return;
  Ramp ramp(at_rest, point(*onset, equilibrium(*onset, second.displacement)), *scene_.fluid);
  // When has the pump injected that much?
  double low = 0.0, high = 1e-6;
  for (int i = 0; i < 100 && scene_.pump.volume(0.0, high) < ramp.capacity(); ++i) high *= 2.0;
  if (scene_.pump.volume(0.0, high) < ramp.capacity()) return;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (scene_.pump.volume(0.0, middle) < ramp.capacity() ? low : high) = middle;
  }
  double round = 0.0;
  for (const Edge& edge : scene_.mesh->edges) {
    if (edge.kind == EdgeKind::wellbore)
      round += norm(scene_.mesh->vertices[at(edge.vertex[1])] - scene_.mesh->vertices[at(edge.vertex[0])]);
  }
  if (low < 2.0 * round / slowest_shear_wave(scene_)) return;
  ramp_ = std::move(ramp);
  ramp_end_ = low;
}

Energies Simulation::ramp_to(double time) {
  // Work of the pump: enthalpy of what it has injected since the last call, in small parts.
  constexpr int parts = 16;
  Cavity& well = state_.fluid.cavities.front();
  double before = well.pressure;
  for (int i = 1; i <= parts; ++i) {
    const double injected = scene_.pump.volume(0.0, state_.time + (time - state_.time) * i / parts);
    const double pressure = ramp_->pressure(injected);
    const double mass = (injected - well.injected) * scene_.fluid->density;
    well.work += mass * 0.5 * (scene_.fluid->enthalpy(before) + scene_.fluid->enthalpy(pressure));
    well.mass += mass;
    well.injected = injected;
    before = pressure;
  }
  const double rate = ramp_->pressure_rate(before, scene_.pump.rate(time));
  for (Index v = 0; v < state_.node_count(); ++v) {
    state_.displacement[at(v)] = ramp_->displacement(v, before);
    state_.velocity[at(v)] = rate * ramp_->compliance(v);
  }
  fluid_->rebuild(state_);
  well.volume = fluid_->volume(0);
  well.pressure = scene_.fluid->pressure(well.mass, well.volume);
  if (!state_.fluid.cells.empty()) state_.fluid.cells.front() = {-1, well.mass, well.pressure, well.volume};
  state_.time = time;
  // The rock is in motion from the first instant: the pump's start gave it that.
  const double kinetic = kinetic_energy(state_.velocity);
  if (time == 0.0) well.work = kinetic;
  Energies e = potential_energies();
  e.kinetic = kinetic;
  return with_residual(e);
}

void Simulation::settle() {
  const Mesh& mesh = *scene_.mesh;
  // Forces at the corners now, rock and fluid: the cohesive elements are set to bear them.
  std::vector<Vec2> forces(3 * mesh.triangles.size());
  for_each_block(mesh.triangle_count(), [&](Index begin, Index end, Index) {
    bulk_.corner_forces(state_, begin, end, forces.data() + 3 * begin);
  });
  if (fluid_) fluid_->add_corner_forces(state_, forces);
  if (cohesive_) {
    const std::vector<double> mobility = state_.inverse_mass;
    fix_nodes(state_, EdgeKind::outer);  // the boundary bears what is left there, be it fixed or absorbing
    if (!scene_.insertion.on_demand) {
      geostatic_slips_ += static_cast<Index>(cohesive_->balance(state_, forces).size());
    }
    unbond_joints();
    state_.inverse_mass = mobility;
    cohesive_->add_tractions(state_);
    wet_joints();
  }
  if (scene_.absorbing_boundary || loads_) bear_geostatic_loads(std::move(forces));
  tiles_.emplace(state_, physics());
  if (geostatic_slips_ > 0 || !scene_.cracks.empty() || !scene_.damage.cut.empty()) relax();
  if (fluid_ && scene_.flow) fluid_->flow(state_, {*scene_.flow, sparse_solver()});
  state_.dissipation = {};
  // The residual is not measured against less energy than strains of 3e-7 everywhere hold: while the
  // first wave leaves the wellbore everything is smaller than one step of the pump.
  scale_ = 0.0;
  for (Index t = 0; t < mesh.triangle_count(); ++t)
    scale_ += 1e-13 * scene_.rock_of(t).stiffness.largest() * bulk_.area(t);
  reference_ = {};
  reference_.strain = bulk_.strain_energy(state_);
  if (damage_) reference_.strain += damage_->stored_energy_correction(state_, bulk_);
  if (cohesive_) reference_.cohesive = cohesive_->stored_energy(state_);
  if (fluid_) reference_.fluid = fluid_->energy(state_);
}

// The outer boundary that moves bears as constant loads what held it until now.
void Simulation::bear_geostatic_loads(std::vector<Vec2> forces) {
  const Mesh& mesh = *scene_.mesh;
  for (Index t = 0; t < mesh.triangle_count(); ++t) {
    add_element_forces(&state_.element_on_side[at(3 * t)], state_.cohesive.force.data(), &forces[at(3 * t)]);
  }
  if (loads_) return loads_->bear(state_, forces);
  std::vector<char> outer(mesh.vertices.size(), 0);
  for (const Edge& edge : mesh.edges) {
    if (edge.kind == EdgeKind::outer) outer[at(edge.vertex[0])] = outer[at(edge.vertex[1])] = 1;
  }
  for (std::size_t c = 0; c < forces.size(); ++c) {
    forces[c] = outer[at(mesh.triangles[c / 3][c % 3])] ? -forces[c] : Vec2{};
  }
  const auto rock = [&](Index t) {
    return BulkMaterial{scene_.rock_of(t).stiffness, scene_.rock_of(t).density, {}};
  };
  boundary_.emplace(state_, rock, forces);
}

void Simulation::relax() {
  // Kinetic damping: whenever the kinetic energy has passed a peak, everything stops and starts again.
  // Well below the stable step: near it, stopping at every peak can lock into a short cycle.
  const double dt = 0.3 * stable_.limit;
  double before = 0.0, peak = 0.0;
  // Strains of 1e-11 everywhere: with less nothing moves, as where a crack is closed by the stress.
  double nothing = 0.0;
  for (Index t = 0; t < scene_.mesh->triangle_count(); ++t)
    nothing += 1e-22 * scene_.rock_of(t).stiffness.largest() * bulk_.area(t);
  const int most = 200000;
  const bool pressed = fluid_ && scene_.initial_pressure != 0.0 &&
                       scene_.cracks.size() + scene_.damage.cut.size() > scene_.dry_cracks.size();
  if (pressed) fluid_->hold(scene_.initial_pressure);  // a crack has no volume yet to hold fluid by its mass
  for (int i = 0; i < most; ++i) {
    state_.time = -2.0 * dt;  // before the pump starts
    advance(dt, nullptr);
    double kinetic = 0.0;
    for (std::size_t n = 0; n < state_.velocity.size(); ++n) {
      if (state_.inverse_mass[n] > 0.0)
        kinetic += 0.5 * dot(state_.velocity[n], state_.velocity[n]) / state_.inverse_mass[n];
    }
    peak = std::max(peak, kinetic);
    if (kinetic < before || kinetic == 0.0) {
      std::fill(state_.velocity.begin(), state_.velocity.end(), Vec2{});
      if (before <= std::max(1e-9 * peak, nothing)) {
        state_.time = 0.0;
        state_.step = 0;
        if (pressed) {
          fluid_->hold({});
          fluid_->refill(state_, scene_.initial_pressure);
        }
        return;
      }
      kinetic = 0.0;
    }
    before = kinetic;
  }
  throw NumericalError(
      fmt::format("the geostatic stage does not come to rest within {} relaxation steps: {} cohesive "
                  "elements were beyond their strength after the excavation; is the rock too weak for "
                  "this stress?",
                  most, geostatic_slips_));
}

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
  for (const CohesiveHistory& h : state_.cohesive.histories) {
    // The end of a joint without cohesion stays tied until the rock there is near its strength.
    const bool unbonded = state_.cohesive.status[at(h.element)] >= CohesiveStatus::broken &&
                          h.fracture_energy == 0.0 &&
                          mesh.edges[at(state_.cohesive.edge[at(h.element)])].joint >= 0;
    if (unbonded) continue;
    const auto& n = state_.cohesive.nodes[at(h.element)];
    if ((n[0] != n[2] && n[1] != n[3]) || cohesive_->utilisation(state_, h) < scene_.insertion.threshold)
      continue;
    const auto& ends = mesh.edges[at(state_.cohesive.edge[at(h.element)])].vertex;
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
  if (fluid_) loads = fluid_->corner_loads(state_);
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
  if (fluid_) fluid_->rebuild(state_);
  for (Index i = first; i < state_.cohesive.count(); ++i) {
    for (const Index n : state_.cohesive.nodes[at(i)]) {
      slowed_ = std::min(slowed_, node_step(state_, bulk_, cohesive(), n) / stable_.limit);
    }
  }
}

std::vector<LoadRecord> Simulation::take_loads() {
  return loads_ ? loads_->take(state_) : std::vector<LoadRecord>{};
}

double Simulation::stable_limit() const {
  const double contact = contact_ ? contact_->largest_frequency_squared(state_) : 0.0;
  if (contact == 0.0) return slowed_ * stable_.limit;
  const double alone = 2.0 / (slowed_ * stable_.limit);
  return 2.0 / std::sqrt(alone * alone + contact);
}

double Simulation::wellbore_pressure() const {
  return state_.fluid.cavities.empty() ? 0.0 : scene_.pore_pressure + state_.fluid.cavities.front().pressure;
}

void Simulation::move_nodes(double dt) {
  for (const double p : tiles_->move(state_, physics(), dt, screen_, stressed_, block_stressed_))
    state_.dissipation.viscous += dt * p;
}

void Simulation::heed_new_histories() {
  const auto& histories = state_.cohesive.histories;
  std::vector<Index> fresh;
  for (; histories_known_ < histories.size(); ++histories_known_)
    fresh.push_back(histories[histories_known_].element);
  if (!fresh.empty()) tiles_->elements_changed(state_, physics(), fresh);
}

void Simulation::listen_to_slips() {
  // Quiet for as long as a shear wave takes along three of the longest edges.
  const double quiet = 3.0 * longest_joint_edge_ / slowest_shear_wave(scene_);
  const SlipRule rule{scene_.slip_rate, 0.5 * scene_.slip_rate, quiet};
  const auto ended =
      track_slip(state_.slips, sliding_edges(state_), {state_.time, state_.time_step}, rule, medium());
  new_events_.insert(new_events_.end(), ended.begin(), ended.end());
}

void Simulation::advance(double dt, Energies* account) {
  stopwatch_.start();
  new_events_.clear();
  heed_new_histories();
  if (cohesive_) {
    cohesive_->advance_histories(state_);
    if (!damage_ && !stressed_.empty()) insert_stressed();
    stopwatch_.lap(Stopwatch::cohesive);
  }
  if (damage_) {
    damage_->update(state_, bulk_);
    crack_stressed();
    stopwatch_.lap(Stopwatch::cohesive);
    if (!damage_->newly_failed().empty()) {
      new_events_ = listen_to_damage(state_, damage_->newly_failed(), medium());
      stopwatch_.lap(Stopwatch::events);
      if (fluid_) fluid_->connect_triangles(state_, damage_->newly_failed());
      stopwatch_.lap(Stopwatch::fluid);
    }
  }
  if (contact_) {
    contact_->update(state_);
    stopwatch_.lap(Stopwatch::contact);
  }
  if (cohesive_ && !cohesive_->newly_broken().empty()) {
    const auto broke = listen(state_, cohesive_->newly_broken(), medium());
    new_events_.insert(new_events_.end(), broke.begin(), broke.end());
    stopwatch_.lap(Stopwatch::events);
    if (fluid_) fluid_->connect(state_, cohesive_->newly_broken());
    stopwatch_.lap(Stopwatch::fluid);
  }
  if (fluid_ && scene_.wets_damaged) {
    const std::vector<Index> damaged = fluid_->damaged_ahead(state_);
    if (!damaged.empty()) fluid_->connect(state_, damaged);
    stopwatch_.lap(Stopwatch::fluid);
  }
  if (fluid_ && scene_.joints_edge_by_edge) {
    const std::vector<Index> opened = fluid_->opened_joints(state_);
    if (!opened.empty()) fluid_->connect(state_, opened);
    stopwatch_.lap(Stopwatch::fluid);
  }
  if (longest_joint_edge_ > 0.0 && state_.time > 0.0) {  // what slid before was the geostatic stage
    listen_to_slips();
    stopwatch_.lap(Stopwatch::events);
  }
  if (account != nullptr) {
    *account = potential_energies();
    velocity_before_ = state_.velocity;
    stopwatch_.lap(Stopwatch::ledger);
  }
  if (boundary_) boundary_->begin(state_);
  if (loads_) loads_->begin(state_);
  move_nodes(dt);
  if (contact_) contact_->apply(state_, dt);
  double radiated = boundary_ ? boundary_->apply(state_, dt) : 0.0;
  if (loads_) radiated += loads_->apply(state_, dt);
  stopwatch_.lap(Stopwatch::rock);
  if (fluid_) {
    fluid_->advance(state_, dt);
    stopwatch_.lap(Stopwatch::fluid);
    if (fluid_->leaks()) {
      throw NumericalError(
          fmt::format("a fracture has reached the outer boundary at step {}, time {:.6g} s, and the "
                      "fluid would leave the model there: end the run earlier or make the domain larger",
                      state_.step, state_.time));
    }
  }
  if (account != nullptr) {
    // ½ Σ m v(n−½)·v(n+½): with the stored energies at n this is what the integrator conserves.
    account->kinetic = kinetic_energy(velocity_before_);
    account->viscous = state_.dissipation.viscous;
    account->external -= radiated;
    stopwatch_.lap(Stopwatch::ledger);
  }
  state_.time += dt;
  state_.time_step = dt;
  ++state_.step;
  if (cohesive_) cohesive_->start_histories(state_, tiles_->near(), dt);
}

double Simulation::kinetic_energy(const std::vector<Vec2>& before) const {
  return sum_over_blocks(state_.node_count(), [&](Index begin, Index end) {
    double sum = 0.0;
    for (Index n = begin; n < end; ++n) {
      if (state_.inverse_mass[at(n)] > 0.0) {
        sum += 0.5 * dot(before[at(n)], state_.velocity[at(n)]) / state_.inverse_mass[at(n)];
      }
    }
    return sum;
  });
}

Energies Simulation::potential_energies() const {
  Energies e;
  e.strain = bulk_.strain_energy(state_) - reference_.strain;
  if (damage_) e.strain += damage_->stored_energy_correction(state_, bulk_);
  if (cohesive_) e.cohesive = cohesive_->stored_energy(state_) - reference_.cohesive;
  if (contact_) e.cohesive += contact_->stored_energy(state_);
  if (fluid_) e.fluid = fluid_->energy(state_) - reference_.fluid;
  e.fracture = state_.dissipation.fracture;
  e.friction = state_.dissipation.friction;
  for (const Cavity& cavity : state_.fluid.cavities) e.external += cavity.work;
  e.external -= state_.dissipation.boundary;
  return e;
}

Energies Simulation::step_and_account(double dt) {
  Energies e;
  advance(dt, &e);
  return with_residual(e);
}

Energies Simulation::with_residual(Energies e) {
  const double stored = e.kinetic + e.strain + e.cohesive + e.fluid;
  const double spent = e.fracture + e.friction + e.viscous;
  scale_ = std::max({scale_, std::abs(e.external), std::abs(e.strain), std::abs(e.fluid), spent});
  e.residual = std::abs(stored + spent - e.external) / scale_;
  if (!std::isfinite(stored + spent)) stop_not_finite();
  return e;
}

void Simulation::stop_not_finite() const {
  const Mesh& mesh = *scene_.mesh;
  for (Index t = 0; t < mesh.triangle_count(); ++t) {
    for (Index i = 0; i < 3; ++i) {
      const std::size_t n = at(state_.node_of_corner[at(3 * t + i)]);
      const Vec2 u = state_.displacement[n], v = state_.velocity[n];
      if (std::isfinite(u.x) && std::isfinite(u.y) && std::isfinite(v.x) && std::isfinite(v.y)) continue;
      const Vec2 x = state_.reference(3 * t + i);
      throw NumericalError(
          fmt::format("motion is no longer finite in triangle {} at ({:.4g}, {:.4g}) m, step {}, time "
                      "{:.6g} s, step size {:.3g} s (stable: {:.3g} s): take a smaller run.safety",
                      t, x.x, x.y, state_.step, state_.time, state_.time_step, stable_.limit));
    }
  }
  throw NumericalError(
      fmt::format("energy is no longer finite at step {}, time {:.6g} s", state_.step, state_.time));
}

double Simulation::imbalance() {
  const Mesh& mesh = *scene_.mesh;
  std::vector<Vec2> forces(3 * mesh.triangles.size());
  for_each_block(mesh.triangle_count(), [&](Index begin, Index end, Index) {
    bulk_.corner_forces(state_, begin, end, forces.data() + 3 * begin);
  });
  double largest = 0.0;
  for (const Vec2 f : forces) largest = std::max(largest, norm(f));
  if (cohesive_) cohesive_->add_tractions(state_);
  if (fluid_) fluid_->add_corner_forces(state_, forces);
  std::vector<Vec2> sum(at(state_.node_count()));
  if (boundary_) boundary_->add_loads(sum);
  for (Index t = 0; t < mesh.triangle_count(); ++t) {
    add_element_forces(&state_.element_on_side[at(3 * t)], state_.cohesive.force.data(), &forces[at(3 * t)]);
    for (Index i = 0; i < 3; ++i) sum[at(state_.node_of_corner[at(3 * t + i)])] += forces[at(3 * t + i)];
  }
  if (loads_) loads_->balance(state_, sum);
  double unbalanced = 0.0;
  for (std::size_t n = 0; n < sum.size(); ++n) {
    if (state_.inverse_mass[n] > 0.0) unbalanced = std::max(unbalanced, norm(sum[n]));
  }
  return largest > 0.0 ? unbalanced / largest : 0.0;
}

}  // namespace crackle
