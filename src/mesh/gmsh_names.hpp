// SPDX-License-Identifier: GPL-3.0-or-later
// What both ends of a gmsh file agree on.
#pragma once

#include <string>
#include <utility>

#include "crackle/mesh/mesh.hpp"

namespace crackle::meshing {

// gmsh's numbers of the 2-node line and the 3-node triangle.
constexpr int gmsh_line = 1;
constexpr int gmsh_triangle = 2;

// Names of physical groups.
constexpr const char* gmsh_core_name = "wellbore_core";  // surface
constexpr const char* gmsh_wall_name = "wellbore_wall";  // curve: the wall of an excavated wellbore

/// "joint_000012" for joint 12.
std::string joint_name(Index joint);

/// Orders names as people number them, joint2 before joint10: by what stands before the digits at
/// the end, then by the number, then by the whole name.
bool joint_name_before(const std::string& a, const std::string& b);

}  // namespace crackle::meshing
