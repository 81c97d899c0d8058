// SPDX-License-Identifier: GPL-3.0-or-later
//
// Elastic rock with a straight open slit along y = 0, which may run through a wellbore.
#pragma once

#include <algorithm>

#include "../granite.hpp"
#include "crackle/solve/equilibrium.hpp"

namespace crackle {

struct Slit {
  std::shared_ptr<const Mesh> mesh;            // the slit's vertices doubled, the wellbore excavated
  std::vector<std::pair<Index, Index>> faces;  // lower and upper vertex at a place
  std::vector<char> fixed;                     // vertices of the outer boundary
};

/// A slit from −half_length to half_length in a square mesh.
inline Slit make_slit(MeshRecipe recipe, double half_length) {
  using granite::at;
  recipe.joints = {{{-half_length, 0.0}, {half_length, 0.0}}};
  recipe.joint_sets = {"crack"};
  const Mesh whole = recipe.wellbore_diameter > 0.0 ? excavate(generate_mesh(recipe)) : generate_mesh(recipe);
  Mesh mesh = whole;
  std::vector<Index> upper(mesh.vertices.size(), -1);
  Slit slit;
  for (const Edge& edge : whole.edges) {
    if (edge.joint < 0) continue;
    for (const Index v : edge.vertex) {
      if (upper[at(v)] >= 0 || std::abs(whole.vertices[at(v)].x) > half_length * (1.0 - 1e-9)) continue;
      upper[at(v)] = mesh.vertex_count();
      mesh.vertices.push_back(mesh.vertices[at(v)]);
      slit.faces.emplace_back(v, upper[at(v)]);
    }
  }
  for (Index t = 0; t < mesh.triangle_count(); ++t) {
    if (granite::centroid(whole, t).y < 0.0) continue;
    for (Index& v : mesh.triangles[at(t)]) {
      if (v < static_cast<Index>(upper.size()) && upper[at(v)] >= 0) v = upper[at(v)];
    }
  }
  build_edges(mesh);
  slit.fixed.assign(mesh.vertices.size(), 0);
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    const Vec2 x = mesh.vertices[v];
    slit.fixed[v] = std::max(std::abs(x.x), std::abs(x.y)) > 0.5 * recipe.width * (1.0 - 1e-9);
  }
  slit.mesh = std::make_shared<const Mesh>(std::move(mesh));
  return slit;
}

/// Displacement [m] of every vertex under tractions −stress·n on slit and wellbore, n out of the rock: a
/// pressure p is a stress p in all directions, a load from afar what it would be on the faces in whole rock.
inline std::vector<Vec2> displacement(const Slit& slit, Sym2 stress,
                                      std::vector<Vec2>* forces_on_vertices = nullptr) {
  using granite::at;
  const Mesh& mesh = *slit.mesh;
  const Bulk bulk(mesh, granite::stiffness(), granite::density, {}, {});
  const auto load = [&](const State&, std::span<Vec2> forces) {
    if (forces_on_vertices != nullptr) forces_on_vertices->assign(mesh.vertices.size(), {});
    for (const Edge& edge : mesh.edges) {
      const auto& v = edge.vertex;
      if (edge.triangle[1] >= 0 || (slit.fixed[at(v[0])] && slit.fixed[at(v[1])])) continue;
      const Vec2 n = right_normal(mesh.vertices[at(v[1])] - mesh.vertices[at(v[0])]);
      const Vec2 half{-0.5 * (stress.xx * n.x + stress.xy * n.y), -0.5 * (stress.xy * n.x + stress.yy * n.y)};
      for (const Index side : {edge.side[0] + 0, (edge.side[0] + 1) % 3}) {
        forces[at(3 * edge.triangle[0] + side)] += half;
        if (forces_on_vertices != nullptr)
          (*forces_on_vertices)[at(mesh.triangles[at(edge.triangle[0])][at(side)])] += half;
      }
    }
  };
  return static_displacement(slit.mesh, bulk, slit.fixed, load);
}

}  // namespace crackle
