// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <string>

namespace crackle::meshing::by_gmsh {

/// Runs an action between gmsh's initialisation and finalisation, with an empty model and no output
/// to the terminal. gmsh keeps its state in globals: one session at a time.
/// @param what goes before the message of every error
/// @throws MeshError for whatever goes wrong in the action
void with_gmsh(const std::string& what, const std::function<void()>& action);

}  // namespace crackle::meshing::by_gmsh
