// SPDX-License-Identifier: GPL-3.0-or-later
// The wellbore that a mesh has: excavation under the in-situ stress, and the pressure of the well, load its
// wall; its volume is part of the well's storage. With E and P what they do to the jumps (condensation.hpp),
// C_pp and C_ep the intact rock's compliances, p the pressure above that of the pores:
//   rock      S δ = … + E + p P
//   volume    V = V₀ + C_ep + p C_pp + Pᵀδ,  fluid V ρ(p)
//   strain    p C_ep + ½ p² C_pp + …        work against the in-situ stress  −p C_ep − Eᵀδ + …
#pragma once

#include "newton.hpp"

namespace crackle::quasi_static {

enum : std::uint8_t { excavated, pressed };  // loads on the rock, by their numbers

/// Volume of the wellbore in a mesh [m2]; 0: it has none.
double bore_volume(const Mesh& mesh);
/// A vertex is on its wall.
bool on_wall(const Mesh& mesh, Index vertex);
/// Gives the rock the loads of its wall: excavation, and one Pa of pressure.
void load_wall(const Mesh& mesh, const Bulk& bulk, Condensation& rock);

/// How much of each load acts: 1 of excavation, the pressure of the well above that of the pores [Pa].
std::array<double, 2> wall_loads(const Equations& equations, const State& state);
/// Displacement of the rock as Condensation::displacement() gives it [m].
std::vector<Vec2> displacement(const Equations& equations, const State& state);
/// Fluid in the wellbore, over reference density [m2].
double fluid_in_bore(const Equations& equations, const State& state);
/// Fluid that the well takes as its pressure rises and no jump changes [m2/Pa].
double well_storage(const Equations& equations, const State& state);
/// Adds what the wellbore keeps, in its fluid and in the rock round it.
void add_bore_energies(const Equations& equations, const State& state, Energies& kept);

}  // namespace crackle::quasi_static
