// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "crackle/io/case.hpp"
#include "crackle/solve/quasi_static.hpp"

namespace crackle {

/// Halves of the domain that are modelled: 1 or 2. What is computed on one stands for both.
double modelled_halves(const Case& scene);

/// Straight path: half of the domain, x > 0, on a graded grid, edges of mesh.size_fine along y = 0 up to
/// mesh.fine_radius, growing to mesh.size_coarse. Free path: the mesh of the dynamic regime.
/// @param network where given, what became of the joints
Mesh make_quasi_static_mesh(const Case& scene, NetworkReport* network = nullptr);

/// Triangles that the grid of a straight path will have, nearly.
double estimate_grid_triangles(const Case& scene);

/// The scene of the stage, on such a mesh.
QuasiStaticScene make_quasi_static_scene(const Case& scene, std::shared_ptr<const Mesh> mesh);

/// Size of the mesh and of the path, in a line.
std::string quasi_static_mesh_text(const Case& scene, const QuasiStaticScene& stage);

/// Dimensionless numbers of the scene, what they say of it, and what the stage leaves out: a line each.
std::vector<std::string> quasi_static_notes(const Case& scene, const QuasiStaticScene& stage);

}  // namespace crackle
