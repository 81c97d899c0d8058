// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh_checks.hpp"

#include <gtest/gtest.h>

#include <bit>

#include "crackle/core/errors.hpp"

namespace crackle::test {

void expect_sound(const Mesh& mesh) {
  ASSERT_EQ(mesh.regions.size(), mesh.triangles.size());
  ASSERT_EQ(mesh.triangle_edges.size(), mesh.triangles.size());
  std::vector<int> uses(mesh.edges.size(), 0);
  std::vector<bool> used(mesh.vertices.size(), false);
  for (Index t = 0; t < mesh.triangle_count(); ++t) {
    const auto& corner = mesh.triangles[t];
    const Vec2 p = mesh.vertices.at(corner[0]), q = mesh.vertices.at(corner[1]),
               r = mesh.vertices.at(corner[2]);
    ASSERT_GT(cross(q - p, r - p), 0.0) << "triangle " << t;
    for (int side = 0; side < 3; ++side) {
      used[corner[side]] = true;
      const Index e = mesh.triangle_edges[t][side];
      ASSERT_GE(e, 0);
      ASSERT_LT(e, mesh.edge_count());
      ++uses[e];
      const Edge& edge = mesh.edges[e];
      const int face = edge.triangle[0] == t ? 0 : 1;
      ASSERT_EQ(edge.triangle[face], t);
      ASSERT_EQ(edge.side[face], side);
      // Face a sees the edge from vertex[0] to vertex[1], face b the other way round.
      ASSERT_EQ(corner[side], edge.vertex[face]);
      ASSERT_EQ(corner[(side + 1) % 3], edge.vertex[1 - face]);
    }
  }
  for (Index e = 0; e < mesh.edge_count(); ++e) {
    const Edge& edge = mesh.edges[e];
    const bool boundary = edge.triangle[1] < 0;
    ASSERT_EQ(uses[e], boundary ? 1 : 2) << "edge " << e;
    ASSERT_EQ(edge.kind == EdgeKind::interior, !boundary) << "edge " << e;
    ASSERT_EQ(edge.side[1] < 0, boundary) << "edge " << e;
  }
  for (Index v = 0; v < mesh.vertex_count(); ++v) ASSERT_TRUE(used[v]) << "vertex " << v;
}

Index euler_number(const Mesh& mesh) {
  return mesh.vertex_count() - mesh.edge_count() + mesh.triangle_count();
}

double area(const Mesh& mesh) {
  double sum = 0.0;
  for (const auto& [p, q, r] : mesh.triangles) {
    sum += 0.5 * cross(mesh.vertices[q] - mesh.vertices[p], mesh.vertices[r] - mesh.vertices[p]);
  }
  return sum;
}

std::uint64_t checksum(const Mesh& mesh) {
  std::uint64_t sum = 14695981039346656037u;
  const auto add = [&](std::uint64_t bits) {
    for (int byte = 0; byte < 8; ++byte) sum = (sum ^ (bits >> (8 * byte) & 0xff)) * 1099511628211u;
  };
  for (const Vec2 p : mesh.vertices) {
    add(std::bit_cast<std::uint64_t>(p.x));
    add(std::bit_cast<std::uint64_t>(p.y));
  }
  for (const auto& triangle : mesh.triangles) {
    for (const Index v : triangle) add(static_cast<std::uint64_t>(v));
  }
  return sum;
}

MeshRecipe small_recipe(const std::string& generator) {
  MeshRecipe recipe;
  recipe.generator = generator;
  recipe.width = recipe.height = 1.0;
  recipe.wellbore_diameter = 0.1;
  recipe.size_fine = 0.01;
  recipe.fine_radius = 0.1;
  recipe.size_coarse = 0.05;
  return recipe;
}

std::string mesh_error(const std::function<void()>& action) {
  try {
    action();
  } catch (const MeshError& error) {
    const std::string message = error.what();
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    return message;
  }
  ADD_FAILURE() << "no MeshError";
  return {};
}

}  // namespace crackle::test
