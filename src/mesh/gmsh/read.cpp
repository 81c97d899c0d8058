// SPDX-License-Identifier: GPL-3.0-or-later
// Meshes from gmsh files, through libgmsh: it reads every version of its format.
#include <fmt/format.h>
#include <gmsh.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>

#include "crackle/core/errors.hpp"
#include "edge_marks.hpp"
#include "gmsh_module.hpp"
#include "gmsh_names.hpp"
#include "session.hpp"

namespace crackle::meshing::by_gmsh {
namespace {

struct Element {
  std::size_t tag = 0;
  std::array<std::size_t, 3> node{};  ///< gmsh's tags of its nodes; a line has two
  Region region = Region::rock;
};

std::vector<int> entities_of(int dimension) {
  gmsh::vectorpair pairs;
  gmsh::model::getEntities(pairs, dimension);
  std::vector<int> entities;
  for (const auto& pair : pairs) entities.push_back(pair.second);
  return entities;
}

/// Elements of an entity, all of one type. @throws MeshError on another type
std::vector<Element> elements_of(int dimension, int entity) {
  const int wanted = dimension == 1 ? gmsh_line : gmsh_triangle;
  const std::size_t nodes_each = dimension == 1 ? 2 : 3;
  std::vector<int> types;
  std::vector<std::vector<std::size_t>> tags, nodes;
  gmsh::model::mesh::getElements(types, tags, nodes, dimension, entity);
  std::vector<Element> elements;
  for (std::size_t k = 0; k < types.size(); ++k) {
    if (types[k] != wanted) {
      std::string name;
      int of_dimension = 0, order = 0, count = 0, primary = 0;
      std::vector<double> local;
      gmsh::model::mesh::getElementProperties(types[k], name, of_dimension, order, count, local, primary);
      throw MeshError(fmt::format("it has elements of type \"{}\": mesh with straight triangles only", name));
    }
    for (std::size_t i = 0; i < tags[k].size(); ++i) {
      Element element;
      element.tag = tags[k][i];
      for (std::size_t c = 0; c < nodes_each; ++c) element.node[c] = nodes[k][i * nodes_each + c];
      elements.push_back(element);
    }
  }
  return elements;
}

/// Entities of the physical groups of a dimension, by the group's name.
std::map<std::string, std::vector<int>> physical_groups(int dimension) {
  std::map<std::string, std::vector<int>> by_name;
  gmsh::vectorpair groups;
  gmsh::model::getPhysicalGroups(groups, dimension);
  for (const auto& pair : groups) {
    std::string name;
    gmsh::model::getPhysicalName(dimension, pair.second, name);
    std::vector<int> entities;
    gmsh::model::getEntitiesForPhysicalGroup(dimension, pair.second, entities);
    auto& list = by_name[name];
    list.insert(list.end(), entities.begin(), entities.end());
  }
  return by_name;
}

std::vector<Element> read_triangles() {
  if (!entities_of(3).empty()) throw MeshError("it has volumes: a mesh of the plane is needed");
  const auto groups = physical_groups(2);
  std::vector<int> core;
  if (const auto found = groups.find(gmsh_core_name); found != groups.end()) core = found->second;
  std::vector<Element> triangles;
  for (const int entity : entities_of(2)) {
    const bool in_core = std::find(core.begin(), core.end(), entity) != core.end();
    for (Element& triangle : elements_of(2, entity)) {
      triangle.region = in_core ? Region::wellbore_core : Region::rock;
      triangles.push_back(triangle);
    }
  }
  if (triangles.empty()) throw MeshError("it has no triangles");
  std::sort(triangles.begin(), triangles.end(),
            [](const Element& s, const Element& t) { return s.tag < t.tag; });
  return triangles;
}

/// Vertices that triangles use, in the order of their tags. @returns the vertex of each tag
std::map<std::size_t, Index> read_vertices(Mesh& mesh, const std::vector<Element>& triangles) {
  std::vector<std::size_t> tags;
  std::vector<double> coordinates, parameters;
  gmsh::model::mesh::getNodes(tags, coordinates, parameters);
  std::map<std::size_t, std::size_t> place;
  for (std::size_t i = 0; i < tags.size(); ++i) place[tags[i]] = i;

  std::map<std::size_t, Index> vertex;
  for (const Element& triangle : triangles) {
    for (const std::size_t tag : triangle.node) vertex[tag] = -1;
  }
  double lowest = 0.0, highest = 0.0;
  for (auto& [tag, index] : vertex) {
    const auto found = place.find(tag);
    if (found == place.end()) throw MeshError(fmt::format("a triangle has node {}, which is not there", tag));
    const double* at = coordinates.data() + 3 * found->second;
    if (!std::isfinite(at[0]) || !std::isfinite(at[1]) || !std::isfinite(at[2])) {
      throw MeshError(fmt::format("node {} has no finite coordinates", tag));
    }
    index = mesh.vertex_count();
    lowest = index == 0 ? at[2] : std::min(lowest, at[2]);
    highest = index == 0 ? at[2] : std::max(highest, at[2]);
    mesh.vertices.push_back({at[0], at[1]});
  }
  const auto [left, right] = std::minmax_element(mesh.vertices.begin(), mesh.vertices.end(),
                                                 [](Vec2 p, Vec2 q) { return p.x < q.x; });
  if (highest - lowest > 1e-9 * (right->x - left->x)) {
    throw MeshError("its nodes differ in z: a mesh of the plane is needed");
  }
  return vertex;
}

/// Two vertices at one place would be a crack that nobody asked for.
void refuse_duplicate_vertices(const Mesh& mesh) {
  std::vector<Vec2> sorted = mesh.vertices;
  std::sort(sorted.begin(), sorted.end(), [](Vec2 p, Vec2 q) { return p.x != q.x ? p.x < q.x : p.y < q.y; });
  const auto twice = std::adjacent_find(sorted.begin(), sorted.end());
  if (twice != sorted.end()) {
    throw MeshError(fmt::format("it has two nodes at ({:.6g}, {:.6g}): merge them (gmsh: Coherence Mesh)",
                                twice->x, twice->y));
  }
}

/// Edges of joints and wall; the mesh gets the joints' sets.
std::vector<EdgeMark> read_marks(const std::map<std::size_t, Index>& vertex, Mesh& mesh) {
  std::vector<EdgeMark> marks;
  const auto collect = [&](const std::vector<int>& entities, EdgeKind kind, Index joint) {
    for (const int entity : entities) {
      for (const Element& line : elements_of(1, entity)) {
        const auto v = vertex.find(line.node[0]), w = vertex.find(line.node[1]);
        if (v == vertex.end() || w == vertex.end()) {
          throw MeshError(
              fmt::format("line {} of a joint or the wellbore is no edge of a triangle", line.tag));
        }
        marks.push_back({{v->second, w->second}, kind, joint});
      }
    }
  };
  const auto groups = physical_groups(1);
  std::map<std::string, std::vector<int>, decltype(&joint_name_before)> joints(&joint_name_before);
  for (const auto& [name, entities] : groups) {
    if (name == gmsh_wall_name) collect(entities, EdgeKind::wellbore, -1);
    if (name.starts_with("joint")) joints[name] = entities;
  }
  for (const auto& [name, entities] : joints) {
    collect(entities, EdgeKind::interior, static_cast<Index>(mesh.set_of_joint.size()));
    const std::string set = set_of_joint_name(name);
    const auto known = std::find(mesh.joint_sets.begin(), mesh.joint_sets.end(), set);
    mesh.set_of_joint.push_back(static_cast<Index>(known - mesh.joint_sets.begin()));
    if (known == mesh.joint_sets.end()) mesh.joint_sets.push_back(set);
  }
  return marks;
}

/// gmsh would also run scripts and read CAD files: only what says it is a mesh gets that far.
void require_mesh_file(const std::string& path) {
  std::ifstream file(path);
  std::string first;
  if (!file || !std::getline(file, first)) throw MeshError("it cannot be read, or is empty");
  if (!first.starts_with("$MeshFormat") && !first.starts_with("$NOD")) {
    throw MeshError("it is no gmsh mesh file (the first line has to be $MeshFormat)");
  }
}

Mesh read_open_model() {
  Mesh mesh;
  const std::vector<Element> triangles = read_triangles();
  const auto vertex = read_vertices(mesh, triangles);
  refuse_duplicate_vertices(mesh);
  for (const Element& triangle : triangles) {
    mesh.triangles.push_back(
        {vertex.at(triangle.node[0]), vertex.at(triangle.node[1]), vertex.at(triangle.node[2])});
    mesh.regions.push_back(triangle.region);
  }
  build_edges(mesh);
  const auto missing = apply_edge_marks(mesh, read_marks(vertex, mesh));
  if (!missing.empty()) {
    const Vec2 at = mesh.vertices[missing.front().vertex[0]];
    throw MeshError(fmt::format(
        "{} lines of joints or the wellbore are no edges of triangles, the first at ({:.6g}, {:.6g})",
        missing.size(), at.x, at.y));
  }
  return mesh;
}

}  // namespace

Mesh read(const std::string& path) {
  Mesh mesh;
  with_gmsh(fmt::format("mesh file \"{}\"", path), [&] {
    require_mesh_file(path);
    gmsh::open(path);
    mesh = read_open_model();
  });
  return mesh;
}

}  // namespace crackle::meshing::by_gmsh
