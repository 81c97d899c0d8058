// SPDX-License-Identifier: GPL-3.0-or-later
#include "gmsh_module.hpp"

extern "C" {
extern const crackle::meshing::GmshModule crackle_gmsh_module;
const crackle::meshing::GmshModule crackle_gmsh_module{
    crackle::meshing::by_gmsh::read, crackle::meshing::by_gmsh::write, crackle::meshing::by_gmsh::fill};
}
