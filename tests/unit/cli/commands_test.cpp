// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>

#include "binary.hpp"

namespace crackle_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

TEST(CommandLine, Version) {
  const Outcome outcome = crackle({"--version"});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_THAT(outcome.out, testing::MatchesRegex("crackle [0-9]+\\.[0-9]+\\.[0-9]+\n"));
}

TEST(CommandLine, Help) {
  const Outcome outcome = crackle({"--help"});
  EXPECT_EQ(outcome.code, 0);
  for (const char* command : {"run", "check", "mesh", "law", "list", "describe", "catalog"}) {
    EXPECT_THAT(outcome.out, HasSubstr(command));
    EXPECT_EQ(crackle({command, "--help"}).code, 0);
  }
}

TEST(CommandLine, WhatItDoesNotKnow) {
  expect_refusal(crackle({}), 2, "say what to do");
  expect_refusal(crackle({"chek", "a.toml"}), 2, "did you mean \"check\"?");
  expect_refusal(crackle({"run"}), 2, "case is required");
  expect_refusal(crackle({"check", "a.toml", "--frob"}), 2, "--frob");
  expect_refusal(crackle({"run", "a.toml", "-j", "0"}), 2, "--threads");
}

TEST(List, HoldsWhatThereIs) {
  const Outcome outcome = crackle({"list"});
  EXPECT_EQ(outcome.code, 0);
  for (const char* name : {"evans_marathe", "linear", "y_geo", "exact", "all", "broken", "absorbing", "cgal",
                           "gmsh", "velocity_m_s", "quakeml", "zmap", "fluid.pump"}) {
    EXPECT_THAT(outcome.out, HasSubstr(name));
  }
}

TEST(Describe, Law) {
  const Outcome outcome = crackle({"describe", "evans_marathe"});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_THAT(outcome.out,
              AllOf(HasSubstr("0.386307"), HasSubstr("rock.fracture_energy_mode2"), HasSubstr("J/m2")));
}

TEST(Describe, TableAndCase) {
  const Outcome table = crackle({"describe", "mesh"});
  EXPECT_EQ(table.code, 0);
  EXPECT_THAT(table.out,
              AllOf(HasSubstr("size_fine"), HasSubstr("(required)"), Not(HasSubstr("young_modulus"))));
  const Outcome all = crackle({"describe", "case"});
  EXPECT_THAT(all.out, AllOf(HasSubstr("title"), HasSubstr("young_modulus"), HasSubstr("[fluid.pump]"),
                             HasSubstr("epoch")));
}

TEST(Describe, KeyAndChoice) {
  EXPECT_THAT(crackle({"describe", "rock.density"}).out, HasSubstr("kg/m3"));
  EXPECT_THAT(crackle({"describe", "absorbing"}).out, HasSubstr("boundary.outer"));
  expect_refusal(crackle({"describe", "evans"}), 2, "did you mean \"evans_marathe\"?");
}

class Commands : public CliTest {};

// Every choice that list names is one that a case may hold.
TEST_F(Commands, ListedChoicesAreAccepted) {
  const std::string file = write("good.toml", good_case);
  for (const char* choice :
       {"cohesive.law=evans_marathe", "cohesive.law=linear", "cohesive.insertion=all", "fluid.wets=broken",
        "boundary.outer=fixed", "boundary.outer=absorbing", "mesh.generator=cgal", "mesh.generator=gmsh"}) {
    EXPECT_EQ(crackle({"mesh", file, "--set", choice, "-o", path("a.vtu")}).code, 0) << choice;
  }
}

TEST_F(Commands, MeshAndBack) {
  const std::string file = write("good.toml", good_case);
  const Outcome made = crackle({"mesh", file, "-o", path("a.msh")});
  ASSERT_EQ(made.code, 0) << made.err;
  EXPECT_THAT(made.out,
              AllOf(HasSubstr("triangles"), HasSubstr("wellbore core"), HasSubstr("smallest angle")));
  // The file in place of the recipe: the same mesh comes out again.
  const std::string from_file =
      write("file.toml", with("size_fine = \"15 mm\"", "size_fine = \"15 mm\"\nfile = \"a.msh\""));
  const Outcome again = crackle({"mesh", from_file, "-o", path("b.msh")});
  ASSERT_EQ(again.code, 0) << again.err;
  const auto counts = [](const std::string& text) {
    const std::size_t from = text.find(": ");
    return text.substr(from, text.find('\n') - from);
  };
  EXPECT_EQ(counts(made.out), counts(again.out));
  EXPECT_EQ(read_text(path("a.msh")), read_text(path("b.msh")));
}

TEST_F(Commands, MeshShowsTheJoints) {
  const std::string file = write("joints.toml", std::string(good_case) + R"(
[[joints]]
x1 = "0.2 m"
y1 = "-0.2 m"
x2 = "0.2 m"
y2 = "0.2 m"
[[joint_sets]]
name = "mapped"
file = "mapped.csv"
)");
  write("mapped.csv", "x1_m,y1_m,x2_m,y2_m\n0.1,0.1,0.3,0.1\n-0.3,-0.2,-0.1,-0.3\n");
  const Outcome drawn = crackle({"mesh", file, "-o", path("a.vtu")});
  ASSERT_EQ(drawn.code, 0) << drawn.err;
  EXPECT_THAT(drawn.out, AllOf(HasSubstr("3 joints: 3 in the mesh"), HasSubstr("1 junctions"),
                               HasSubstr("a_joints.vtu")));
  EXPECT_THAT(read_text(path("a_joints.vtu")), HasSubstr("joint_set"));
  ASSERT_EQ(crackle({"mesh", file, "-o", path("a.msh")}).code, 0);
  EXPECT_THAT(read_text(path("a.msh")),
              AllOf(HasSubstr("joint_joint1_000000"), HasSubstr("joint_mapped_000001")));
  EXPECT_THAT(crackle({"check", "-j", "1", file}).out, HasSubstr("3 joints: 3 in the mesh"));
  write("mapped.csv", "x1_m,y1_m,x2_m,y2_m\n0.1,0.1,0.3\n");
  expect_refusal(crackle({"mesh", file, "-o", path("a.vtu")}), 2, "mapped.csv:2: this row has 3 columns");
}

TEST_F(Commands, ARunWithJoints) {
  const std::string text = with("end_time = \"0.9 ms\"", "end_time = \"0.05 ms\"") + R"(
[[joints]]
x1 = "0.1 m"
y1 = "-0.1 m"
x2 = "0.2 m"
y2 = "0.2 m"
residual_friction_angle = "30 deg"
[[joints]]
x1 = "-0.1 m"
y1 = "-0.1 m"
x2 = "-0.2 m"
y2 = "0.2 m"
law = "bonded"
tensile_strength = "1 MPa"
cohesion = "5 MPa"
friction_angle = "30 deg"
fracture_energy_mode1 = "5 J/m2"
fracture_energy_mode2 = "50 J/m2"
)";
  for (const char* insertion : {"all", "on_demand"}) {
    const std::string out = path(insertion);
    const Outcome ran = crackle({"run", write("joints.toml", text), "-o", out, "-q", "-j", "1", "--set",
                                 std::string("cohesive.insertion=") + insertion});
    ASSERT_EQ(ran.code, 0) << ran.err;
    EXPECT_THAT(read_text(out + "/run.log"), HasSubstr("2 joints: 2 in the mesh"));
  }
}

TEST_F(Commands, JointsOfAMeshFileAreKnownByTheirSet) {
  const std::string file = write(
      "good.toml", std::string(good_case) + "[[joint_sets]]\nname = \"bedding\"\nfile = \"bedding.csv\"\n");
  write("bedding.csv", "x1_m,y1_m,x2_m,y2_m\n0.1,0.1,0.3,0.1\n");
  ASSERT_EQ(crackle({"mesh", file, "-o", path("a.msh")}).code, 0);
  const std::string from_file = with("size_fine = \"15 mm\"", "size_fine = \"15 mm\"\nfile = \"a.msh\"");
  expect_refusal(crackle({"check", write("b.toml", from_file)}), 2,
                 "has joints of the set \"bedding\": say how");
  for (const char* set : {"[[joint_sets]]\nname = \"bedding\"\n", "[[joint_sets]]\n"}) {
    EXPECT_EQ(crackle({"check", "-j", "1", write("b.toml", from_file + set)}).code, 0) << set;
  }
}

TEST_F(Commands, LayersAreMeshedAndRun) {
  const std::string text = with("end_time = \"0.9 ms\"", "end_time = \"0.05 ms\"") + R"(
[[layers]]
bottom = "0.1 m"
top = "0.25 m"
young_modulus = "20 GPa"
stress_xx = "-3 MPa"
[[layers]]
top = "-0.15 m"
dip = "10 deg"
young_modulus = "50 GPa"
tensile_strength = "2 MPa"
)";
  const std::string file = write("layers.toml", text);
  const Outcome drawn = crackle({"mesh", file, "-o", path("a.vtu")});
  ASSERT_EQ(drawn.code, 0) << drawn.err;
  EXPECT_THAT(drawn.out, AllOf(HasSubstr("in layers.0"), HasSubstr("in layers.1")));
  EXPECT_THAT(read_text(path("a.vtu")), HasSubstr("layer"));
  EXPECT_THAT(crackle({"check", "-j", "1", file}).out, HasSubstr("layers.1.young_modulus"));
  const std::string bonded = R"(interface = "bonded"
interface_tensile_strength = "1 MPa"
interface_cohesion = "5 MPa"
interface_friction_angle = "30 deg"
interface_fracture_energy_mode1 = "2 J/m2"
interface_fracture_energy_mode2 = "20 J/m2"
)";
  for (const char* insertion : {"all", "on_demand", "none"}) {
    for (const std::string& interface : {std::string(), bonded}) {
      const std::string out = path(insertion + std::to_string(interface.size()));
      const Outcome ran = crackle({"run", write("layers.toml", text + interface), "-o", out, "-q", "-j", "1",
                                   "--set", std::string("cohesive.insertion=") + insertion});
      ASSERT_EQ(ran.code, 0) << ran.err;
      EXPECT_THAT(read_text(out + "/resolved.toml"), HasSubstr("[[layers]]"));
    }
  }
  // the same layers in a mesh from a file, which follows them; and in one that does not
  ASSERT_EQ(crackle({"mesh", write("layers.toml", text), "-o", path("a.msh")}).code, 0);
  ASSERT_EQ(crackle({"mesh", write("plain.toml", good_case), "-o", path("b.msh")}).code, 0);
  const auto from = [&](const char* mesh) {
    std::string moved = text;
    const std::string size = "size_fine = \"15 mm\"";
    moved.replace(moved.find(size), size.size(), size + "\nfile = \"" + mesh + "\"");
    return crackle({"check", "-j", "1", write("file.toml", moved)});
  };
  EXPECT_THAT(from("a.msh").out, HasSubstr("in layers.1"));
  expect_refusal(from("b.msh"), 3, "on both sides of an interface of layers.");
  expect_refusal(crackle({"check", write("over.toml", text + "[[layers]]\nbottom = \"0.2 m\"\n")}), 3,
                 "layers.0 and layers.2 overlap");
  expect_refusal(crackle({"check", write("far.toml", text + "[[layers]]\nbottom = \"20 m\"\n")}), 3,
                 "layers.2 has no triangle");
}

TEST_F(Commands, MeshFollowsItsSeed) {
  const std::string file = write("good.toml", good_case);
  for (const char* seed : {"1", "2"}) {
    ASSERT_EQ(crackle({"mesh", file, "--seed", seed, "-o", path(std::string(seed) + ".vtu")}).code, 0);
  }
  ASSERT_EQ(crackle({"mesh", file, "-o", path("default.vtu")}).code, 0);
  EXPECT_EQ(read_text(path("1.vtu")), read_text(path("default.vtu")));
  EXPECT_NE(read_text(path("1.vtu")), read_text(path("2.vtu")));
}

TEST_F(Commands, CheckSaysWhatARunWouldBe) {
  const std::string file = write("good.toml", good_case);
  const Outcome outcome = crackle({"check", "-j", "1", file});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  for (const char* part :
       {"rock.young_modulus", "3.5e+10 Pa (35 GPa)", "0.663225 rad (38 deg)", "fluid.pump.0.rate",
        "0.13 m2/s", "triangles", "cohesive element", "smallest angle", "stable step", "steps of", "memory",
        "in 21 frames", "wall time about", "Hubbert-Willis", "E' = 6", "mode II",
        "too few for the stress at its wall", "lower bounds"}) {
    EXPECT_THAT(outcome.out, HasSubstr(part));
  }
}

}  // namespace
}  // namespace crackle_test
