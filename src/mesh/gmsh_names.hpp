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

/// "joint_bedding_000012" for joint 12 of the set "bedding"; "joint_000012" of a set without a name.
std::string joint_name(const std::string& set, Index joint);

/// "bedding" of "joint_bedding_000012" and of "joint_bedding"; "" of "joint12".
std::string set_of_joint_name(const std::string& name);

/// Orders names as people number them: by the number at their end (none: first), then by name.
bool joint_name_before(const std::string& a, const std::string& b);

}  // namespace crackle::meshing
