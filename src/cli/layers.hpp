// SPDX-License-Identifier: GPL-3.0-or-later
//
// Layers of a case: in its mesh, and as rocks of its scene.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "crackle/io/case.hpp"
#include "crackle/mesh/mesh.hpp"
#include "crackle/solve/simulation.hpp"

namespace crackle {

/// The interfaces are lines of a mesh like joints, of a set for each layer, the first of this number: those
/// of
/// [[joints]] and [[joint_sets]] come before.
std::size_t first_interface(const Case& scene);

/// Adds them to a recipe, those of perfect interfaces last.
void add_interfaces(const Case& scene, MeshRecipe& recipe);

/// Edges on perfect interfaces are edges of the rock like any other.
void weld_perfect_interfaces(const Case& scene, Mesh& mesh);

/// The layer of every triangle, 0: none; empty without layers. @throws MeshError where a triangle lies in
/// two, or on both sides of an interface, or where a layer has none
std::vector<std::uint16_t> layers_of(const Case& scene, const Mesh& mesh);

/// Gives the layers of a case to its scene, whose own rock is set already.
void set_layers(const Case& scene, Scene& solver_scene);

/// The layer that the well, in the origin, is in; nullptr: none.
const Case::Layer* layer_at_well(const Case& scene);
/// Rock round the well, and the in-situ stress that it bears [Pa].
const Case::Rock& rock_at_well(const Case& scene);
const Sym2& stress_at_well(const Case& scene);

/// How many triangles each layer has, in lines.
std::string layers_text(const Case& scene, const Mesh& mesh);

}  // namespace crackle
