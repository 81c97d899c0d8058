// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>

#include <limits>

#include "crackle/mesh/mesh.hpp"
#include "mesh_checks.hpp"

namespace crackle {
namespace {

using test::mesh_error;
using testing::HasSubstr;

/// A unit square cut from lower left to upper right.
Mesh square() {
  Mesh mesh;
  mesh.vertices = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

TEST(Edges, OfTwoTriangles) {
  Mesh mesh = square();
  build_edges(mesh);
  test::expect_sound(mesh);
  ASSERT_EQ(mesh.edge_count(), 5);
  const Edge& diagonal = mesh.edges[mesh.triangle_edges[0][2]];
  EXPECT_EQ(diagonal.vertex, (std::array<Index, 2>{2, 0}));
  EXPECT_EQ(diagonal.triangle, (std::array<Index, 2>{0, 1}));
  EXPECT_EQ(diagonal.side[0], 2);
  EXPECT_EQ(diagonal.side[1], 0);
  // The normal points from face a (lower right) to face b (upper left).
  const Vec2 normal = right_normal(mesh.vertices[diagonal.vertex[1]] - mesh.vertices[diagonal.vertex[0]]);
  EXPECT_LT(normal.x, 0.0);
  EXPECT_GT(normal.y, 0.0);
}

TEST(Edges, NumberedByTheirFirstTriangle) {
  Mesh mesh = structured_rectangle({0, 0}, {3, 2}, 6, 4, MeshPattern::cross);
  for (Index e = 1; e < mesh.edge_count(); ++e) {
    EXPECT_LE(mesh.edges[e - 1].triangle[0], mesh.edges[e].triangle[0]);
  }
}

TEST(Edges, ClockwiseTrianglesAreTurnedRound) {
  Mesh mesh = square();
  mesh.triangles[1] = {0, 3, 2};
  build_edges(mesh);
  test::expect_sound(mesh);
}

TEST(Edges, RefusesWhatIsNoMesh) {
  Mesh twice = square();
  twice.triangles.push_back({0, 1, 2});
  EXPECT_THAT(mesh_error([&] { build_edges(twice); }), HasSubstr("overlap"));

  Mesh third = square();
  third.vertices.push_back({2, 0.5});
  third.triangles.push_back({0, 2, 4});
  EXPECT_THAT(mesh_error([&] { build_edges(third); }), HasSubstr("overlap"));

  Mesh flat = square();
  flat.vertices[1] = {0.5, 0.5};
  EXPECT_THAT(mesh_error([&] { build_edges(flat); }), HasSubstr("degenerate"));

  Mesh repeated = square();
  repeated.triangles[0] = {0, 1, 1};
  EXPECT_THAT(mesh_error([&] { build_edges(repeated); }), HasSubstr("degenerate"));

  Mesh beyond = square();
  beyond.triangles[1][2] = 4;
  EXPECT_THAT(mesh_error([&] { build_edges(beyond); }), HasSubstr("vertex 4"));

  Mesh not_a_number = square();
  not_a_number.vertices[3].x = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(mesh_error([&] { build_edges(not_a_number); }), HasSubstr("degenerate"));
}

}  // namespace
}  // namespace crackle
