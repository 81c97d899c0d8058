// SPDX-License-Identifier: GPL-3.0-or-later
#include "crackle/core/errors.hpp"
#include "crackle/mesh/mesh.hpp"
namespace crackle {
Mesh read_gmsh(const std::string& path) { throw MeshError(path + ": reading gmsh files is not there yet"); }
void write_gmsh(const Mesh&, const std::string& path) {
  throw MeshError(path + ": writing gmsh files is not there yet");
}
}  // namespace crackle
