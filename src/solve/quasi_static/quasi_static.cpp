// SPDX-License-Identifier: GPL-3.0-or-later
#include "crackle/solve/quasi_static.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "crackle/core/errors.hpp"
#include "crackle/solve/estimates.hpp"
#include "ledger.hpp"
#include "newton.hpp"

namespace crackle {

namespace qs = quasi_static;

namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

constexpr Index of_joint = -2;  // parent of a cell

void check(const QuasiStaticScene& scene) {
  const auto require = [](bool holds, const char* what) {
    if (!holds) throw CaseError(std::string("quasi-static stage: ") + what);
  };
  require(!scene.wings.empty(), "no fracture to start from");
  for (const Wing& wing : scene.wings)
    require(wing.open >= 1 && wing.open < wing.path.size() + (wing.free ? 1 : 0),
            "a wing needs an open edge and one ahead of it");
  require(scene.slip || scene.joints.empty(), "joints slip: give slip");
  require(scene.tensile_strength > 0.0 && scene.fracture_energy > 0.0,
          "tensile strength and fracture energy have to be positive");
  require(
      scene.edges_per_zone >= 2.0,
      "a strength that the mesh does not resolve stops the fracture: edges_per_zone has to be 2 at least");
  require(scene.closure.residual_aperture > 0.0,
          "residual aperture has to be positive: a mated fracture without any would never let fluid in");
  require(scene.fluid.compressibility > 0.0, "the fluid needs a compressibility");
  require(scene.pore_pressure - scene.fluid.cavitation_pressure >= 1e6,
          "cavitation pressure has to be at least 1 MPa below the initial pressure");
}

}  // namespace

class QuasiStatic::Solver {
 public:
  explicit Solver(QuasiStaticScene scene)
      : scene_((check(scene), std::move(scene))),
        bulk_(*scene_.mesh, scene_.stiffness, 1.0, scene_.stress, {}),
        path_(scene_.mesh, scene_.held, scene_.slip),
        rock_(scene_.mesh, bulk_, scene_.held),
        equations_{scene_, path_, rock_, laws_, matrix_} {
    if (const auto* rock = std::get_if<MatrixRock>(&scene_.leak_off)) matrix_.emplace(*rock);
  }

  void begin() {
    state_.well_pressure = scene_.pore_pressure;
    state_.connected = !scene_.well.breakdown_pressure.has_value();
    for (const Index edge : scene_.joints) add_joint(edge);
    for (std::size_t w = 0; w < scene_.wings.size(); ++w) start(static_cast<Index>(w));
    settle();
    state_.step = scene_.control.first;
    qs::begin_ledger(equations_, state_);
  }

  void go_on(qs::State state) {
    for (const qs::Cell& cell : state.cells) join(cell.edge, cell.inner, cell.parent);
    rock_.follow(path_.unknowns());
    state_ = std::move(state);
  }

  QuasiStaticRow step(double end) {
    if (!(end > state_.time)) throw CaseError("quasi-static stage: a step has to end later than it starts");
    for (double dt = choose(end);; dt *= 0.5) {
      if (dt < scene_.control.smallest) stop(dt);
      const std::size_t edges = path_.edges().size();
      qs::State trial = state_;
      trial.well_before = state_.well_pressure;
      const double until = dt >= end - state_.time ? end : state_.time + dt;
      const double rate = scene_.pump.volume(state_.time, until) / dt;
      const int iterations = advance(trial, dt, rate);
      state_.iterations += spent_;
      if (iterations < 0) {
        path_.truncate(edges);
        laws_.erase(laws_.begin() + static_cast<std::ptrdiff_t>(edges), laws_.end());
        ++state_.rejected;
        continue;
      }
      return commit(std::move(trial), until, dt, rate, iterations);
    }
  }

  std::vector<FractureCell> cells() const {
    std::vector<FractureCell> list;
    for (std::size_t c = 0; c < state_.cells.size(); ++c) {
      const qs::Cell& cell = state_.cells[c];
      const PathEdge& edge = path_.edges()[c];
      const Index source = qs::pressure_source(equations_, state_, static_cast<Index>(c));
      FractureCell f;
      f.edge = edge.edge;
      f.length = edge.length;
      f.opening = qs::openings(edge, state_.jumps);
      for (std::size_t i = 0; i < 2; ++i) f.damage[i] = laws_[c].damage(cell.points[i].max_opening);
      f.wet = cell.wet;
      f.pressure = source < 0 ? scene_.pore_pressure : state_.cells[at(source)].pressure;
      f.leaked = cell.leaked;
      list.push_back(f);
    }
    return list;
  }

  const QuasiStaticScene& scene() const { return scene_; }
  const FracturePath& path() const { return path_; }
  const qs::State& state() const { return state_; }
  QuasiStaticRow row() const {
    QuasiStaticRow row;
    describe(row);
    return row;
  }
  double strength() const {
    double least = scene_.tensile_strength;
    for (const InterfaceLaw& law : laws_) least = std::min(least, law.strength());
    return least;
  }
  std::vector<Vec2> corner_displacement() const {
    const std::vector<Vec2> u = rock_.displacement(state_.jumps);
    std::vector<Vec2> corners;
    for (const auto& triangle : scene_.mesh->triangles) {
      for (const Index v : triangle) corners.push_back(u[at(v)]);
    }
    for (std::size_t k = 0; k < state_.jumps.size(); ++k) {
      const JumpUnknown& unknown = path_.unknowns()[k];
      for (const Index t : unknown.triangles) {
        for (std::size_t i = 0; i < 3; ++i) {
          if (scene_.mesh->triangles[at(t)][i] == unknown.vertex)
            corners[3 * at(t) + i] += state_.jumps[k] * unknown.direction;
        }
      }
    }
    return corners;
  }
  std::vector<Sym2> stress(const std::vector<Vec2>& corners) const {
    std::vector<Sym2> stress;
    for (Index t = 0; t < scene_.mesh->triangle_count(); ++t) {
      const auto g = bulk_.shape_gradients(t);
      Sym2 strain;
      for (std::size_t i = 0; i < 3; ++i) {
        const Vec2 u = corners[3 * at(t) + i];
        strain = strain + Sym2{u.x * g[i].x, u.y * g[i].y, 0.5 * (u.x * g[i].y + u.y * g[i].x)};
      }
      stress.push_back(scene_.stress + scene_.stiffness.stress(strain));
    }
    return stress;
  }

 private:
  // Makes a mesh edge part of the path.
  Index join(Index mesh_edge, Index inner, Index parent) {
    const bool joint = parent == of_joint;
    const Index c = path_.add(mesh_edge, inner, parent, joint ? mated_aperture(mesh_edge) : 0.0);
    laws_.emplace_back(
        scene_.law,
        resolved_strength(scene_.tensile_strength, plane_strain_modulus(scene_.stiffness),
                          scene_.fracture_energy, path_.edges()[at(c)].length, scene_.edges_per_zone),
        scene_.fracture_energy, scene_.closure,
        ShearLaw{scene_.shear.ratio, joint ? scene_.joint_friction : scene_.shear.friction});
    return c;
  }

  // In-situ tractions across an edge and along it [Pa].
  void set_in_situ(qs::Cell& cell, const PathEdge& edge) const {
    const Vec2 pull = scene_.stress * edge.normal;
    for (qs::Point& p : cell.points) {
      p.in_situ = dot(edge.normal, pull);
      if (scene_.slip) p.in_situ_shear = dot(Vec2{-edge.normal.y, edge.normal.x}, pull);
    }
  }

  double mated_aperture(Index mesh_edge) const {
    const auto& v = scene_.mesh->edges[at(mesh_edge)].vertex;
    const Vec2 along = scene_.mesh->vertices[at(v[1])] - scene_.mesh->vertices[at(v[0])];
    const Vec2 normal = (1.0 / norm(along)) * right_normal(along);
    return scene_.closure.opening(-dot(normal, scene_.stress * normal));
  }

  void add_joint(Index mesh_edge) {
    qs::Cell cell;
    cell.edge = mesh_edge;
    cell.inner = scene_.mesh->edges[at(mesh_edge)].vertex[0];
    cell.parent = of_joint;
    cell.wet = 1;
    cell.pressure = scene_.pore_pressure;
    const Index c = join(mesh_edge, cell.inner, of_joint);
    set_in_situ(cell, path_.edges()[at(c)]);
    for (qs::Point& p : cell.points)
      p.max_opening = std::max(laws_[at(c)].broken_opening(), scene_.closure.residual_aperture);
    append(state_, cell);
  }

  void append(qs::State& state, const qs::Cell& cell) const {
    if (matrix_) {
      state.matrix.resize(state.matrix.size() + matrix_->cells(),
                          std::get<MatrixRock>(scene_.leak_off).reservoir_pressure);
    }
    state.cells.push_back(cell);
    state.jumps.resize(path_.unknowns().size(), 0.0);
  }

  // Adds the next edge of a wing behind `parent`, intact and dry.
  Index extend(qs::State& state, Index wing, Index parent, std::size_t number) {
    const Wing& w = scene_.wings[at(wing)];
    qs::Cell cell;
    cell.inner = parent < 0 ? w.start : path_.edges()[at(parent)].vertex[1];
    cell.edge = number < w.path.size() ? w.path[number] : choose_edge(state, parent);
    cell.parent = parent;
    const Index c = join(cell.edge, cell.inner, parent);
    const PathEdge& edge = path_.edges()[at(c)];
    set_in_situ(cell, edge);
    cell.pressure = scene_.pore_pressure;
    append(state, cell);
    return c;
  }

  // The edge that a free wing takes next at the outer vertex of its last cell: of those that turn by less
  // than 100 degrees, the one along which it would open against the largest pull, by the mean stress round
  // the vertex.
  Index choose_edge(const qs::State& state, Index cell) {
    const PathEdge& from = path_.edges()[at(cell)];
    const Index tip = from.vertex[1];
    const auto place = [&](Index v) { return scene_.mesh->vertices[at(v)]; };
    const Vec2 ahead = (1.0 / from.length) * (place(tip) - place(from.vertex[0]));
    const Sym2 stress = mean_stress(state, tip);
    Index best = -1;
    double most = -std::numeric_limits<double>::infinity();
    for (const Index t : path_.fan(tip)) {
      for (const Index e : scene_.mesh->triangle_edges[at(t)]) {
        const Edge& edge = scene_.mesh->edges[at(e)];
        if ((edge.vertex[0] != tip && edge.vertex[1] != tip) || path_.holds(e) || edge.triangle[1] < 0)
          continue;
        const Vec2 along = place(edge.vertex[0] == tip ? edge.vertex[1] : edge.vertex[0]) - place(tip);
        if (dot(along, ahead) < -0.17 * norm(along)) continue;
        const Vec2 normal = (1.0 / norm(along)) * right_normal(along);
        const double pull = dot(normal, stress * normal);
        if (pull > most) {
          most = pull;
          best = e;
        }
      }
    }
    if (best < 0)
      throw NumericalError(
          fmt::format("quasi-static stage: at {:g} s the fracture has come to the boundary at "
                      "({:g}, {:g}); make the domain larger, or end the run earlier",
                      state.time, place(tip).x, place(tip).y));
    return best;
  }

  // Mean effective stress [Pa] of the triangles round a vertex, by area.
  Sym2 mean_stress(const qs::State& state, Index vertex) {
    rock_.follow(path_.unknowns());
    const std::vector<Vec2> u = rock_.displacement(state.jumps);
    Sym2 sum;
    double area = 0.0;
    for (const Index t : path_.fan(vertex)) {
      const auto g = bulk_.shape_gradients(t);
      Sym2 strain;
      for (std::size_t i = 0; i < 3; ++i) {
        const Index v = scene_.mesh->triangles[at(t)][i];
        Vec2 d = u[at(v)];
        for (std::size_t k = 0; k < state.jumps.size(); ++k) {
          const JumpUnknown& unknown = path_.unknowns()[k];
          if (unknown.vertex == v &&
              std::binary_search(unknown.triangles.begin(), unknown.triangles.end(), t))
            d += state.jumps[k] * unknown.direction;
        }
        strain = strain + Sym2{d.x * g[i].x, d.y * g[i].y, 0.5 * (d.x * g[i].y + d.y * g[i].x)};
      }
      sum = sum + bulk_.area(t) * (scene_.stress + scene_.stiffness.stress(strain));
      area += bulk_.area(t);
    }
    return (1.0 / area) * sum;
  }

  void start(Index wing) {
    const Wing& w = scene_.wings[at(wing)];
    Index parent = -1;
    for (std::size_t i = 0; i <= w.open; ++i) {
      const Index c = extend(state_, wing, parent, i);
      if (i == 0) state_.inlets.push_back({c, 0.0});
      if (i < w.open) {
        const double free = std::max(laws_[at(c)].broken_opening(), scene_.closure.residual_aperture);
        state_.cells[at(c)].wet = 1;
        state_.cells[at(c)].exposed = 0.0;
        state_.cells[at(c)].points[0].max_opening = free;
        if (i > 0) state_.cells[at(parent)].points[1].max_opening = free;
      }
      parent = c;
    }
    state_.tips.push_back({wing, parent});
  }

  // Mated faces under the in-situ stress at pore pressure.
  void settle() {
    rock_.follow(path_.unknowns());
    for (std::size_t c = 0; c < state_.cells.size(); ++c) {
      for (std::size_t i = 0; i < 2; ++i) {
        const qs::Point& p = state_.cells[c].points[i];
        if (p.max_opening == 0.0 || state_.cells[c].parent == of_joint) continue;
        for (const JumpTerm& t : path_.edges()[c].jump[i]) {
          state_.jumps[at(t.unknown)] = t.normal * scene_.closure.opening(-p.in_situ);
        }
      }
    }
    if (!qs::solve(equations_, state_, 0.0, 0.0).converged)
      throw NumericalError("quasi-static stage: no equilibrium of the initial fracture at pore pressure");
    for (std::size_t c = 0; c < state_.cells.size(); ++c) {
      if (state_.cells[c].wet) state_.cells[c].mass = mass(state_, c);
    }
    state_.initial_fracture = fracture_volume(state_);
    state_.initial_well = state_.well_pressure;
  }

  double mass(const qs::State& state, std::size_t c) const {
    const auto w = qs::openings(path_.edges()[c], state.jumps);
    return path_.edges()[c].length * 0.5 * (w[0] + w[1]) *
           scene_.fluid.density(state.cells[c].pressure).value;
  }
  static double fracture_volume(const qs::State& state) {
    double sum = 0.0;
    for (const qs::Cell& cell : state.cells) sum += cell.mass;
    return sum;
  }

  // Length of the next step: it lands on changes of the schedule and on breakdown.
  double choose(double end) {
    const double change = scene_.pump.next_change(state_.time);
    const TimeControl& control = scene_.control;
    double dt =
        std::min(state_.step, std::max(control.first, control.relative * (state_.time - state_.event)));
    if (!state_.connected) {
      const double rate = scene_.pump.rate(state_.time), breakdown = *scene_.well.breakdown_pressure;
      // a line, in rows enough to be drawn
      const double rise =
          std::min(breakdown - state_.well_pressure, 0.05 * (breakdown - scene_.pore_pressure));
      dt = rate > 0.0 ? std::max(rise * scene_.well.storage / rate, control.smallest)
                      : std::numeric_limits<double>::infinity();
    }
    const double stop = std::min(end, change);
    const double left = stop - state_.time;
    // Two equal steps rather than a full one and a sliver.
    return dt >= left ? left : std::min(dt, std::max(0.5 * left, 1e-3 * dt));
  }

  int advance(qs::State& trial, double dt, double rate) {
    int iterations = spent_ = 0;
    std::vector<int> grown(trial.tips.size(), 0);
    while (true) {
      rock_.follow(path_.unknowns());
      const qs::NewtonResult result = qs::solve(equations_, trial, dt, rate);
      iterations += result.iterations;
      spent_ = iterations;
      if (!result.converged) return -1;
      bool changed = wet(trial);
      for (std::size_t t = 0; t < trial.tips.size(); ++t) {
        if (!opens(trial, trial.tips[t])) continue;
        if (++grown[t] > scene_.control.edges_per_step) return -1;
        grow(trial, trial.tips[t]);
        changed = true;
      }
      if (!changed) return iterations;
    }
  }

  bool opens(const qs::State& state, const qs::Tip& tip) const {
    const double w = qs::openings(path_.edges()[at(tip.cell)], state.jumps)[0];
    return w > laws_[at(tip.cell)].elastic_opening();
  }

  void grow(qs::State& state, qs::Tip& tip) {
    const Wing& wing = scene_.wings[at(tip.wing)];
    const auto here = std::find(wing.path.begin(), wing.path.end(), path_.edges()[at(tip.cell)].edge);
    const auto next = std::min(static_cast<std::size_t>(here - wing.path.begin()) + 1, wing.path.size());
    if (next >= wing.path.size() && !wing.free) {
      throw NumericalError(
          fmt::format("quasi-static stage: at {:g} s the fracture has come to the end of its path; "
                      "make the path longer, or end the run earlier",
                      state.time));
    }
    const Index before = tip.cell;
    tip.cell = extend(state, tip.wing, before, next);
  }

  void fill(qs::State& state, Index cell) const {
    qs::Cell& c = state.cells[at(cell)];
    const Index parent = path_.edges()[at(cell)].parent;
    c.wet = 1;
    c.pressure = parent < 0 ? state.well_pressure : state.cells[at(parent)].pressure;
  }

  // Lets the fluid into damaged (or broken) edges next to it.
  bool wet(qs::State& state) const {
    bool changed = false;
    for (std::size_t c = 0; c < state.cells.size(); ++c) {
      const Index parent = path_.edges()[c].parent;
      if (state.cells[c].wet || parent < 0 || !state.cells[at(parent)].wet) continue;
      const auto w = qs::openings(path_.edges()[c], state.jumps);
      const bool enters = scene_.wetting == Wetting::broken
                              ? std::min(w[0], w[1]) >= laws_[c].broken_opening()
                              : w[0] > laws_[c].elastic_opening();
      if (!enters) continue;
      fill(state, static_cast<Index>(c));
      changed = true;
    }
    return changed;
  }

  QuasiStaticRow commit(qs::State trial, double until, double dt, double rate, int iterations) {
    QuasiStaticRow row;
    for (std::size_t c = 0; c < trial.cells.size(); ++c) {
      qs::Cell& cell = trial.cells[c];
      const auto w = qs::openings(path_.edges()[c], trial.jumps);
      if (cell.wet) {
        const double lost = qs::leak(equations_, trial, static_cast<Index>(c), cell.pressure, dt).value;
        cell.leaked += lost;
        trial.leaked += lost;
        cell.mass = mass(trial, c);
        if (matrix_ && trial.time >= cell.exposed) {
          const std::size_t n = matrix_->cells();
          matrix_->advance(std::span(trial.matrix).subspan(c * n, n), dt, cell.pressure);
        }
      }
      for (std::size_t i = 0; i < 2; ++i) {
        qs::Point& p = cell.points[i];
        if (scene_.slip) {
          p.plastic_slip = laws_[c]
                               .traction(w[i], qs::slips(path_.edges()[c], trial.jumps)[i], p.max_opening,
                                         p.plastic_slip, p.in_situ, p.in_situ_shear)
                               .plastic_slip;
        }
        p.max_opening = std::max(p.max_opening, w[i]);
      }
      const double damage =
          laws_[c].damage(cell.points[0].max_opening) + laws_[c].damage(cell.points[1].max_opening);
      if (cell.wet && damage >= 1.0) cell.exposed = std::min(cell.exposed, until);
    }
    trial.injected += rate * dt;
    if (trial.connected) {
      for (const qs::Inlet& inlet : trial.inlets) row.perforation_rate += inlet.rate;
    }
    const bool changes = until >= scene_.pump.next_change(state_.time);
    trial.time = until;
    trial.step = dt * scene_.control.growth;
    if (changes) trial.event = until;
    qs::account(equations_, state_, trial, dt, rate);
    if (!trial.connected && trial.well_pressure >= *scene_.well.breakdown_pressure * (1.0 - 1e-12)) {
      trial.connected = 1;
      trial.breakdown_time = trial.event = until;
    }
    if (trial.event == until) trial.step = scene_.control.first;
    trial.rejected = state_.rejected;
    trial.iterations = state_.iterations;
    state_ = std::move(trial);
    describe(row);
    row.step = dt;
    row.rate = rate;
    row.iterations = iterations;
    return row;
  }

  void describe(QuasiStaticRow& row) const {
    row.time = state_.time;
    row.well_pressure = state_.well_pressure;
    row.injected = state_.injected;
    row.well_stored = scene_.well.storage * (state_.well_pressure - state_.initial_well);
    row.fracture_volume = fracture_volume(state_);
    row.leaked = state_.leaked;
    row.energies = state_.energies;
    row.mass_defect =
        row.injected - row.well_stored - (row.fracture_volume - state_.initial_fracture) - row.leaked;
    row.least_pressure = std::numeric_limits<double>::infinity();
    double wet = 0.0, touching = 0.0;
    for (std::size_t c = 0; c < state_.cells.size(); ++c) {
      const qs::Cell& cell = state_.cells[c];
      const PathEdge& edge = path_.edges()[c];
      const auto w = qs::openings(edge, state_.jumps);
      for (std::size_t i = 0; i < 2; ++i) {
        const double half = 0.5 * edge.length, most = cell.points[i].max_opening;
        if (cell.parent == of_joint) continue;
        row.dissipated += half * laws_[c].dissipated(most);
        if (most >= laws_[c].broken_opening()) row.broken_length += half;
        if (most > laws_[c].elastic_opening()) row.damaged_length += half;
        if (cell.wet && w[i] < std::min(most, scene_.closure.residual_aperture)) touching += half;
      }
      if (!cell.wet || cell.parent == of_joint) continue;
      wet += edge.length;
      row.mean_opening += 0.5 * edge.length * (w[0] + w[1]);
      row.least_pressure = std::min(row.least_pressure, cell.pressure);
    }
    row.mean_opening /= wet;
    row.contact_fraction = touching / wet;
    for (const qs::Inlet& inlet : state_.inlets) {
      const auto n = static_cast<double>(state_.inlets.size());
      row.fracture_pressure += state_.cells[at(inlet.cell)].pressure / n;
      row.opening += qs::openings(path_.edges()[at(inlet.cell)], state_.jumps)[0] / n;
    }
  }

  [[noreturn]] void stop(double dt) const {
    throw NumericalError(
        fmt::format("quasi-static stage: no step converges at {:g} s (tried down to {:.1e} s, well pressure "
                    "{:.4g} MPa); the "
                    "fracture may be about to snap: give the well an impedance, or the fluid a viscosity",
                    state_.time, dt, state_.well_pressure * 1e-6));
  }

  QuasiStaticScene scene_;
  Bulk bulk_;
  FracturePath path_;
  Condensation rock_;
  std::vector<InterfaceLaw> laws_;
  std::optional<MatrixDiffusion> matrix_;
  qs::Equations equations_;
  qs::State state_;
  int spent_ = 0;  // iterations of the last attempt at a step
};

QuasiStatic::QuasiStatic(QuasiStaticScene scene) : solver_(std::make_unique<Solver>(std::move(scene))) {
  solver_->begin();
}
QuasiStatic::QuasiStatic(QuasiStaticScene scene, quasi_static::State state)
    : solver_(std::make_unique<Solver>(std::move(scene))) {
  solver_->go_on(std::move(state));
}
QuasiStatic::~QuasiStatic() = default;

const QuasiStaticScene& QuasiStatic::scene() const { return solver_->scene(); }
double QuasiStatic::time() const { return state().time; }
const quasi_static::State& QuasiStatic::state() const { return solver_->state(); }
QuasiStaticRow QuasiStatic::row() const { return solver_->row(); }
QuasiStaticRow QuasiStatic::step(double end) { return solver_->step(end); }
void QuasiStatic::run(double end, const std::function<void(const QuasiStaticRow&)>& record) {
  while (time() < end) {
    const QuasiStaticRow row = step(end);
    if (record) record(row);
  }
}
std::vector<FractureCell> QuasiStatic::cells() const { return solver_->cells(); }
const FracturePath& QuasiStatic::path() const { return solver_->path(); }
std::vector<Vec2> QuasiStatic::corner_displacement() const { return solver_->corner_displacement(); }
std::vector<Sym2> QuasiStatic::stress(const std::vector<Vec2>& corner_displacement) const {
  return solver_->stress(corner_displacement);
}
double QuasiStatic::strength() const { return solver_->strength(); }

}  // namespace crackle
