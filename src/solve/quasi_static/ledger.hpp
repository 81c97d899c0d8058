// SPDX-License-Identifier: GPL-3.0-or-later
// The ledger of energy: what the pump does is kept or lost somewhere. Enthalpy of the fluid over pore
// pressure h(p) = ∫ dp/ρ goes with every unit of its mass; means of h at both ends of a step:
//   pump        Σ h_w Q Δt
//   well        Σ h_w C_w Δp_w             entry   Σ (h_w − h) q Δt
//   viscous     −Σ h (Δm + leaked − q Δt)  leaked  Σ h V_leak
//   fluid       Σ m h − (p − p_pore) V
//   strain      ½ δᵀ S δ                    confinement  −∫ σ'_n w ds
//   friction    Σ τ Δs_p of closed faces (their elastic slip is left out)
//   radiated    where the fracture snaps: kinetic energy and what is damped (dynamics.hpp); as it comes to
//               rest also what strain is kept beyond that of equilibrium at the same jumps and pressure
//   faces       ∫ what bonds and asperities give back ds     fracture  ∫ G(w_m) ds
// The fluid's work on the faces follows from the rest; so a step too long, or an equation that is not
// solved, shows as residual. It takes that whoever presses a face has the fluid for it (a dry edge ahead of
// the tip takes its volume from the cell that presses it), and that nothing moves as a point joins the path
// (growth.hpp).
#pragma once

#include "newton.hpp"

namespace crackle::quasi_static {

/// Books the energies of an initial state as what later ones are counted from.
void begin_ledger(const Equations& equations, State& state);

/// Books a step of length dt [s] with a mean pump rate [m2/s] between two states.
void account(const Equations& equations, const State& before, State& after, double dt, double rate);
/// The same in two parts: what flows and slips in the step, and what is kept and torn since `before`.
void account_flow(const Equations& equations, const State& before, State& after, double dt, double rate);
void account_kept(const Equations& equations, const State& before, State& after);

/// Books a state in motion as one at rest with the same jumps and pressures; what it kept beyond that is
/// radiated.
void account_rest(const Equations& equations, State& state);

/// What does not add up in a step [-], over the largest of what is pumped, kept by the well or by the rock,
/// taken by fracture or by what leaks off in it; 0 where that is less than a thousandth of all that was
/// pumped, or next to nothing.
double error_of_step(const Energies& before, const Energies& after);

}  // namespace crackle::quasi_static
