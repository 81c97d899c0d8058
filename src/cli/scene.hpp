// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "crackle/io/case.hpp"
#include "crackle/mesh/mesh.hpp"
#include "crackle/solve/simulation.hpp"

namespace crackle {

/// The recipe of a case's mesh, without its joints.
MeshRecipe mesh_recipe(const Case& scene);

/// The mesh of a case, generated or read from its file, its core still in; passed by the quality gate.
/// @param network where given, what became of the joints of a generated mesh. @throws MeshError
Mesh make_mesh(const Case& scene, NetworkReport* network = nullptr);

/// Of the rock, intact.
PlaneStiffness rock_stiffness(const Case::Rock& rock);

/// What the solver needs of a case, on an excavated mesh.
Scene make_scene(const Case& scene, std::shared_ptr<const Mesh> excavated);

/// Rock and in-situ stress of a layer.
RockMass rock_mass(const Case& scene, const Case::Layer& layer);

}  // namespace crackle
