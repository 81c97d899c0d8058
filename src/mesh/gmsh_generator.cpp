// SPDX-License-Identifier: GPL-3.0-or-later
#include "crackle/core/errors.hpp"
#include "draft.hpp"
namespace crackle::meshing {
Draft make_gmsh_draft(const MeshRecipe&) { throw MeshError("the gmsh generator is not there yet"); }
}  // namespace crackle::meshing
