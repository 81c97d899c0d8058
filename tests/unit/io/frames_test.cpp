// SPDX-License-Identifier: GPL-3.0-or-later
// Frames as others read them: python3-vtk9 (ParaView's reader) and meshio, in read_frames.py; and the
// figures that are drawn from them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "crackle/io/output.hpp"
#include "sample_run.hpp"

namespace crackle::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr int modules_missing = 77;

/// Exit status of a Python script of the source tree.
int run_python(const std::string& script, const std::string& arguments) {
  const std::string command = "/usr/bin/python3 " CRACKLE_SOURCE_DIR "/" + script + " " + arguments;
  const int status = std::system(command.c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

TEST(Frames, AreReadByVtkAndMeshio) {
  const ScratchFolder scratch;
  write_sample_run(scratch / "run", 4, 1.5e-3, true);
  const int status = run_python("tests/unit/io/read_frames.py", scratch / "run");
  if (status == modules_missing) GTEST_SKIP() << "python3-vtk9 or python3-meshio is not installed";
  EXPECT_EQ(status, 0);
}

TEST(Frames, RefuseAFieldOfAnotherSize) {
  const ScratchFolder scratch;
  FieldFrame frame = sample_fields(0.0);
  frame.cell_fields[0].values.pop_back();
  EXPECT_THROW(write_vtu(scratch / "frame.vtu", frame), std::invalid_argument);
  EXPECT_THAT([&] { write_vtu(scratch / "no/such/folder.vtu", sample_fields(0.0)); },
              ThrowsMessage<CaseError>(HasSubstr("No such file or directory")));
}

class Figures : public testing::Test {
 protected:
  void expect_figures(const std::string& run) {
    const int status = run_python("scripts/plots/draw_run.py", run);
    if (status == modules_missing) GTEST_SKIP() << "python3-vtk9 or python3-matplotlib is not installed";
    EXPECT_EQ(status, 0);
    for (const char* name : {"pressure.png", "fractures.png", "events.png"}) {
      EXPECT_GT(fs::file_size(run + "/" + name), 5000U) << name;
    }
  }
  ScratchFolder scratch_;
};

TEST_F(Figures, OfAFinishedRun) {
  write_sample_run(scratch_ / "run", 8, 2e-3, true);
  expect_figures(scratch_ / "run");
}

TEST_F(Figures, OfARunWithoutFractures) {
  write_sample_run(scratch_ / "run", 3, 0.5e-3, true);
  expect_figures(scratch_ / "run");
}

TEST_F(Figures, OfARunThatWasInterrupted) {
  write_sample_run(scratch_ / "run", 5, 1.2e-3, false);
  expect_figures(scratch_ / "run");
}

TEST_F(Figures, OfASingleFrame) {
  write_sample_run(scratch_ / "run", 1, 1e-3, false);
  expect_figures(scratch_ / "run");
}

}  // namespace
}  // namespace crackle::test
