// SPDX-License-Identifier: GPL-3.0-or-later
#include "crackle/solid/damage.hpp"

#include <algorithm>
#include <cmath>

#include "crackle/core/parallel.hpp"

namespace crackle {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

Sym2 normal_strain(Vec2 n) { return {n.x * n.x, n.y * n.y, n.x * n.y}; }
Sym2 shear_strain(Vec2 n) {  // of unit engineering shear along s = (−n_y, n_x)
  return {-n.x * n.y, n.x * n.y, 0.5 * (n.x * n.x - n.y * n.y)};
}

double product(Sym2 s, Sym2 e) { return s.xx * e.xx + s.yy * e.yy + 2.0 * s.xy * e.xy; }

// F = R U of a triangle.
struct Stretch {
  double cos, sin;  // of R
  Sym2 u;           // U
};

Stretch stretch_of(const State& state, const std::array<Vec2, 3>& gradients, Index triangle) {
  double fxx = 1.0, fxy = 0.0, fyx = 0.0, fyy = 1.0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec2 u = state.displacement[at(state.node_of_corner[3 * at(triangle) + i])];
    fxx += u.x * gradients[i].x;
    fxy += u.x * gradients[i].y;
    fyx += u.y * gradients[i].x;
    fyy += u.y * gradients[i].y;
  }
  const double a = fxx + fyy, b = fyx - fxy, length = std::hypot(a, b);
  const double c = a / length, s = b / length;
  return {c, s, {c * fxx + s * fyx, -s * fxy + c * fyy, 0.5 * ((c * fxy + s * fyy) + (-s * fxx + c * fyx))}};
}

// Stiffness in the frame of a crack.
struct CrackFrame {
  const PlaneStiffness& c;
  Sym2 across, along;
  double nn, ns, ss;  // A = NᵀCN

  CrackFrame(const PlaneStiffness& stiffness, Vec2 normal)
      : c(stiffness), across(normal_strain(normal)), along(shear_strain(normal)) {
    const Sym2 cn = c.stress(across), cs = c.stress(along);
    nn = product(cn, across);
    ns = product(cn, along);
    ss = product(cs, along);
  }
};

// The crack at one strain: damage of both directions, slip of what is broken, and what follows from them.
struct Crack {
  double d_n = 0.0, d_s = 0.0, slip = 0.0;
  double e_n = 0.0, e_s = 0.0;
  double friction = 0.0;

  double opening() const { return d_n * std::max(e_n, 0.0); }
  double sliding() const { return d_s * slip; }

  // e and slip at a trial traction, damage fixed: the two directions in turn.
  void settle(const CrackFrame& a, double t_n, double t_s, double tan_residual, double slip_before) {
    const int turns = a.ns == 0.0 ? 1 : 30;
    for (int i = 0; i < turns; ++i) {
      e_n = (t_n - a.ns * sliding()) / a.nn;
      e_s = (t_s - a.ns * opening()) / a.ss;
      if (e_n > 0.0) {
        slip = e_s;
        friction = 0.0;
      } else {
        const double cap = tan_residual * -a.nn * e_n;
        friction = std::clamp(a.ss * (e_s - slip_before), -cap, cap);
        slip = e_s - friction / a.ss;
      }
    }
  }

  // Recoverable energy per area of triangle [J/m3].
  double energy(const CrackFrame& a, Sym2 strain, Sym2 in_situ) const {
    const Sym2 e = strain + -opening() * a.across + -sliding() * a.along;
    const double pull = std::max(e_n, 0.0);
    return product(0.5 * a.c.stress(e) + in_situ, e) + 0.5 * a.nn * d_n * (1.0 - d_n) * pull * pull +
           0.5 * a.ss * d_s * (1.0 - d_s) * slip * slip;
  }
};

Sym2 rate_of(const State& state, const std::array<Vec2, 3>& gradients, Index triangle) {
  Sym2 rate;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec2 v = state.velocity[at(state.node_of_corner[3 * at(triangle) + i])], g = gradients[i];
    rate = rate + Sym2{v.x * g.x, v.y * g.y, 0.5 * (v.x * g.y + v.y * g.x)};
  }
  return rate;
}

double kinetic_energy(const State& state, const Bulk& bulk, Index triangle) {
  double sum = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec2 v = state.velocity[at(state.node_of_corner[3 * at(triangle) + i])];
    sum += dot(v, v);
  }
  return bulk.density(triangle) * bulk.area(triangle) / 6.0 * sum;
}

// Forces of a stress in the frame that turns with the triangle: P = R (T + a W), W a quarter turn, with the
// a that keeps P Fᵀ symmetric where T and U have other axes.
void set_forces(DamagedTriangle& d, const Stretch& f, const std::array<Vec2, 3>& gradients, double area) {
  const Sym2 t = d.stress, u = f.u;
  const double a = -(t.xy * (u.xx - u.yy) - u.xy * (t.xx - t.yy)) / (u.xx + u.yy);
  const double xx = t.xx, xy = t.xy - a, yx = t.xy + a, yy = t.yy;
  const double pxx = f.cos * xx - f.sin * yx, pxy = f.cos * xy - f.sin * yy;
  const double pyx = f.sin * xx + f.cos * yx, pyy = f.sin * xy + f.cos * yy;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec2 g = gradients[i];
    d.force[i] = {-area * (pxx * g.x + pxy * g.y), -area * (pyx * g.x + pyy * g.y)};
  }
}

}  // namespace

void DamageMaterial::apply(DamagePreset preset) {
  const bool faithful = preset == DamagePreset::faithful;
  coupled = drop_all = !faithful;
  initiation = faithful ? Initiation::box : Initiation::mohr_coulomb;
  element_length = faithful ? ElementLength::chord : ElementLength::oliver;
}

std::array<double, 2> size_limits(const DamageMaterial& rock, const SofteningLaw& law,
                                  const PlaneStiffness& stiffness, Vec2 normal) {
  const DamageMaterial m = on_plane(rock, normal);
  const CrackFrame a(stiffness, normal);
  const double factor = law.size_factor();
  return {factor * m.fracture_energy_mode1 * a.nn / (m.tensile_strength * m.tensile_strength),
          factor * m.fracture_energy_mode2 * a.ss / (m.cohesion * m.cohesion)};
}

namespace {

StressScreen screen_of(const DamageMaterial& rock) {
  const DamageMaterial m = weakest_plane(rock);
  constexpr double never = 1e300;
  switch (m.initiation) {
    case Initiation::principal:
      return {m.tensile_strength, never, 0.0};
    case Initiation::shear:
      return {never, m.cohesion, 0.0};
    case Initiation::ellipse:  // one of the two is at least √½ of its strength
      return {std::sqrt(0.5) * m.tensile_strength, std::sqrt(0.5) * m.cohesion, 0.0};
    case Initiation::box:
      return {m.tensile_strength, m.cohesion, 0.0};
    case Initiation::mohr_coulomb:
      break;
  }
  return {m.tensile_strength, m.cohesion, m.tan_friction};
}

}  // namespace

StressScreen Damage::screen() const {
  StressScreen all = screen_of(materials_.front());
  for (const DamageMaterial& m : materials_) {
    all = either(all, screen_of(m));
  }
  return all;
}

DamagedTriangle Damage::make(const State& state, const Bulk& bulk, Index triangle, Vec2 normal) const {
  DamagedTriangle d;
  d.triangle = triangle;
  d.normal = normal;
  const Index corner = 3 * triangle;
  d.length =
      material(triangle).element_length == ElementLength::oliver
          ? oliver_length(bulk.shape_gradients(triangle), normal)
          : chord_length({state.reference(corner), state.reference(corner + 1), state.reference(corner + 2)},
                         normal);
  d.yield_time = state.time;
  d.kinetic_at_yield = kinetic_energy(state, bulk, triangle);
  return d;
}

Index Damage::initiate(State& state, const Bulk& bulk, std::span<const Index> candidates) {
  Index found = 0;
  for (const Index t : candidates) {
    if (state.damage.of_triangle[at(t)] >= 0) continue;
    // Strength is asked of the stress in the frame that turns with the triangle.
    const Stretch f = stretch_of(state, bulk.shape_gradients(t), t);
    const Sym2 strain = f.u + Sym2{-1.0, -1.0, 0.0};
    const Sym2 stress = bulk.stiffness(t).stress(strain) + bulk.in_situ(t);
    const CrackStart start = crack_start(material(t), stress);
    if (!start.reached) continue;
    crack(state, bulk, t, start);
    if (state.damage.triangles.back().failed) newly_failed_.push_back(state.damage.of_triangle[at(t)]);
    ++found;
  }
  return found;
}

void Damage::crack(State& state, const Bulk& bulk, Index t, const CrackStart& start) const {
  DamagedTriangle d = make(state, bulk, t, start.normal);
  const CrackFrame a(bulk.stiffness(t), start.normal);
  const DamageMaterial m = on_plane(material(t), start.normal);
  d.strength = {m.tensile_strength, start.cohesion};
  const std::array<double, 2> energy{m.fracture_energy_mode1, m.fracture_energy_mode2};
  const std::array<double, 2> stiffness{a.nn, a.ss};
  bool lowered = false;
  for (std::size_t i = 0; i < 2; ++i) {
    const double most = std::sqrt(0.999 * law_->size_factor() * energy[i] * stiffness[i] / d.length);
    lowered = lowered || d.strength[i] > most;
    d.strength[i] = std::min(d.strength[i], most);
  }
  if (lowered) ++state.damage.lowered;
  const double before = bulk.strain_energy(state, t);
  const auto gradients = bulk.shape_gradients(t);
  const Stretch f = stretch_of(state, gradients, t);
  DamagedTriangle intact = d;
  intact.stress = bulk.stiffness(t).stress(f.u + Sym2{-1.0, -1.0, 0.0}) + bulk.in_situ(t);
  set_forces(intact, f, gradients, bulk.area(t));
  evaluate(state, bulk, d);
  // What the triangle loses at this strain, by passing its strength within a step, and what its forces that
  // jump now leave of the work of the last step.
  d.fracture_energy = before - d.stored;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec2 v = state.velocity[at(state.node_of_corner[3 * at(t) + k])];
    d.fracture_energy -= 0.5 * state.time_step * dot(d.force[k] - intact.force[k], v);
  }
  // It is not damped from now on: the second half of the last step's viscous work.
  if (bulk.viscous()) {
    const Sym2 rate = rate_of(state, gradients, t);
    state.dissipation.viscous +=
        0.5 * state.time_step * bulk.area(t) * bulk.viscosity(t) * product(state.strain_rate_of(t), rate);
  }
  d.sliding_work = start.in_shear ? d.fracture_energy : 0.0;
  d.friction_energy = d.dropped = 0.0;
  state.dissipation.fracture += d.fracture_energy;
  state.damage.of_triangle[at(t)] = static_cast<Index>(state.damage.triangles.size());
  state.damage.triangles.push_back(d);
}

void Damage::cut(State& state, const Bulk& bulk, Index triangle, Vec2 normal) const {
  DamagedTriangle d = make(state, bulk, triangle, normal);
  const DamageMaterial m = on_plane(material(triangle), normal);
  d.strength = {m.tensile_strength, m.cohesion};
  d.history = {law_->end(), law_->end()};
  d.failed = 1;
  d.open = 1;
  evaluate(state, bulk, d);
  d.fracture_energy = d.sliding_work = d.friction_energy = d.dropped = 0.0;
  state.damage.of_triangle[at(triangle)] = static_cast<Index>(state.damage.triangles.size());
  state.damage.triangles.push_back(d);
}

Damage::Spent Damage::evaluate(const State& state, const Bulk& bulk, DamagedTriangle& d) const {
  const auto gradients = bulk.shape_gradients(d.triangle);
  const double area = bulk.area(d.triangle);
  const Sym2 in_situ = bulk.in_situ(d.triangle);
  const PlaneStiffness& c = bulk.stiffness(d.triangle);
  const DamageMaterial m = on_plane(material(d.triangle), d.normal);
  const Stretch f = stretch_of(state, gradients, d.triangle);
  const CrackFrame a(c, d.normal);
  const Sym2 total = f.u + Sym2{-1.0, -1.0, 0.0};
  Sym2 strain = total + -1.0 * d.offset;
  Sym2 trial = c.stress(strain) + in_situ;
  const Sym2 unloaded = -1.0 * c.strain(in_situ);  // at which nothing is borne
  const double free_energy = 0.5 * product(in_situ, unloaded);
  Spent spent;

  const auto finish = [&](Sym2 stress, double energy, const Crack& k) {
    d.stress = stress;
    d.stored = area * energy;
    d.damage = std::max(k.d_n, k.d_s);
    d.opening = k.opening() * d.length;
    d.slip = k.sliding() * d.length;
    d.opening_strain = k.e_n;
    d.slip_strain = k.slip;
    d.friction = k.friction;
    set_forces(d, f, gradients, area);
    d.fracture_energy += spent.fracture;
    d.friction_energy += spent.friction;
  };

  Crack k;
  double t_n = product(trial, a.across), t_s = product(trial, a.along);

  if (d.failed && m.drop_all && d.open) {
    if (t_n > 0.0) {
      k.d_n = k.d_s = 1.0;
      k.settle(a, t_n, t_s, m.tan_residual, 0.0);
      finish({}, free_energy, k);
      return spent;
    }
    // Closes: bears what presses it from here on, and nothing along it yet.
    trial = t_n * a.across;
    strain = c.strain(trial + -1.0 * in_situ);
    d.offset = total + -1.0 * strain;
    d.open = 0;
    d.slip_strain = d.friction = t_s = 0.0;
  }

  // What a direction dissipates per area between two damages, the strain as it is.
  const std::array<double, 2> energy{m.fracture_energy_mode1, m.fracture_energy_mode2};
  const std::array<double, 2> stiffness{a.nn, a.ss};
  std::array<double, 2> r{}, before{}, unit{};
  for (std::size_t i = 0; i < 2; ++i) {
    unit[i] = energy[i] / (d.strength[i] * d.length);  // of strain, for x
    r[i] = d.strength[i] / (stiffness[i] * unit[i]);
    before[i] = d.failed ? 1.0 : law_->damage(r[i], d.history[i]);
  }
  k.d_n = before[0];
  k.d_s = before[1];
  const double pull_before = std::max(d.opening_strain, 0.0), slip_before = d.slip_strain;
  std::array<double, 2> x = d.history;
  k.settle(a, t_n, t_s, m.tan_residual, slip_before);
  std::array<bool, 2> driven{};
  for (int turn = 0; !d.failed && turn < (a.ns == 0.0 ? 1 : 20); ++turn) {
    const std::array<double, 2> load{std::max(k.e_n, 0.0), std::abs(k.slip)};
    bool any = false;
    for (std::size_t i = 0; i < 2; ++i) {
      if (load[i] <= unit[i] * (x[i] + r[i] * law_->traction(x[i]))) continue;
      x[i] = std::max(x[i], law_->loaded(r[i], load[i] / unit[i]));
      any = driven[i] = true;
    }
    if (!any) break;
    k.d_n = law_->damage(r[0], x[0]);
    k.d_s = law_->damage(r[1], x[1]);
    if (m.coupled) {
      const std::size_t lower = k.d_n < k.d_s ? 0 : 1;
      k.d_n = k.d_s = std::max(k.d_n, k.d_s);
      x[lower] = std::max(x[lower], law_->at_damage(r[lower], k.d_n));
      driven[lower] = false;
    }
    k.settle(a, t_n, t_s, m.tan_residual, slip_before);
  }

  if (!d.failed) {
    const std::array<double, 2> old_load{pull_before, slip_before}, load{std::max(k.e_n, 0.0), k.slip};
    const std::array<double, 2> after{k.d_n, k.d_s};
    std::array<double, 2> lost{};
    for (std::size_t i = 0; i < 2; ++i) {
      lost[i] = driven[i] ? energy[i] / d.length * (law_->dissipated(x[i]) - law_->dissipated(d.history[i]))
                          : 0.25 * stiffness[i] * (old_load[i] * old_load[i] + load[i] * load[i]) *
                                (after[i] - before[i]);
    }
    spent.fracture += area * (lost[0] + lost[1]);
    d.sliding_work += area * lost[1];
    d.history = x;
  }
  spent.friction += 0.5 * area * (d.friction + k.friction) * (k.sliding() - before[1] * slip_before);

  const bool ends = x[0] >= law_->end() || x[1] >= law_->end();
  const bool energy_spent = !m.coupled && law_->dissipated(x[0]) + law_->dissipated(x[1]) >= 1.0;
  if (!d.failed && (ends || energy_spent)) {
    d.failed = 1;
    const double here = k.energy(a, strain, in_situ);
    k.d_n = k.d_s = 1.0;
    k.settle(a, t_n, t_s, m.tan_residual, slip_before);
    const bool free = m.drop_all && k.e_n > 0.0;
    const double snap = area * (here - (free ? free_energy : k.energy(a, strain, in_situ)));
    spent.fracture += snap;
    d.dropped += snap;
    d.open = k.e_n > 0.0;
    if (free) {
      finish({}, free_energy, k);
      return spent;
    }
  } else if (d.failed && m.drop_all && k.e_n > 0.0) {
    // Opens again.
    const double snap = area * (k.energy(a, strain, in_situ) - free_energy);
    spent.fracture += snap;
    d.dropped += snap;
    d.open = 1;
    finish({}, free_energy, k);
    return spent;
  }
  d.open = k.e_n > 0.0;
  const Sym2 elastic = strain + -k.opening() * a.across + -k.sliding() * a.along;
  finish(c.stress(elastic) + in_situ, k.energy(a, strain, in_situ), k);
  return spent;
}

void Damage::update(State& state, const Bulk& bulk) {
  auto& cracks = state.damage.triangles;
  newly_failed_.clear();
  const auto count = static_cast<Index>(cracks.size());
  if (count == 0) return;
  std::vector<Spent> spent(at(block_count(count)));
  std::vector<std::vector<Index>> failed(spent.size());
  for_each_block(count, [&](Index begin, Index end, Index block) {
    for (Index i = begin; i < end; ++i) {
      DamagedTriangle& d = cracks[at(i)];
      const DamagedTriangle before = d;
      const Spent by_law = evaluate(state, bulk, d);
      // Of the work that the triangle took in the last step, what is neither stored nor rubbed away is
      // fracture energy: the law's, and what the step's length makes of it.
      double work = 0.0;
      for (std::size_t k = 0; k < 3; ++k) {
        const Vec2 v = state.velocity[at(state.node_of_corner[3 * at(d.triangle) + k])];
        work -= 0.5 * state.time_step * dot(before.force[k] + d.force[k], v);
      }
      const double fracture = work - (d.stored - before.stored) - by_law.friction;
      d.fracture_energy += fracture - by_law.fracture;
      spent[at(block)].fracture += fracture;
      spent[at(block)].friction += by_law.friction;
      if (before.failed) continue;
      d.kinetic_rise = std::max(d.kinetic_rise, kinetic_energy(state, bulk, d.triangle) - d.kinetic_at_yield);
      if (d.failed) failed[at(block)].push_back(i);
    }
  });
  for (std::size_t b = 0; b < spent.size(); ++b) {
    state.dissipation.fracture += spent[b].fracture;
    state.dissipation.friction += spent[b].friction;
    newly_failed_.insert(newly_failed_.end(), failed[b].begin(), failed[b].end());
  }
}

double Damage::stored_energy_correction(const State& state, const Bulk& bulk) const {
  double sum = 0.0;
  for (const DamagedTriangle& d : state.damage.triangles)
    sum += d.stored - bulk.strain_energy(state, d.triangle);
  return sum;
}

}  // namespace crackle
