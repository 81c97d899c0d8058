// SPDX-License-Identifier: GPL-3.0-or-later
//
// Places that cannot be written to, or must not be. Tests may run as root, who may write anywhere
// but below a file and in /proc.
#include "binary.hpp"

namespace crackle_test {
namespace {

namespace fs = std::filesystem;

using BadFolder = CliTest;

TEST_F(BadFolder, OutputFolderIsAFile) {
  const std::string file = write("good.toml", good_case);
  write("out", "a file");
  expect_refusal(crackle({"run", file, "-q", "-o", path("out")}), 2, "out: the output folder is a file");
  expect_refusal(crackle({"run", file, "-q", "-o", path("out/below")}), 2, "cannot create the output folder");
  EXPECT_EQ(read_text(path("out")), "a file");
}

TEST_F(BadFolder, OutputFolderCannotBeMade) {
  const std::string file = write("good.toml", good_case);
  expect_refusal(crackle({"run", file, "-q", "-o", "/proc/crackle"}), 2, "cannot create the output folder");
}

TEST_F(BadFolder, OutputFolderOfAnotherRun) {
  const std::string file = write("good.toml", good_case);
  const std::vector<std::string> run{
      "run", file, "-q", "-j", "1", "-o", path("out"), "--set", "run.end_time=5us"};
  ASSERT_EQ(crackle(run).code, 0);
  const auto before = bytes_below(path("out"));
  ASSERT_TRUE(before.contains("resolved.toml"));
  expect_refusal(crackle(run), 2, "already holds a run");
  EXPECT_EQ(bytes_below(path("out")), before);
}

TEST_F(BadFolder, MeshFileCannotBeWritten) {
  const std::string file = write("good.toml", good_case);
  for (const char* name : {"/proc/a.vtu", "/proc/a.msh"}) {
    const Outcome outcome = crackle({"mesh", file, "-o", name});
    EXPECT_TRUE(outcome.code == 2 || outcome.code == 3) << outcome.err;
    EXPECT_EQ(outcome.out, "");
    expect_refusal(outcome, outcome.code, name);
  }
}

TEST_F(BadFolder, MeshFileOfUnknownFormat) {
  const std::string file = write("good.toml", good_case);
  expect_refusal(crackle({"mesh", file, "-o", path("a.stl")}), 2, "ending \".stl\"");
  EXPECT_FALSE(fs::exists(path("a.stl")));
}

TEST_F(BadFolder, CatalogOfNoRun) {
  expect_refusal(crackle({"catalog", path("none")}), 2, "no run is here");
  write("events.csv", "not, what, it, was\n");
  write("resolved.toml", good_case);
  expect_refusal(crackle({"catalog", path("")}), 2, "events.csv");
}

}  // namespace
}  // namespace crackle_test
