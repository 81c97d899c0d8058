// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "crackle/fluid/fluid.hpp"

namespace crackle {

/// Closed loops of the wetted boundary. @param leaks set when a loop meets the outer boundary
std::vector<Fluid::Loop> wetted_loops(const State& state, bool& leaks);

}  // namespace crackle
