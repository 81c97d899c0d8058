// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a simulation keeps beside its State, by name: goes into a checkpoint too.
#pragma once

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
  v("residual", e.residual);
}

template <class V>
void members(StableStep& s, V&& v) {
  v("limit", s.limit);
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
void members(SimulationMemory& m, V&& v) {
  v("reference", m.reference);
  v("scale", m.scale);
  v("stable", m.stable);
  v("geostatic_slips", m.geostatic_slips);
  v("slowed", m.slowed);
  v("rough_insertions", m.rough_insertions);
  v("stressed", m.stressed);
  v("boundary", m.boundary);
}

}  // namespace crackle
