// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "crackle/solid/bulk.hpp"
#include "crackle/state/state.hpp"

namespace crackle {

/// Static equilibrium of the intact rock (all edges tied) under its in-situ stress and loads, by a
/// sparse direct factorisation and Newton corrections with it: no steps.
///
/// @param fixed one per vertex: held at zero displacement
/// @param add_loads adds the loads to the forces per corner [N/m] of a tied state in its present
///        place (they may follow its motion, as a pressure does); may be empty
/// @return displacement of every vertex [m]
/// @throws NumericalError when the system is singular (nothing holds the body)
std::vector<Vec2> static_displacement(const std::shared_ptr<const Mesh>& mesh, const Bulk& bulk,
                                      const std::vector<char>& fixed,
                                      const std::function<void(const State&, std::span<Vec2>)>& add_loads);

}  // namespace crackle
