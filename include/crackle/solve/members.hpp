// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a simulation keeps beside its State, by name: goes into a checkpoint too.
#pragma once

#include "crackle/solve/guards.hpp"
#include "crackle/solve/quasi_static_state.hpp"
#include "crackle/solve/simulation.hpp"
#include "crackle/state/members.hpp"

namespace crackle {

template <class V>
void members(Energies& e, V&& v) {
  v("kinetic", e.kinetic);
  v("strain", e.strain);
  v("cohesive", e.cohesive);
  v("fracture", e.fracture);
  v("friction", e.friction);
  v("viscous", e.viscous);
  v("fluid", e.fluid);
  v("external", e.external);
  v("inserted", e.inserted);
  v("path", e.path);
  v("residual", e.residual);
}

template <class V>
void members(StableStep& s, V&& v) {
  v("limit", s.limit);
  v("proven", s.proven);
  v("margin", s.margin);
  v("triangle", s.triangle);
  v("without_viscosity", s.without_viscosity);
  v("without_elements", s.without_elements);
}

template <class V>
void members(BoundaryNode& n, V&& v) {
  v("node", n.node);
  v("load", n.load);
  v("dashpot", n.dashpot);
  v("velocity_before", n.velocity_before);
}

template <class V>
void members(GuardMemory& m, V&& v) {
  v("alarms", m.alarms);
  v("raised", m.raised);
  v("broken", m.broken);
  v("stray", m.stray);
  v("largest_energy", m.largest_energy);
}

template <class V>
void members(LoadImpulse& i, V&& v) {
  v("impulse", i.impulse);
  v("time", i.time);
}

template <class V>
void members(LoadsMemory& m, V&& v) {
  v("constant", m.constant);
  v("impulses", m.impulses);
}

template <class V>
void members(SimulationMemory& m, V&& v) {
  v("reference", m.reference);
  v("scale", m.scale);
  v("stable", m.stable);
  v("geostatic_slips", m.geostatic_slips);
  v("slowed", m.slowed);
  v("rough_insertions", m.rough_insertions);
  v("stressed", m.stressed);
  v("boundary", m.boundary);
  v("loads", m.loads);
}

namespace quasi_static {

template <class V>
void members(Point& p, V&& v) {
  v("max_opening", p.max_opening);
  v("in_situ", p.in_situ);
  v("in_situ_shear", p.in_situ_shear);
  v("bond", p.bond);
  v("bond_shear", p.bond_shear);
  v("plastic_slip", p.plastic_slip);
}

template <class V>
void members(Cell& c, V&& v) {
  v("edge", c.edge);
  v("inner", c.inner);
  v("parent", c.parent);
  v("along", c.along);
  v("points", c.points);
  v("wet", c.wet);
  v("pressure", c.pressure);
  v("mass", c.mass);
  v("exposed", c.exposed);
  v("sweep", c.sweep);
  v("leaked", c.leaked);
}

template <class V>
void members(Inlet& i, V&& v) {
  v("cell", i.cell);
  v("rate", i.rate);
}

template <class V>
void members(Tip& t, V&& v) {
  v("wing", t.wing);
  v("cell", t.cell);
  v("place", t.place);
  v("since", t.since);
}

template <class V>
void members(Energies& e, V&& v) {
  v("pumped", e.pumped);
  v("well", e.well);
  v("entry", e.entry);
  v("viscous", e.viscous);
  v("leaked", e.leaked);
  v("fluid", e.fluid);
  v("strain", e.strain);
  v("confinement", e.confinement);
  v("faces", e.faces);
  v("fracture", e.fracture);
  v("friction", e.friction);
  v("radiated", e.radiated);
  v("residual", e.residual);
}

template <class V>
void members(Faces& f, V&& v) {
  v("opening", f.opening);
  v("slip", f.slip);
  v("damaged", f.damaged);
}

template <class V>
void members(Motion& m, V&& v) {
  v("place", m.place);
  v("velocity", m.velocity);
  v("begin", m.begin);
  v("tried", m.tried);
  v("length", m.length);
  v("radiated", m.radiated);
  v("fracture", m.fracture);
  v("friction", m.friction);
  v("faces", m.faces);
  v("damped", m.damped);
  v("kinetic", m.kinetic);
  v("steps", m.steps);
}

template <class V>
void members(State& s, V&& v) {
  v("time", s.time);
  v("step", s.step);
  v("event", s.event);
  v("jumps", s.jumps);
  v("cells", s.cells);
  v("matrix", s.matrix);
  v("inlets", s.inlets);
  v("tips", s.tips);
  v("well_pressure", s.well_pressure);
  v("well_before", s.well_before);
  v("bore", s.bore);
  v("connected", s.connected);
  v("breakdown_time", s.breakdown_time);
  v("injected", s.injected);
  v("leaked", s.leaked);
  v("initial_fracture", s.initial_fracture);
  v("initial_well", s.initial_well);
  v("initial_bore", s.initial_bore);
  v("energies", s.energies);
  v("initial", s.initial);
  v("rejected", s.rejected);
  v("iterations", s.iterations);
  v("motion", s.motion);
}

}  // namespace quasi_static
}  // namespace crackle
