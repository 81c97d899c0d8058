// SPDX-License-Identifier: GPL-3.0-or-later
//
// Any bytes as a gmsh file: a mesh whose edges fit its triangles, or a MeshError.
#include <cstdint>
#include <cstdlib>

#include "crackle/core/errors.hpp"
#include "crackle/mesh/mesh.hpp"
#include "gmsh_module.hpp"
#include "scratch_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const crackle::Mesh mesh =
        crackle::meshing::by_gmsh::read(crackle_fuzz::scratch_file(data, size, ".msh"));
    if (mesh.triangle_edges.size() != mesh.triangles.size()) std::abort();
    for (const crackle::Edge& edge : mesh.edges) {
      if (edge.triangle[0] < 0 || edge.triangle[0] >= mesh.triangle_count()) std::abort();
    }
  } catch (const crackle::MeshError&) {
  }
  return 0;
}
