// SPDX-License-Identifier: GPL-3.0-or-later
//
//   G(Δt) = (4/π) (g(δ) - g(0)),  δ = Δt / t_p                                  Nolte (1979), SPE 8341
//   α = 1:    g = (4/3) ((1+δ)^{3/2} - δ^{3/2}),        g(0) = 4/3   area grows as time: little leak-off
//   α = 1/2:  g = (1+δ) asin((1+δ)^{-1/2}) + δ^{1/2},   g(0) = π/2   as its root: much leak-off
//   between, linear in α (Nolte 1986: bounds of all fractures that grow while pumped).
//
// Volume leaked after shut-in from a fracture whose area A (one face) no longer changes, both faces,
// constant Carter coefficient C_L: V = 2 C_L A t_p^{1/2} (g - g(0)).
#pragma once

namespace crackle {

/// G-function time, dimensionless.
/// @param elapsed time since shut-in [s], 0 or more
/// @param pump_time [s], above 0
/// @param alpha exponent of growth of the area while pumping, 0.5 to 1
double g_function(double elapsed, double pump_time, double alpha);

/// g at shut-in: 4/3 for alpha = 1, pi/2 for alpha = 1/2.
double g_at_shut_in(double alpha);

}  // namespace crackle
