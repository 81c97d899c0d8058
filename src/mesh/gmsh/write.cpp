// SPDX-License-Identifier: GPL-3.0-or-later
// Meshes to gmsh files. Vertices and triangles keep their numbers, counted from 1.
#include <fmt/format.h>
#include <gmsh.h>

#include "crackle/core/errors.hpp"
#include "gmsh_module.hpp"
#include "gmsh_names.hpp"
#include "session.hpp"

namespace crackle::meshing::by_gmsh {
namespace {

namespace model = gmsh::model;

constexpr int rock_surface = 1, core_surface = 2;  // gmsh's tags
constexpr int wall_curve = 1, first_joint_curve = 2;

std::size_t tag_of(Index i) { return static_cast<std::size_t>(i) + 1; }

void name_group(int dimension, int entity, const std::string& name) {
  model::setPhysicalName(dimension, model::addPhysicalGroup(dimension, {entity}, entity), name);
}

void add_vertices(const Mesh& mesh) {
  std::vector<std::size_t> tags;
  std::vector<double> coordinates;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    tags.push_back(tag_of(v));
    coordinates.insert(coordinates.end(), {mesh.vertices[v].x, mesh.vertices[v].y, 0.0});
  }
  model::mesh::addNodes(2, rock_surface, tags, coordinates);
}

void add_triangles(const Mesh& mesh, Region region, int surface, const std::string& name) {
  std::vector<std::size_t> tags, nodes;
  for (Index t = 0; t < mesh.triangle_count(); ++t) {
    if (mesh.regions[t] != region) continue;
    tags.push_back(tag_of(t));
    for (const Index v : mesh.triangles[t]) nodes.push_back(tag_of(v));
  }
  if (!tags.empty()) model::mesh::addElementsByType(surface, gmsh_triangle, tags, nodes);
  name_group(2, surface, name);
}

/// A named curve of edges, which may be none: so joints keep their numbers. Lines are numbered after
/// the triangles.
void add_curve(const Mesh& mesh, const std::vector<Index>& edges, int curve, const std::string& name) {
  model::addDiscreteEntity(1, curve);
  std::vector<std::size_t> tags, nodes;
  for (const Index e : edges) {
    tags.push_back(mesh.triangles.size() + tag_of(e));
    for (const Index v : mesh.edges[e].vertex) nodes.push_back(tag_of(v));
  }
  if (!tags.empty()) model::mesh::addElementsByType(curve, gmsh_line, tags, nodes);
  name_group(1, curve, name);
}

void add_curves(const Mesh& mesh) {
  std::vector<Index> wall;
  std::vector<std::vector<Index>> joints(mesh.set_of_joint.size());
  for (Index e = 0; e < mesh.edge_count(); ++e) {
    const Edge& edge = mesh.edges[e];
    if (edge.kind == EdgeKind::wellbore) wall.push_back(e);
    if (edge.joint < 0) continue;
    if (edge.joint >= static_cast<Index>(joints.size())) joints.resize(edge.joint + 1);
    joints[edge.joint].push_back(e);
  }
  if (!wall.empty()) add_curve(mesh, wall, wall_curve, gmsh_wall_name);
  for (std::size_t j = 0; j < joints.size(); ++j) {
    const Index joint = static_cast<Index>(j);
    const bool in_set = j < mesh.set_of_joint.size() && !mesh.joint_sets.empty();
    const std::string set = in_set ? mesh.joint_sets[mesh.set_of_joint[j]] : "";
    add_curve(mesh, joints[j], first_joint_curve + joint, joint_name(set, joint));
  }
}

}  // namespace

void write(const Mesh& mesh, const std::string& path) {
  if (!path.ends_with(".msh")) {
    throw MeshError(fmt::format("mesh file \"{}\": its name has to end in .msh", path));
  }
  with_gmsh(fmt::format("mesh file \"{}\"", path), [&] {
    gmsh::option::setNumber("Mesh.MshFileVersion", 4.1);
    gmsh::option::setNumber("Mesh.Binary", 1);  // as text, gmsh writes 16 digits: one short of exact
    gmsh::option::setNumber("Mesh.SaveAll", 1);
    model::addDiscreteEntity(2, rock_surface);
    model::addDiscreteEntity(2, core_surface);
    add_vertices(mesh);
    add_triangles(mesh, Region::rock, rock_surface, "rock");
    add_triangles(mesh, Region::wellbore_core, core_surface, gmsh_core_name);
    add_curves(mesh);
    gmsh::write(path);
  });
}

}  // namespace crackle::meshing::by_gmsh
