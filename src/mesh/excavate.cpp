// SPDX-License-Identifier: GPL-3.0-or-later
// Drilling: the triangles of the wellbore core go, the wall stays as a boundary.
#include "crackle/core/errors.hpp"
#include "crackle/mesh/mesh.hpp"
#include "edge_marks.hpp"

namespace crackle {

Mesh excavate(const Mesh& mesh) {
  std::vector<meshing::EdgeMark> marks;
  for (const Edge& edge : mesh.edges) {
    const bool core_a = mesh.regions[edge.triangle[0]] == Region::wellbore_core;
    const bool core_b =
        edge.triangle[1] < 0 ? core_a : mesh.regions[edge.triangle[1]] == Region::wellbore_core;
    if (core_a && core_b) continue;
    const bool wall = core_a != core_b || edge.kind == EdgeKind::wellbore;
    if (wall || edge.joint >= 0) {
      marks.push_back({edge.vertex, wall ? EdgeKind::wellbore : edge.kind, edge.joint});
    }
  }

  Mesh rock;
  rock.triangles.reserve(mesh.triangles.size());
  rock.regions.reserve(mesh.regions.size());
  rock.vertices.reserve(mesh.vertices.size());
  rock.set_of_joint = mesh.set_of_joint;
  rock.joint_sets = mesh.joint_sets;
  std::vector<bool> used(mesh.vertices.size(), false);
  for (Index t = 0; t < mesh.triangle_count(); ++t) {
    if (mesh.regions[t] == Region::wellbore_core) continue;
    rock.triangles.push_back(mesh.triangles[t]);
    rock.regions.push_back(mesh.regions[t]);
    for (const Index v : mesh.triangles[t]) used[v] = true;
  }
  if (rock.triangles.empty()) throw MeshError("the mesh has no rock outside its wellbore core");

  std::vector<Index> new_index(mesh.vertices.size(), -1);
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    if (!used[v]) continue;
    new_index[v] = rock.vertex_count();
    rock.vertices.push_back(mesh.vertices[v]);
  }
  for (auto& triangle : rock.triangles) {
    for (Index& v : triangle) v = new_index[v];
  }
  for (auto& mark : marks) {
    for (Index& v : mark.vertex) v = new_index[v];
  }
  build_edges(rock);
  meshing::apply_edge_marks(rock, marks);
  return rock;
}

}  // namespace crackle
