// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>

#include "crackle/core/errors.hpp"
#include "crackle/mesh/mesh.hpp"
#include "mesh_checks.hpp"

namespace crackle {
namespace {

TEST(StructuredRectangle, FillsTheRectangle) {
  for (const auto pattern : {MeshPattern::right, MeshPattern::cross, MeshPattern::shifted_rows}) {
    for (const int ny : {1, 2, 5}) {
      const Mesh mesh = structured_rectangle({-1, 2}, {3, 5}, 7, ny, pattern);
      test::expect_sound(mesh);
      EXPECT_EQ(test::euler_number(mesh), 1);
      EXPECT_NEAR(test::area(mesh), 12.0, 1e-12);
    }
  }
  EXPECT_EQ(structured_rectangle({0, 0}, {1, 1}, 3, 2, MeshPattern::right).triangle_count(), 12);
  EXPECT_EQ(structured_rectangle({0, 0}, {1, 1}, 3, 2, MeshPattern::cross).triangle_count(), 24);
  EXPECT_EQ(structured_rectangle({0, 0}, {1, 1}, 3, 2, MeshPattern::shifted_rows).triangle_count(), 14);
  EXPECT_THROW(structured_rectangle({0, 0}, {1, 1}, 0, 2, MeshPattern::right), MeshError);
  EXPECT_THROW(structured_rectangle({0, 0}, {0, 1}, 1, 2, MeshPattern::right), MeshError);
}

TEST(StructuredRectangle, ShiftedRowsAreEquilateralInside) {
  const double height = std::sqrt(0.75);
  const Mesh mesh = structured_rectangle({0, 0}, {6, 4 * height}, 6, 4, MeshPattern::shifted_rows);
  for (const Edge& edge : mesh.edges) {
    const Vec2 p = mesh.vertices[edge.vertex[0]], q = mesh.vertices[edge.vertex[1]];
    const double middle = 0.5 * (p.x + q.x);
    if (middle < 0.5 || middle > 5.5) continue;
    EXPECT_NEAR(norm(q - p), 1.0, 1e-12);
  }
}

TEST(Jittered, MovesOnlyInsideAndKeepsMarks) {
  Mesh mesh = structured_rectangle({0, 0}, {5, 5}, 10, 10, MeshPattern::right);
  mesh.edges[40].joint = 2;
  const Mesh moved = jittered(mesh, 0.25, 4);
  test::expect_sound(moved);
  EXPECT_NEAR(test::area(moved), 25.0, 1e-12);
  int still = 0;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    const double way = norm(moved.vertices[v] - mesh.vertices[v]);
    EXPECT_LE(way, 0.25 * 0.5);
    still += way == 0.0 ? 1 : 0;
  }
  EXPECT_EQ(still, 40);  // the boundary
  EXPECT_EQ(moved.edges[40].joint, 2);
  EXPECT_EQ(test::checksum(moved), test::checksum(jittered(mesh, 0.25, 4)));
  EXPECT_NE(test::checksum(moved), test::checksum(jittered(mesh, 0.25, 5)));
}

}  // namespace
}  // namespace crackle
