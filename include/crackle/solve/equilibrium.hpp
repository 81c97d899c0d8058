// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "crackle/solid/bulk.hpp"
#include "crackle/state/state.hpp"

namespace crackle {

/// Static equilibrium of the intact rock (all edges tied) under its in-situ stress and loads, by a
/// sparse direct factorisation and Newton corrections with it: no steps.
///
/// @param fixed one per vertex: held at zero displacement
/// @param corner_loads constant forces per corner [N/m]; may be empty
/// @return displacement of every vertex [m]
/// @throws NumericalError when the system is singular (nothing holds the body)
std::vector<Vec2> static_displacement(const Mesh& mesh, const Bulk& bulk, const std::vector<char>& fixed,
                                      std::span<const Vec2> corner_loads);

}  // namespace crackle
