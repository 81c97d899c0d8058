// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "crackle/io/output.hpp"
#include "crackle/solve/simulation.hpp"

namespace crackle {

/// Names of the fields that output.fields may hold, in the order they are written.
const std::vector<std::string>& field_names();

/// Triangles of a simulation with the fields asked for (none: all).
FieldFrame field_frame(const Simulation& simulation, const std::vector<std::string>& fields);

/// Yielding and broken cohesive elements of a simulation.
FractureFrame fracture_frame(const Simulation& simulation);

/// The layer of every triangle, 0: none.
Field layer_field(const std::vector<std::uint16_t>& layers);

}  // namespace crackle
