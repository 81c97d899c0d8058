// SPDX-License-Identifier: GPL-3.0-or-later
//
// Cases that are wrong: every command that reads one says so in one line, and nothing is written.
#include "binary.hpp"

namespace crackle_test {
namespace {

using std::string;

class BadCase : public CliTest {
 protected:
  /// `run` and `check` refuse the case alike, and no run folder is made.
  void refused(const string& text, int code, const string& part) {
    const string file = write("bad.toml", text);
    expect_refusal(crackle({"check", file}), code, part);
    expect_refusal(crackle({"run", file, "-q", "-o", path("out")}), code, part);
    EXPECT_FALSE(std::filesystem::exists(path("out") + "/resolved.toml"));
  }
};

TEST_F(BadCase, UnknownKeyNamesTheNearest) {
  refused(with("young_modulus = \"35 GPa\"", "youngs_modulus = \"35 GPa\""), 2, "bad.toml:14:1: ");
  refused(with("young_modulus = \"35 GPa\"", "youngs_modulus = \"35 GPa\""), 2, "young_modulus");
}

TEST_F(BadCase, WrongDimension) {
  refused(with("cohesion = \"24 MPa\"", "cohesion = \"24 m\""), 2, "bad.toml:17:");
}

TEST_F(BadCase, NegativeStrength) {
  refused(with("tensile_strength = \"1 MPa\"", "tensile_strength = \"-1 MPa\""), 2, "bad.toml:16:");
}

TEST_F(BadCase, WellboreLargerThanTheDomain) {
  refused(with("diameter = \"0.1 m\"", "diameter = \"1.1 m\""), 2, "bad.toml:6:");
}

TEST_F(BadCase, FineAboveCoarse) {
  refused(with("size_fine = \"15 mm\"", "size_fine = \"15 cm\""), 2, "bad.toml:9:");
}

TEST_F(BadCase, PumpStagesOverlap) {
  refused(
      with("rate = \"130 l/s\"", "rate = \"130 l/s\"\n[[fluid.pump]]\nfrom = \"0.1 ms\"\nrate = \"1 l/s\""),
      2, "pump stages overlap");
}

TEST_F(BadCase, ZeroSteps) {
  refused(with("end_time = \"0.9 ms\"", "end_time = \"0 s\""), 2, "bad.toml:35:");
  refused(with("end_time = \"0.9 ms\"", "end_time = \"0.9 ms\"\ntime_step = \"1 s\""), 2, "time_step");
}

TEST_F(BadCase, StepThatIsNotStable) {
  refused(with("end_time = \"0.9 ms\"", "end_time = \"0.9 ms\"\ntime_step = \"0.1 ms\""), 2,
          "write \"auto\"");
}

TEST_F(BadCase, MeshThatDoesNotFitInMemory) {
  refused(with("size_fine = \"15 mm\"", "size_fine = \"1 um\""), 2, "of memory and");
  expect_refusal(crackle({"mesh", path("bad.toml"), "-o", path("a.msh")}), 2, "of memory and");
}

TEST_F(BadCase, MeshFileThatIsNotThere) {
  refused(with("size_fine = \"15 mm\"", "size_fine = \"15 mm\"\nfile = \"none.msh\""), 2, "none.msh");
}

TEST_F(BadCase, DamagedMeshFile) {
  const string text = with("size_fine = \"15 mm\"", "size_fine = \"15 mm\"\nfile = \"damaged.msh\"");
  write("damaged.msh", "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n1 9");
  refused(text, 3, "damaged.msh");
  write("damaged.msh", "");
  refused(text, 3, "damaged.msh");
  write("damaged.msh", "this is no mesh\n");
  refused(text, 3, "damaged.msh");
}

TEST_F(BadCase, ExactCalibrationOnLongEdges) {
  const string file = write("bad.toml", with("calibration = \"y_geo\"", "calibration = \"exact\""));
  expect_refusal(crackle({"check", file}), 2, "take a penalty of");
}

TEST_F(BadCase, CaseThatIsNotThere) {
  for (const char* command : {"run", "check"})
    expect_refusal(crackle({command, path("none.toml")}), 2, "none.toml");
}

TEST_F(BadCase, BadOverride) {
  const string file = write("good.toml", good_case);
  expect_refusal(crackle({"check", "--set", "rock.density=heavy", file}), 2, "--set rock.density");
  expect_refusal(crackle({"check", "--set", "rock.densty=1", file}), 2, "density");
}

TEST_F(BadCase, NumbersOfTheCommandLine) {
  const string file = write("good.toml", good_case);
  for (const char* seed : {"-1", "1.5", "1e3", "nan", "99999999999999999999", "x"})
    expect_refusal(crackle({"check", file, string("--seed=") + seed}), 2, "mesh.seed");
  for (const char* threads : {"0", "-1", "1025", "1.5", "99999999999999999999", "x"})
    expect_refusal(crackle({"run", file, "-q", "-o", path("out"), "-j", threads}), 2, "--threads");
  EXPECT_FALSE(std::filesystem::exists(path("out")));
}

// Files of other systems and places with other letters.
TEST_F(BadCase, IsNotOneForItsLettersOrLines) {
  string lines = good_case;
  for (std::size_t at = 0; (at = lines.find('\n', at)) != string::npos; at += 2) lines.replace(at, 1, "\r\n");
  std::filesystem::create_directory(path("düne 岩石"));
  ASSERT_EQ(crackle({"mesh", write("good.toml", good_case), "-o", path("good.msh")}).code, 0);
  const string mesh = read_text(path("good.msh"));
  for (const string& text : {lines, "\xef\xbb\xbf" + string(good_case)}) {
    const string file = write("düne 岩石/fälle è.toml", text), out = path("düne 岩石/netz.msh");
    EXPECT_EQ(crackle({"mesh", file, "-o", out}).code, 0);
    EXPECT_EQ(read_text(out), mesh);
    std::filesystem::remove(out);
  }
}

}  // namespace
}  // namespace crackle_test
