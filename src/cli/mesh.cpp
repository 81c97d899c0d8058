// SPDX-License-Identifier: GPL-3.0-or-later
//
// `crackle mesh`: the mesh of a case as a file, for gmsh (.msh) or ParaView (.vtu, and beside it the
// edges of the joints).
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "commands.hpp"
#include "crackle/core/errors.hpp"
#include "crackle/io/output.hpp"
#include "forecast.hpp"
#include "frames.hpp"
#include "joints.hpp"
#include "layers.hpp"
#include "load.hpp"
#include "scene.hpp"

namespace crackle {
namespace {

namespace fs = std::filesystem;

/// The mesh as a frame of fields, its regions and layers marked.
FieldFrame frame_of(const Case& scene, const Mesh& mesh) {
  FieldFrame frame;
  frame.points = mesh.vertices;
  frame.triangles = mesh.triangles;
  Field region{"region", 1, {}};
  for (const Region r : mesh.regions) region.add(static_cast<double>(r));
  frame.cell_fields.push_back(std::move(region));
  if (!scene.layers.empty()) frame.cell_fields.push_back(layer_field(layers_of(scene, mesh)));
  return frame;
}

}  // namespace

int mesh_command(const MeshOptions& options) {
  const std::string ending = fs::path(options.output).extension().string();
  if (ending != ".msh" && ending != ".vtu") {
    throw CaseError(
        fmt::format("{}: cannot tell the format from the ending \"{}\"; write FILE.msh (gmsh) or FILE.vtu "
                    "(ParaView)",
                    options.output, ending));
  }
  const Case scene = load_case(options.case_file, options.overrides, options.seed);
  require_memory(scene);
  NetworkReport network;
  const Mesh mesh = make_mesh(scene, &network);
  const bool jointed =
      std::any_of(mesh.edges.begin(), mesh.edges.end(), [](const Edge& e) { return e.joint >= 0; });
  const std::string joints_file = fs::path(options.output).replace_extension().string() + "_joints.vtu";
  if (ending == ".msh") {
    write_gmsh(mesh, options.output);
  } else {
    write_vtu(options.output, frame_of(scene, mesh));
    if (jointed) write_vtu(joints_file, joint_frame(mesh));
  }
  const MeshRecipe recipe = mesh_recipe(scene);
  const bool generated = scene.mesh.file.empty();
  const MeshQuality quality = measure_quality(mesh, generated ? &recipe : nullptr);
  const auto core = std::count(mesh.regions.begin(), mesh.regions.end(), Region::wellbore_core);
  fmt::print("{}: {} triangles ({} in the wellbore core), {} vertices, {} edges\n", options.output,
             mesh.triangle_count(), core, mesh.vertex_count(), mesh.edge_count());
  fmt::print("smallest angle {:.1f} degrees; edges from {:.3g} to {:.3g} mm", quality.min_angle_deg,
             1e3 * quality.min_edge, 1e3 * quality.max_edge);
  if (generated) {
    fmt::print(", {:.2f} of their target on average, {:.2f} at most", quality.mean_size_ratio,
               quality.max_size_ratio);
  }
  fmt::print("\n");
  if (!scene.layers.empty()) fmt::print("{}\n", layers_text(scene, mesh));
  if (network.joints > 0) fmt::print("{}\n", network_text(network));
  if (jointed && ending == ".vtu") fmt::print("{}: the joints' edges\n", joints_file);
  return 0;
}

}  // namespace crackle
