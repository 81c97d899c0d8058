// SPDX-License-Identifier: GPL-3.0-or-later
// What is read off a state: a row of the record, the fracture's cells, fields of the rock.
#pragma once

#include "crackle/seismic/event.hpp"
#include "newton.hpp"

namespace crackle::quasi_static {

constexpr Index of_joint = -2;  // parent of a cell

/// Fluid in a cell at the present opening and pressure, over reference density [m2].
double fluid_in_cell(const Equations& equations, const State& state, std::size_t cell);
/// Of all cells, as accounted [m2].
double fracture_volume(const State& state);
/// The row of a state, without what belongs to a step.
QuasiStaticRow row_of(const Equations& equations, const State& state);
std::vector<FractureCell> cells_of(const Equations& equations, const State& state);
Faces faces_of(const Equations& equations, const State& state, std::size_t cell);
/// What has happened since the fracture went into motion, of what is modelled, without magnitudes. Its energy
/// is all that waves took along, by the ledger; its moment that of all faces.
SeismicEvent snap_of(const Equations& equations, const State& state);
/// Displacement [m] of every corner of every triangle, three a triangle, with the jumps.
std::vector<Vec2> corners_of(const Equations& equations, const State& state);
/// Effective stress [Pa] of every triangle at such a displacement.
std::vector<Sym2> stress_of(const Equations& equations, const std::vector<Vec2>& corners);

}  // namespace crackle::quasi_static
