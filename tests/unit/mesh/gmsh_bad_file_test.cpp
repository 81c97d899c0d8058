// SPDX-License-Identifier: GPL-3.0-or-later
// Files from other programs, as text of format 2.2: what is repaired, and what is refused and how.
#include <gmock/gmock.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "crackle/mesh/mesh.hpp"
#include "mesh_checks.hpp"

namespace crackle {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class GmshBadFile : public testing::Test {
 protected:
  void write(const std::string& text) const { std::ofstream(path_, std::ios::binary) << text; }
  std::string refusal() const {
    return test::mesh_error([&] { read_gmsh(path_); });
  }
  Mesh read(const std::string& text) const {
    write(text);
    Mesh mesh = read_gmsh(path_);
    test::expect_sound(mesh);
    return mesh;
  }
  void TearDown() override { std::filesystem::remove(path_); }

  std::string path_ =
      (std::filesystem::temp_directory_path() / ("crackle_bad_" + std::to_string(::getpid()) + ".msh"))
          .string();
};

/// A file of format 2.2 from lines of nodes ("tag x y z") and elements
/// ("tag type 2 physical entity nodes").
std::string file(const std::vector<std::string>& nodes, const std::vector<std::string>& elements,
                 const std::vector<std::string>& names = {}) {
  std::ostringstream text;
  text << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";
  const auto section = [&](const char* name, const std::vector<std::string>& lines) {
    text << "$" << name << "\n" << lines.size() << "\n";
    for (const auto& line : lines) text << line << "\n";
    text << "$End" << name << "\n";
  };
  if (!names.empty()) section("PhysicalNames", names);
  section("Nodes", nodes);
  section("Elements", elements);
  return text.str();
}

const std::vector<std::string> corners{"1 0 0 0", "2 1 0 0", "3 1 1 0", "4 0 1 0"};
const std::vector<std::string> halves{"1 2 2 1 1 1 2 3", "2 2 2 1 1 1 3 4"};

TEST_F(GmshBadFile, ReadsTheGoodOne) {
  const Mesh mesh = read(file(corners, halves));
  EXPECT_EQ(mesh.triangle_count(), 2);
  EXPECT_EQ(mesh.edge_count(), 5);
}

TEST_F(GmshBadFile, DropsUnusedVerticesAndTurnsTriangles) {
  const Mesh mesh = read(
      file({"1 0 0 0", "7 5 5 0", "2 1 0 0", "3 1 1 0", "4 0 1 0"}, {"1 2 2 1 1 1 3 2", "2 2 2 1 1 1 3 4"}));
  EXPECT_EQ(mesh.vertex_count(), 4);
  EXPECT_NEAR(test::area(mesh), 1.0, 1e-15);
}

TEST_F(GmshBadFile, NumbersJointsByTheirNames) {
  const Mesh mesh = read(
      file(corners, {"1 1 2 5 1 1 3", "2 1 2 6 2 2 3", "3 1 2 7 3 3 4", "8 2 2 9 1 1 2 3", "9 2 2 8 2 1 3 4"},
           {"1 5 \"joint10\"", "1 6 \"joint2\"", "1 7 \"other\"", "2 8 \"wellbore_core\""}));
  EXPECT_EQ(mesh.edges[mesh.triangle_edges[0][2]].joint, 1);   // joint10, the diagonal
  EXPECT_EQ(mesh.edges[mesh.triangle_edges[0][1]].joint, 0);   // joint2
  EXPECT_EQ(mesh.edges[mesh.triangle_edges[1][1]].joint, -1);  // no joint
  EXPECT_EQ(mesh.regions[0], Region::rock);
  EXPECT_EQ(mesh.regions[1], Region::wellbore_core);
}

TEST_F(GmshBadFile, ReadsTheSetOfAJointFromItsName) {
  const Mesh mesh = read(
      file(corners, {"1 1 2 5 1 1 3", "2 1 2 6 2 2 3", "3 1 2 7 3 3 4", "8 2 2 9 1 1 2 3", "9 2 2 8 2 1 3 4"},
           {"1 5 \"joint_set_2_7\"", "1 6 \"joint_fault\"", "1 7 \"joint12\""}));
  EXPECT_EQ(mesh.joint_sets, (std::vector<std::string>{"fault", "set_2", ""}));
  EXPECT_EQ(mesh.set_of_joint, (std::vector<Index>{0, 1, 2}));
  EXPECT_EQ(mesh.edges[mesh.triangle_edges[0][2]].joint, 1);  // the diagonal
}

TEST_F(GmshBadFile, MissingEmptyOrNoMesh) {
  EXPECT_THAT(refusal(), AllOf(HasSubstr(path_), HasSubstr("cannot be read")));
  write("");
  EXPECT_THAT(refusal(), HasSubstr("empty"));
  write("SetFactory(\"OpenCASCADE\");\nDisk(1) = {0, 0, 0, 1};\n");
  EXPECT_THAT(refusal(), HasSubstr("no gmsh mesh file"));
}

TEST_F(GmshBadFile, CutOff) {
  const std::string whole = file(corners, halves);
  for (std::size_t length = 12; length + 20 < whole.size(); length += 7) {
    write(whole.substr(0, length));
    EXPECT_THAT(refusal(), HasSubstr(path_)) << whole.substr(0, length);
  }
}

TEST_F(GmshBadFile, BinaryCutOff) {
  write_gmsh(structured_rectangle({0, 0}, {1, 1}, 3, 3, MeshPattern::right), path_);
  const auto size = std::filesystem::file_size(path_);
  for (const double share : {0.2, 0.5, 0.7, 0.85, 0.95}) {
    write_gmsh(structured_rectangle({0, 0}, {1, 1}, 3, 3, MeshPattern::right), path_);
    std::filesystem::resize_file(path_, static_cast<std::uintmax_t>(share * static_cast<double>(size)));
    EXPECT_THAT(refusal(), HasSubstr(path_)) << share;
  }
}

TEST_F(GmshBadFile, NoTrianglesOrOthersToo) {
  write(file(corners, {"1 1 2 1 1 1 2"}));
  EXPECT_THAT(refusal(), HasSubstr("no triangles"));
  write(file(corners, {"1 3 2 1 1 1 2 3 4"}));
  EXPECT_THAT(refusal(), HasSubstr("straight triangles only"));
  write(file({"1 0 0 0", "2 1 0 0", "3 0 1 0", "4 0 0 1"}, {"1 4 2 1 1 1 2 3 4"}));
  EXPECT_THAT(refusal(), HasSubstr("plane"));
}

TEST_F(GmshBadFile, NotPlaneOrNotFinite) {
  write(file({"1 0 0 0", "2 1 0 0", "3 1 1 0.5", "4 0 1 0"}, halves));
  EXPECT_THAT(refusal(), HasSubstr("differ in z"));
  write(file({"1 0 0 0", "2 1 0 0", "3 nan 1 0", "4 0 1 0"}, halves));
  EXPECT_THAT(refusal(), HasSubstr(path_));
}

TEST_F(GmshBadFile, BadTopology) {
  const std::vector<std::string> five{"1 0 0 0", "2 1 0 0", "3 1 1 0", "4 0 1 0", "5 3 1 0"};
  write(file(five, {halves[0], halves[1], "3 2 2 1 1 1 5 3"}));
  EXPECT_THAT(refusal(), HasSubstr("overlap"));
  write(file(corners, {halves[0], "2 2 2 1 1 1 3 9"}));
  EXPECT_THAT(refusal(), HasSubstr(path_));
  write(file({"1 0 0 0", "2 1 0 0", "3 1 1 0", "4 0 1 0", "5 1 1 0"}, {halves[0], "2 2 2 1 1 1 5 4"}));
  EXPECT_THAT(refusal(), HasSubstr("two nodes at (1, 1)"));
  write(file({"1 0 0 0", "2 1 0 0", "3 2 0 0", "4 0 1 0"}, halves));
  EXPECT_THAT(refusal(), HasSubstr("degenerate"));
}

TEST_F(GmshBadFile, AJointThatIsNoEdge) {
  write(file(corners, {"1 1 2 5 1 2 4", "2 2 2 1 1 1 2 3", "3 2 2 1 1 1 3 4"}, {"1 5 \"joint\""}));
  EXPECT_THAT(refusal(), HasSubstr("no edges"));
}

}  // namespace
}  // namespace crackle
