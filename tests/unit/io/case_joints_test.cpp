// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "crackle/io/case.hpp"

namespace crackle {
namespace {

constexpr double degree = std::numbers::pi / 180.0;

Case read(const std::string& joints) {
  return parse_case("include = \"good.toml\"\n" + joints,
                    CRACKLE_SOURCE_DIR "/tests/unit/io/bad_cases/case.toml");
}

TEST(CaseJoints, AFrictionalJointTakesItsDefaultsFromRockAndContact) {
  const Case scene = read(R"(
[contact]
tangential_penalty = "30 GPa"
friction_angle = "35 deg"
[cohesive]
penalty = "120 GPa"
[[joints]]
x1 = "0.2 m"
y1 = "-30 cm"
x2 = 0.3
y2 = "300 mm"
)");
  ASSERT_EQ(scene.joints.size(), 1u);
  const Case::Joint& joint = scene.joints[0];
  EXPECT_EQ(joint.y1, -0.3);
  EXPECT_EQ(joint.y2, 0.3);
  EXPECT_EQ(joint.law, "frictional");
  EXPECT_DOUBLE_EQ(*joint.residual_friction_angle, 35.0 * degree);
  EXPECT_EQ(joint.normal_penalty, 120e9);
  EXPECT_EQ(joint.tangential_penalty, 30e9);
  EXPECT_FALSE(joint.cohesion);
}

constexpr const char* sets = R"(
[[joints]]
x1 = 0.3
y1 = 0
x2 = 0.4
y2 = 0
law = "bonded"
tensile_strength = "1 MPa"
cohesion = "2 MPa"
friction_angle = "30 deg"
residual_friction_angle = "25 deg"
fracture_energy_mode1 = 1
fracture_energy_mode2 = "20 J/m2"
normal_penalty = "250 GPa"
[[joint_sets]]
name = "paper"
density = "320 1/m2"
length_distribution = "normal"
length_mean = "31 mm"
length_deviation = "6 mm"
length_min = "1 cm"
length_max = "6 cm"
region_radius = "0.4 m"
clear_distance = "75 mm"
seed = 7
[[joint_sets]]
density = 10
length_distribution = "power_law"
length_exponent = 2.5
length_min = 0.1
length_max = 1
orientation = "von_mises"
angle = "30 deg"
concentration = 12
region_x_min = 0
[[joint_sets]]
density = 1
length_mean = 1
orientation = "constant"
angle = "-45 deg"
[[joint_sets]]
density = 1
length_distribution = "lognormal"
length_mean = 1
length_deviation = 0.5
)";

TEST(CaseJoints, SetsOfAllKinds) {
  const Case scene = read(sets);
  EXPECT_EQ(scene.joints[0].fracture_energy_mode2, 20.0);
  ASSERT_EQ(scene.joint_sets.size(), 4u);
  const Case::JointSet& paper = scene.joint_sets[0];
  EXPECT_EQ(paper.density, 320.0);
  EXPECT_EQ(paper.length_deviation, 0.006);
  EXPECT_EQ(paper.orientation, "uniform");
  EXPECT_EQ(paper.seed, 7u);
  EXPECT_FALSE(paper.region_x_min);
  const Case::JointSet& second = scene.joint_sets[1];
  EXPECT_EQ(second.name, "set2");
  EXPECT_EQ(second.seed, 2u);
  EXPECT_DOUBLE_EQ(*second.angle, 30.0 * degree);
  EXPECT_EQ(second.region_x_min, 0.0);
  EXPECT_EQ(second.region_x_max, 2.5);
  EXPECT_EQ(second.region_y_min, -2.5);
}

TEST(CaseJoints, ResolvedReadsBackToTheSameText) {
  const std::string text = resolved_toml(read(sets));
  EXPECT_EQ(resolved_toml(parse_case(text, "resolved.toml")), text);
}

TEST(CaseJoints, ResolvedReadsBackBesideAMeshFile) {
  const std::string text =
      resolved_toml(read("[mesh]\nfile = \"good.toml\"\n[[joint_sets]]\nname = \"a\"\n[[joint_sets]]\n"));
  EXPECT_EQ(resolved_toml(parse_case(text, "resolved.toml")), text);
}

TEST(CaseJoints, ACsvFileLiesBesideTheCase) {
  const Case scene = read("[[joint_sets]]\nfile = \"joints.txt\"\n");
  EXPECT_EQ(scene.joint_sets[0].file, CRACKLE_SOURCE_DIR "/tests/unit/io/bad_cases/joints.txt");
  const std::string text = resolved_toml(scene);
  EXPECT_EQ(resolved_toml(parse_case(text, "resolved.toml")), text);
}

TEST(CaseJoints, OverridesReachIntoRows) {
  const Case scene = parse_case("include = \"good.toml\"\n" + std::string(sets),
                                CRACKLE_SOURCE_DIR "/tests/unit/io/bad_cases/case.toml",
                                {"joint_sets.0.seed=8", "joints.0.x2=0.5 m"});
  EXPECT_EQ(scene.joint_sets[0].seed, 8u);
  EXPECT_EQ(scene.joints[0].x2, 0.5);
}

}  // namespace
}  // namespace crackle
