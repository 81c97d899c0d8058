// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <string>

#include "crackle/mesh/mesh.hpp"

namespace crackle::test {

/// Expects what holds for every mesh: counter-clockwise triangles, edges and triangles that agree
/// on each other, no unused vertex.
void expect_sound(const Mesh& mesh);

/// V - E + F: 1 for a mesh without holes, 0 with one hole.
Index euler_number(const Mesh& mesh);

double area(const Mesh& mesh);

/// FNV-1a over the bits of coordinates and triangles.
std::uint64_t checksum(const Mesh& mesh);

/// A small domain that takes milliseconds: 1 m x 1 m, wellbore of 0.1 m, edges of 1 cm there.
MeshRecipe small_recipe(const std::string& generator = "cgal");

/// The message of the MeshError that an action throws; fails the test when it throws none, or when
/// the message has more than one line.
std::string mesh_error(const std::function<void()>& action);

}  // namespace crackle::test
