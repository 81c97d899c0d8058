// SPDX-License-Identifier: GPL-3.0-or-later
// What libgmsh does for crackle lies in a module of its own, loaded by the first call: libgmsh takes 40 MB of
// memory and most of a program's start, and most runs never ask for it.
#pragma once

#include <string>

#include "crackle/mesh/mesh.hpp"
#include "draft.hpp"

namespace crackle::meshing {

/// The module's functions: see read_gmsh(), write_gmsh() and fill_by_gmsh().
struct GmshModule {
  Mesh (*read)(const std::string& path);
  void (*write)(const Mesh& mesh, const std::string& path);
  void (*fill)(Draft& draft, const MeshRecipe& recipe, const SizeField& size);
};

/// The module's only symbol, and its file's name.
constexpr const char* gmsh_module_symbol = "crackle_gmsh_module";
constexpr const char* gmsh_module_file = "libcrackle_gmsh.so";

namespace by_gmsh {

Mesh read(const std::string& path);
void write(const Mesh& mesh, const std::string& path);
void fill(Draft& draft, const MeshRecipe& recipe, const SizeField& size);

}  // namespace by_gmsh
}  // namespace crackle::meshing
