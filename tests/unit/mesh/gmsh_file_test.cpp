// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "crackle/core/errors.hpp"
#include "crackle/mesh/mesh.hpp"
#include "mesh_checks.hpp"

namespace crackle {
namespace {

std::string scratch(const std::string& name) {
  return (std::filesystem::temp_directory_path() / ("crackle_" + std::to_string(::getpid()) + "_" + name))
      .string();
}

void expect_same(const Mesh& read, const Mesh& written) {
  test::expect_sound(read);
  ASSERT_EQ(read.vertices, written.vertices);  // to the last bit
  ASSERT_EQ(read.triangles, written.triangles);
  EXPECT_EQ(read.regions, written.regions);
  EXPECT_EQ(read.set_of_joint, written.set_of_joint);
  EXPECT_EQ(read.joint_sets, written.joint_sets);
  ASSERT_EQ(read.edge_count(), written.edge_count());
  for (Index e = 0; e < read.edge_count(); ++e) {
    EXPECT_EQ(read.edges[e].vertex, written.edges[e].vertex);
    EXPECT_EQ(read.edges[e].joint, written.edges[e].joint);
    EXPECT_EQ(read.edges[e].kind, written.edges[e].kind);
  }
}

void expect_round_trip(const Mesh& mesh) {
  const std::string path = scratch("round_trip.msh");
  write_gmsh(mesh, path);
  expect_same(read_gmsh(path), mesh);
  std::filesystem::remove(path);
}

TEST(GmshFile, RoundTripIsExact) {
  MeshRecipe recipe = test::small_recipe();
  recipe.joints = {{{0.1, 0.1}, {0.4, 0.4}}, {{0.1, 0.4}, {0.4, 0.1}}, {{-0.3, 0}, {0.3, 0}}};
  expect_round_trip(generate_mesh(recipe));
  recipe.joint_sets = {"bedding", "set_2", "north-fault"};
  recipe.joints = {{{0.1, 0.1}, {0.4, 0.4}, 0},
                   {{0.1, 0.4}, {0.4, 0.1}, 1},
                   {{9.0, 9.0}, {9.5, 9.0}, 1},  // outside: keeps its number
                   {{-0.3, 0}, {0.3, 0}, 0},
                   {{-0.3, 0.2}, {0.3, 0.3}, 2}};
  const Mesh mesh = generate_mesh(recipe);
  expect_round_trip(mesh);
  expect_round_trip(excavate(mesh));
  expect_round_trip(structured_rectangle({0, 0}, {1, 1}, 2, 2, MeshPattern::cross));
}

TEST(GmshFile, CommittedMesh) {
  const Mesh mesh = read_gmsh(CRACKLE_SOURCE_DIR "/meshes/wellbore_small.msh");
  test::expect_sound(mesh);
  EXPECT_NEAR(test::area(mesh), 1.0, 1e-12);
  EXPECT_GE(measure_quality(mesh, nullptr).min_angle_deg, 30.0);
  const Mesh rock = excavate(mesh);
  EXPECT_EQ(test::euler_number(rock), 0);
}

TEST(GmshFile, SaysWhereItCannotWrite) {
  const Mesh mesh = structured_rectangle({0, 0}, {1, 1}, 1, 1, MeshPattern::right);
  EXPECT_NE(test::mesh_error([&] { write_gmsh(mesh, "/no/such/folder/a.msh"); }).find("/no/such/folder"),
            std::string::npos);
  EXPECT_NE(test::mesh_error([&] { write_gmsh(mesh, scratch("mesh.txt")); }).find(".msh"), std::string::npos);
}

TEST(GmshFile, PrintsNothing) {
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  generate_mesh(test::small_recipe("gmsh"));
  expect_round_trip(structured_rectangle({0, 0}, {1, 1}, 2, 2, MeshPattern::right));
  EXPECT_THROW(read_gmsh("/no/such/file.msh"), MeshError);
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace crackle
