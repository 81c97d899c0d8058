// SPDX-License-Identifier: GPL-3.0-or-later
// Loads the module that speaks to libgmsh, on the first call.
#include <dlfcn.h>
#include <fmt/format.h>

#include <filesystem>

#include "crackle/core/errors.hpp"
#include "crackle/mesh/mesh.hpp"
#include "draft.hpp"
#include "gmsh_module.hpp"

namespace crackle {
namespace meshing {
namespace {

// The module lies beside the library (or program) that this function is in, wherever that was moved to.
const GmshModule& load_module() {
  Dl_info here{};
  dladdr(reinterpret_cast<const void*>(&load_module), &here);
  const auto file = std::filesystem::path(here.dli_fname).parent_path() / gmsh_module_file;
  void* module = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (module == nullptr) throw MeshError(fmt::format("gmsh's module cannot be loaded: {}", dlerror()));
  const void* functions = dlsym(module, gmsh_module_symbol);
  if (functions == nullptr) throw MeshError(fmt::format("{} is no module of crackle", file.string()));
  return *static_cast<const GmshModule*>(functions);
}

const GmshModule& gmsh_module() {
  static const GmshModule& module = load_module();
  return module;
}

}  // namespace

void fill_by_gmsh(Draft& draft, const MeshRecipe& recipe, const SizeField& size) {
  gmsh_module().fill(draft, recipe, size);
}

}  // namespace meshing

Mesh read_gmsh(const std::string& path) { return meshing::gmsh_module().read(path); }

void write_gmsh(const Mesh& mesh, const std::string& path) { meshing::gmsh_module().write(mesh, path); }

}  // namespace crackle
