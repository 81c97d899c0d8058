// SPDX-License-Identifier: GPL-3.0-or-later
// What the edges of a path are made of, and what the rock bears before all.
#pragma once

#include "crackle/cohesive/interface.hpp"
#include "crackle/solve/condensation.hpp"
#include "crackle/solve/quasi_static.hpp"

namespace crackle::quasi_static {

/// Law of a mesh edge of a joint, of the rock, or between two rocks; its strength as the mesh resolves it in
/// the more compliant of the rocks beside it. @param normal of the fracture there @param length of it [m]
InterfaceLaw law_of(const QuasiStaticScene& scene, const EdgeMaterials& materials, Index edge, Vec2 normal,
                    double length);

/// Mean in-situ stress of the rocks beside a mesh edge [Pa].
Sym2 in_situ_beside(const Mesh& mesh, const Bulk& bulk, Index edge);

/// Brings rocks with in-situ stresses that do not fit one another, or the weight of the rock, to equilibrium
/// in the intact mesh, its outer boundary and the wall of its wellbore as they were.
void balance_in_situ(const QuasiStaticScene& scene, const Condensation& rock, Bulk& bulk);

}  // namespace crackle::quasi_static
