// SPDX-License-Identifier: GPL-3.0-or-later
//
// Every member of State and Mesh by name: what a checkpoint saves. A member more is a line more here
// (columns_of() finds out otherwise).
#pragma once

#include "crackle/state/columns.hpp"
#include "crackle/state/state.hpp"

namespace crackle {

template <class V>
void members(Edge& e, V&& v) {
  v("vertex", e.vertex);
  v("triangle", e.triangle);
  v("side", e.side);
  v("kind", e.kind);
  v("joint", e.joint);
}

template <class V>
void members(Mesh& m, V&& v) {
  v("vertices", m.vertices);
  v("triangles", m.triangles);
  v("regions", m.regions);
  v("edges", m.edges);
  v("triangle_edges", m.triangle_edges);
  v("set_of_joint", m.set_of_joint);
  v("joint_sets", m.joint_sets);
}

template <class V>
void members(CohesivePoint& p, V&& v) {
  v("damage", p.damage);
  v("opening_max", p.opening_max);
  v("slip_max", p.slip_max);
  v("plastic_slip", p.plastic_slip);
  v("opening", p.opening);
  v("slip", p.slip);
  v("normal", p.normal);
  v("shear", p.shear);
  v("friction", p.friction);
  v("stored", p.stored);
  v("inserted", p.inserted);
  v("repaid", p.repaid);
  v("path", p.path);
}

template <class V>
void members(CohesiveHistory& h, V&& v) {
  v("element", h.element);
  v("point", h.point);
  v("penalty", h.penalty);
  v("fracture_energy", h.fracture_energy);
  v("sliding_work", h.sliding_work);
  v("friction_energy", h.friction_energy);
  v("made_energy", h.made_energy);
  v("slid", h.slid);
  v("rubbed", h.rubbed);
  v("yield_time", h.yield_time);
  v("face_mass", h.face_mass);
  v("kinetic_at_yield", h.kinetic_at_yield);
  v("kinetic_rise", h.kinetic_rise);
  v("break_time", h.break_time);
  v("mode", h.mode);
}

template <class V>
void members(EndForces& f, V&& v) {
  v("end0", f.end0);
  v("end1", f.end1);
}

template <class V>
void members(CohesiveElements& c, V&& v) {
  v("edge", c.edge);
  v("nodes", c.nodes);
  v("direction", c.direction);
  v("inverse_length", c.inverse_length);
  v("offset", c.offset);
  v("material", c.material);
  v("force", c.force);
  v("status", c.status);
  v("history_of", c.history_of);
  v("histories", c.histories);
  v("active", c.active);
  v("of_edge", c.of_edge);
}

template <class V>
void members(DamagedTriangle& d, V&& v) {
  v("triangle", d.triangle);
  v("normal", d.normal);
  v("length", d.length);
  v("strength", d.strength);
  v("history", d.history);
  v("slip_strain", d.slip_strain);
  v("offset", d.offset);
  v("open", d.open);
  v("failed", d.failed);
  v("damage", d.damage);
  v("opening", d.opening);
  v("slip", d.slip);
  v("opening_strain", d.opening_strain);
  v("friction", d.friction);
  v("stress", d.stress);
  v("stored", d.stored);
  v("fracture_energy", d.fracture_energy);
  v("sliding_work", d.sliding_work);
  v("dropped", d.dropped);
  v("friction_energy", d.friction_energy);
  v("yield_time", d.yield_time);
  v("kinetic_at_yield", d.kinetic_at_yield);
  v("kinetic_rise", d.kinetic_rise);
  v("cavity", d.cavity);
  v("force", d.force);
}

template <class V>
void members(DamageState& d, V&& v) {
  v("triangles", d.triangles);
  v("of_triangle", d.of_triangle);
  v("lowered", d.lowered);
}

template <class V>
void members(Cavity& c, V&& v) {
  v("mass", c.mass);
  v("pressure", c.pressure);
  v("volume", c.volume);
  v("injected", c.injected);
  v("work", c.work);
}

template <class V>
void members(FlowCell& c, V&& v) {
  v("edge", c.edge);
  v("mass", c.mass);
  v("pressure", c.pressure);
  v("volume", c.volume);
  v("gained", c.gained);
}

template <class V>
void members(FluidState& f, V&& v) {
  v("cavities", f.cavities);
  v("cavity_of_edge", f.cavity_of_edge);
  v("cavity_of_vertex", f.cavity_of_vertex);
  v("cells", f.cells);
}

template <class V>
void members(Dissipation& d, V&& v) {
  v("fracture", d.fracture);
  v("friction", d.friction);
  v("viscous", d.viscous);
  v("boundary", d.boundary);
  v("made", d.made);
  v("inserted", d.inserted);
  v("path", d.path);
}

template <class V>
void members(ContactPoint& p, V&& v) {
  v("side", p.side);
  v("place", p.place);
  v("target", p.target);
  v("depth", p.depth);
  v("offset", p.offset);
  v("slip", p.slip);
  v("plastic_slip", p.plastic_slip);
}

template <class V>
void members(ContactState& c, V&& v) {
  v("points", c.points);
  v("broken", c.broken);
  v("listed", c.listed);
  v("moved", c.moved);
}

template <class V>
void members(SlipEdge& e, V&& v) {
  v("edge", e.edge);
  v("event", e.event);
  v("vertex", e.vertex);
  v("partner", e.partner);
  v("place", e.place);
  v("direction", e.direction);
  v("length", e.length);
  v("start", e.start);
  v("last", e.last);
  v("slip_start", e.slip_start);
  v("slip", e.slip);
  v("opening_start", e.opening_start);
  v("opening", e.opening);
  v("traction_start", e.traction_start);
  v("traction", e.traction);
  v("friction_energy", e.friction_energy);
  v("kinetic_start", e.kinetic_start);
}

template <class V>
void members(SlipMemory::Event& e, V&& v) {
  v("name", e.name);
  v("kinetic_rise", e.kinetic_rise);
}

template <class V>
void members(SlipMemory& m, V&& v) {
  v("edges", m.edges);
  v("events", m.events);
}

template <class V>
void members(StrainRates& r, V&& v) {
  v("number", r.number);
}

template <class V>
void members(State& s, V&& v) {
  v("mesh", s.mesh);
  v("time", s.time);
  v("step", s.step);
  v("time_step", s.time_step);
  v("node_of_corner", s.node_of_corner);
  v("node_corners", s.node_corners);
  v("node_first", s.node_first);
  v("node_size", s.node_size);
  v("displacement", s.displacement);
  v("velocity", s.velocity);
  v("inverse_mass", s.inverse_mass);
  v("density", s.density);
  v("strain_rate", s.strain_rate);
  v("cohesive", s.cohesive);
  v("element_on_side", s.element_on_side);
  v("damage", s.damage);
  v("contact", s.contact);
  v("fluid", s.fluid);
  v("dissipation", s.dissipation);
  v("slips", s.slips);
}

}  // namespace crackle
