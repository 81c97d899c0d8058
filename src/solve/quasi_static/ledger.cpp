// SPDX-License-Identifier: GPL-3.0-or-later
#include "ledger.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "bore.hpp"
#include "dynamics.hpp"

namespace crackle::quasi_static {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

double enthalpy(const QuasiStaticScene& scene, double pressure) {
  return scene.fluid.enthalpy(pressure) - scene.fluid.enthalpy(scene.pore_pressure);
}

double strain_energy(const Equations& e, const State& state) {
  if (e.moving) return e.moving->strain_energy();
  double sum = 0.0;
  for (std::size_t i = 0; i < state.jumps.size(); ++i) {
    const double* row = e.rock.row(i);
    double force = 0.5 * row[i] * state.jumps[i];
    for (std::size_t j = 0; j < i; ++j) force += row[j] * state.jumps[j];
    sum += force * state.jumps[i];
  }
  return sum;
}

/// Pressure in a cell before a step; that of the fluid it was filled from where it was dry or not there.
double pressure_before(const Equations& e, const State& before, Index cell) {
  while (cell >= 0 && (at(cell) >= before.cells.size() || !before.cells[at(cell)].wet))
    cell = e.path.edges()[at(cell)].parent;
  return cell < 0 ? before.well_pressure : before.cells[at(cell)].pressure;
}

/// Lost as fluid fills a dry cell that nothing has pressed [J/m]: it comes under pressure between faces that
/// have moved without it.
double fill_loss(const Equations& e, const State& before, const State& after, std::size_t c) {
  if (e.scene.wetting == Wetting::tip_pressure || !after.cells[c].wet) return 0.0;
  if (c < before.cells.size() && before.cells[c].wet) return 0.0;
  const PathEdge& edge = e.path.edges()[c];
  std::vector<double> jumps = before.jumps;
  jumps.resize(after.jumps.size(), 0.0);  // of what has joined the path
  const auto a = openings(edge, jumps), b = openings(edge, after.jumps);
  const double twice = 0.5 * edge.length * (a[0] + a[1] + b[0] + b[1]);  // the mean volume
  return 0.5 * twice * (after.cells[c].pressure - e.scene.pore_pressure);
}

/// A point that may slip: what acts along it.
struct Along {
  double slip = 0.0, plastic_slip = 0.0;  // [m]
  double friction = 0.0;                  // [Pa]
  double stiffness = 0.0;                 // of the bond [Pa/m]
};
Along along(const Equations& e, std::size_t c, std::size_t i, const Point& point,
            const std::vector<double>& jumps) {
  const double opening = openings(e.path.edges()[c], jumps)[i], slip = slips(e.path.edges()[c], jumps)[i];
  const MixedTraction t =
      e.laws[c].traction(opening, slip, point.max_opening, point.plastic_slip, point.bond, point.bond_shear);
  return {slip, point.plastic_slip, t.friction,
          e.laws[c].shear_stiffness(std::max(opening, point.max_opening))};
}

/// Dissipated by friction, and by bonds that give way while they bear shear, with tractions that go straight
/// from those before a step to those after it: ∫ τ ds less what is stored.
struct Slid {
  double friction = 0.0, fracture = 0.0;  // [J/m]
};
Slid slid(const Equations& e, const State& before, const State& after) {
  Slid sum;
  std::vector<double> jumps = before.jumps;
  jumps.resize(after.jumps.size(), 0.0);  // of what has joined the path
  for (std::size_t c = 0; c < after.cells.size(); ++c) {
    for (std::size_t i = 0; i < 2; ++i) {
      const double half = 0.5 * e.path.edges()[c].length;
      const Along b = along(e, c, i, after.cells[c].points[i], after.jumps);
      const Along a = c < before.cells.size() ? along(e, c, i, before.cells[c].points[i], jumps)
                                              : Along{0.0, 0.0, 0.0, e.laws[c].shear_stiffness(0.0)};
      sum.friction += half * 0.5 * (a.friction + b.friction) * (b.plastic_slip - a.plastic_slip);
      sum.fracture += half * 0.5 * a.slip * b.slip * (a.stiffness - b.stiffness);
    }
  }
  return sum;
}

/// Dissipated by opening [J/m].
double opened(const Equations& e, const State& state) {
  double sum = 0.0;
  for (std::size_t c = 0; c < state.cells.size(); ++c) {
    for (const Point& point : state.cells[c].points)
      sum += 0.5 * e.path.edges()[c].length * e.laws[c].dissipated(point.max_opening);
  }
  return sum;
}

/// What the state keeps.
Energies kept(const Equations& e, const State& state) {
  Energies k;
  k.strain = strain_energy(e, state);
  add_bore_energies(e, state, k);
  for (std::size_t c = 0; c < state.cells.size(); ++c) {
    const Cell& cell = state.cells[c];
    const PathEdge& edge = e.path.edges()[c];
    const auto w = openings(edge, state.jumps);
    for (std::size_t i = 0; i < 2; ++i) {
      const Point& point = cell.points[i];
      const double half = 0.5 * edge.length;
      k.confinement -= half * point.in_situ * (w[i] - edge.aperture);
      k.faces += half * e.laws[c].stored(w[i], point.max_opening, point.bond);
      if (!e.scene.slip) continue;
      const Along s = along(e, c, i, point, state.jumps);
      k.confinement -= half * point.in_situ_shear * s.slip;
      k.faces +=
          half * e.laws[c].stored_by_slip(w[i], s.slip, point.max_opening, s.friction, point.bond_shear);
    }
    const Index source = pressure_source(e, state, static_cast<Index>(c));
    if (source < 0) continue;
    const double p = state.cells[at(source)].pressure;
    k.fluid +=
        cell.mass * (enthalpy(e.scene, p) - (p - e.scene.pore_pressure) / e.scene.fluid.density(p).value);
  }
  return k;
}

// What the work of the pump becomes.
constexpr std::array parts{&Energies::well,        &Energies::entry,   &Energies::viscous,
                           &Energies::leaked,      &Energies::fluid,   &Energies::strain,
                           &Energies::confinement, &Energies::faces,   &Energies::fracture,
                           &Energies::friction,    &Energies::radiated};

double left(const Energies& sum) {
  double rest = sum.pumped;
  for (const auto part : parts) rest -= sum.*part;
  return rest;
}

}  // namespace

void begin_ledger(const Equations& equations, State& state) { state.initial = kept(equations, state); }

void account(const Equations& e, const State& before, State& after, double dt, double rate) {
  account_flow(e, before, after, dt, rate);
  account_kept(e, before, after);
}

void account_flow(const Equations& e, const State& before, State& after, double dt, double rate) {
  Energies& sum = after.energies;
  const auto h = [&](double p) { return enthalpy(e.scene, p); };
  const double well = 0.5 * (h(before.well_pressure) + h(after.well_pressure));
  sum.pumped += well * rate * dt;
  sum.well += well * e.scene.well.storage * (after.well_pressure - before.well_pressure);
  std::vector<double> entered(after.cells.size(), 0.0);  // from the well [m2]
  if (before.connected) {
    for (const Inlet& inlet : after.inlets) entered[at(inlet.cell)] += inlet.rate * dt;
  }
  for (std::size_t c = 0; c < after.cells.size(); ++c) {
    const Cell& cell = after.cells[c];
    const Index source = pressure_source(e, after, static_cast<Index>(c));
    if (source < 0) continue;
    const double pressure = after.cells[at(source)].pressure;
    const double mean = 0.5 * (h(pressure_before(e, before, static_cast<Index>(c))) + h(pressure));
    const bool old = c < before.cells.size();
    const double gained = cell.mass - (old ? before.cells[c].mass : 0.0);
    const double lost = cell.leaked - (old ? before.cells[c].leaked : 0.0);
    sum.entry += (well - mean) * entered[c];
    sum.leaked += mean * lost;
    sum.viscous += fill_loss(e, before, after, c) - mean * (gained + lost - entered[c]);
  }
  if (e.scene.slip) {
    const Slid step = slid(e, before, after);
    sum.friction += step.friction;
    sum.fracture += step.fracture;
  }
}

void account_kept(const Equations& e, const State& before, State& after) {
  Energies& sum = after.energies;
  const Energies now = kept(e, after);
  sum.fracture += opened(e, after) - opened(e, before);
  sum.fluid = now.fluid - after.initial.fluid;
  sum.strain = now.strain - after.initial.strain;
  sum.confinement = now.confinement - after.initial.confinement;
  sum.faces = now.faces - after.initial.faces;
  sum.residual = std::abs(left(sum)) / std::max({sum.pumped, sum.well, 1e-30});
}

void account_rest(const Equations& e, State& state) {
  const double before = left(state.energies);
  account_kept(e, state, state);
  state.energies.radiated += left(state.energies) - before;
  state.energies.residual = std::abs(before) / std::max({state.energies.pumped, state.energies.well, 1e-30});
}

double error_of_step(const Energies& before, const Energies& after) {
  double turned = std::max({1e-3 * after.pumped, 1e-3 * after.well, 1e-10});
  const double least = turned;
  for (const auto part :
       {&Energies::pumped, &Energies::well, &Energies::leaked, &Energies::strain, &Energies::fracture})
    turned = std::max(turned, std::abs(after.*part - before.*part));
  return turned > least ? std::abs(left(after) - left(before)) / turned : 0.0;
}

}  // namespace crackle::quasi_static
