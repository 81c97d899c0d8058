// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "crackle/io/case.hpp"
#include "crackle/io/output.hpp"
#include "crackle/mesh/mesh.hpp"
#include "crackle/solve/simulation.hpp"

namespace crackle {

/// Adds the joints of a case to the recipe of its mesh: those of [[joints]], a set each, before those of
/// [[joint_sets]]. @throws CaseError on a bad CSV file, MeshError on a set that cannot be drawn
void add_joints(const Case& scene, MeshRecipe& recipe);

/// Unit vector along fracture.notch.
Vec2 notch_direction(const Case& scene);

/// The joints of an excavated mesh with the properties that the case gives their sets. @throws CaseError on a
/// set of a mesh file that the case does not know
void set_joints(const Case& scene, Scene& solver_scene);

/// What became of the joints, in a line or two for people; empty without joints.
std::string network_text(const NetworkReport& report);

/// The joints' edges, as lines.
FractureFrame joint_frame(const Mesh& mesh);

}  // namespace crackle
