// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "crackle/io/case.hpp"
#include "crackle/solve/quasi_static.hpp"

namespace crackle {

/// What the choice of a regime rests on.
struct RegimeChoice {
  bool quasi_static = false;
  std::string reason;  ///< one line, with the numbers
};

/// "auto" takes the quasi-static stage where the run lasts 1000 times longer than a shear wave takes to
/// cross the domain and there is a fracture to start from. @throws CaseError when it is asked for and
/// cannot be
RegimeChoice choose_regime(const Case& scene);

/// Half of the domain, x > 0, on a graded grid: edges of mesh.size_fine along y = 0 up to
/// mesh.fine_radius, growing to mesh.size_coarse.
Mesh make_quasi_static_mesh(const Case& scene);

/// The scene of one of two symmetric wings along x.
QuasiStaticScene make_quasi_static_scene(const Case& scene, std::shared_ptr<const Mesh> mesh);

/// Dimensionless numbers of the scene, what they say of it, and what the stage leaves out: a line each.
std::vector<std::string> quasi_static_notes(const Case& scene, const QuasiStaticScene& stage);

}  // namespace crackle
