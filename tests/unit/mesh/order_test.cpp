// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "crackle/mesh/mesh.hpp"
#include "mesh_checks.hpp"

namespace crackle {
namespace {

Vec2 centroid(const Mesh& mesh, Index t) {
  Vec2 sum;
  for (const Index v : mesh.triangles[t]) sum += (1.0 / 3.0) * mesh.vertices[v];
  return sum;
}

double mean_step(const Mesh& mesh) {
  double sum = 0.0;
  for (Index t = 1; t < mesh.triangle_count(); ++t) sum += norm(centroid(mesh, t) - centroid(mesh, t - 1));
  return sum / (mesh.triangle_count() - 1);
}

TEST(HilbertOrder, NeighboursAreNeighboursInMemory) {
  Mesh mesh = structured_rectangle({0, 0}, {64, 64}, 64, 64, MeshPattern::right);
  std::mt19937 shuffler(3);
  for (std::size_t t = mesh.triangles.size() - 1; t > 0; --t) {
    std::swap(mesh.triangles[t], mesh.triangles[shuffler() % (t + 1)]);
  }
  build_edges(mesh);
  EXPECT_GT(mean_step(mesh), 20.0);
  order_along_hilbert_curve(mesh);
  test::expect_sound(mesh);
  EXPECT_LT(mean_step(mesh), 1.5);
  Index highest = -1;  // vertices are numbered as triangles meet them
  for (const auto& triangle : mesh.triangles) {
    for (const Index v : triangle) {
      EXPECT_LE(v, highest + 1);
      highest = std::max(highest, v);
    }
  }
  const std::uint64_t once = test::checksum(mesh);
  order_along_hilbert_curve(mesh);
  EXPECT_EQ(test::checksum(mesh), once);
}

TEST(HilbertOrder, KeepsRegionsKindsAndJoints) {
  Mesh mesh = structured_rectangle({-4, -4}, {4, 4}, 8, 8, MeshPattern::cross);
  for (Index t = 0; t < mesh.triangle_count(); ++t) {
    if (norm(centroid(mesh, t)) < 1.3) mesh.regions[t] = Region::wellbore_core;
  }
  mesh = excavate(mesh);
  for (Edge& edge : mesh.edges) {
    const Vec2 p = mesh.vertices[edge.vertex[0]], q = mesh.vertices[edge.vertex[1]];
    if (p.y == 2.0 && q.y == 2.0) edge.joint = 5;
  }
  const auto count = [](const Mesh& m, auto&& what) {
    return std::count_if(m.edges.begin(), m.edges.end(), what);
  };
  const auto wall = [](const Edge& edge) { return edge.kind == EdgeKind::wellbore; };
  const auto joint = [](const Edge& edge) { return edge.joint == 5; };
  Mesh ordered = mesh;
  order_along_hilbert_curve(ordered);
  test::expect_sound(ordered);
  EXPECT_GT(count(mesh, wall), 0);
  EXPECT_EQ(count(ordered, wall), count(mesh, wall));
  EXPECT_EQ(count(ordered, joint), 8);
  for (const Edge& edge : ordered.edges) {
    const Vec2 middle = 0.5 * (ordered.vertices[edge.vertex[0]] + ordered.vertices[edge.vertex[1]]);
    EXPECT_TRUE(edge.joint != 5 || middle.y == 2.0);
    EXPECT_TRUE(edge.kind != EdgeKind::wellbore || norm(middle) < 2.0);
  }
}

}  // namespace
}  // namespace crackle
