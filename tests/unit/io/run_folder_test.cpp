// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>

#include "crackle/io/output.hpp"
#include "sample_run.hpp"

namespace crackle::test {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::ThrowsMessage;

void put(const std::string& path, const std::string& text) { std::ofstream(path) << text; }

/// Files larger than this cannot be written while it lives: as near to a full disk as a test without
/// root comes.
class SmallFilesOnly {
 public:
  explicit SmallFilesOnly(rlim_t bytes) {
    std::signal(SIGXFSZ, SIG_IGN);
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~SmallFilesOnly() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, SIG_DFL);
  }
  SmallFilesOnly(const SmallFilesOnly&) = delete;
  SmallFilesOnly& operator=(const SmallFilesOnly&) = delete;

 private:
  rlimit before_{};
};

TEST(RunFolder, HoldsEveryFileOfAFinishedRun) {
  const ScratchFolder scratch;
  write_sample_run(scratch / "deep/er/run", 3, 1.5e-3, true);
  for (const char* name : {"resolved.toml", "history.csv", "events.csv", "events.xml", "fields.pvd",
                           "fractures.pvd", "summary.json", "run.log", "fields/fields_000000.vtu",
                           "fields/fields_000002.vtu", "fractures/fractures_000002.vtu"}) {
    EXPECT_TRUE(fs::is_regular_file(scratch / "deep/er/run/" + name)) << name;
  }
  for (const auto& entry : fs::recursive_directory_iterator(scratch / "deep")) {
    EXPECT_NE(entry.path().extension(), ".tmp") << entry.path();
  }
}

TEST(RunFolder, RefusesTheFolderOfAnotherRunAndLeavesItAlone) {
  for (const std::string name : {"resolved.toml", "history.csv"}) {
    const ScratchFolder scratch;
    fs::create_directories(scratch / "run");
    put(scratch / "run/" + name, "precious");
    EXPECT_THAT([&] { RunFolder run(scratch / "run"); },
                ThrowsMessage<CaseError>(AllOf(HasSubstr("already holds a run (" + name), HasSubstr("-o DIR"),
                                               Not(HasSubstr("\n")))));
    EXPECT_EQ(content(scratch / "run/" + name), "precious");
    EXPECT_FALSE(fs::exists(scratch / "run/run.log"));
  }
}

TEST(RunFolder, RefusesAFile) {
  const ScratchFolder scratch;
  put(scratch / "run", "precious");
  EXPECT_THAT([&] { RunFolder run(scratch / "run"); }, ThrowsMessage<CaseError>(HasSubstr("is a file")));
  EXPECT_THAT([&] { RunFolder run(scratch / "run/in"); },
              ThrowsMessage<CaseError>(HasSubstr("Not a directory")));
  EXPECT_EQ(content(scratch / "run"), "precious");
}

TEST(RunFolder, RefusesAFolderThatCannotBeWritten) {
  // nobody can write there, root neither
  EXPECT_THAT(
      [] { RunFolder run("/proc/crackle/run"); },
      ThrowsMessage<CaseError>(AllOf(HasSubstr("/proc/crackle/run: cannot create"), HasSubstr("-o DIR"))));
  if (geteuid() == 0) return;  // no permission stops root
  const ScratchFolder scratch;
  fs::create_directories(scratch / "run");
  fs::permissions(scratch / "run", fs::perms::owner_read | fs::perms::owner_exec);
  EXPECT_THAT([&] { RunFolder run(scratch / "run"); },
              ThrowsMessage<CaseError>(HasSubstr("Permission denied")));
}

TEST(RunFolder, CanBeUsedAgainWhenNothingWasWritten) {
  const ScratchFolder scratch;
  { RunFolder(scratch / "run").log("the mesh failed"); }
  write_sample_run(scratch / "run", 1, 1e-3, true);
  EXPECT_THAT(content(scratch / "run/run.log"),
              AllOf(HasSubstr("the mesh failed\n"), HasSubstr("never was\n")));
}

TEST(RunFolder, IsForOneAtATime) {
  const ScratchFolder scratch;
  {
    RunFolder first(scratch / "run");
    EXPECT_THAT([&] { RunFolder second(scratch / "run"); },
                ThrowsMessage<CaseError>(HasSubstr("run: another crackle is running in this folder")));
    first.append_history({});
  }
  EXPECT_THAT([&] { RunFolder third(scratch / "run"); },
              ThrowsMessage<CaseError>(HasSubstr("already holds a run")));
}

TEST(RunFolder, DoesNotOverwriteWhatCameMeanwhile) {
  const ScratchFolder scratch;
  RunFolder late(scratch / "run");
  put(scratch / "run/history.csv", "precious");
  EXPECT_THROW(late.append_history({}), CaseError);
  EXPECT_THROW(late.write_resolved(sample_case()), CaseError);
  EXPECT_EQ(content(scratch / "run/history.csv"), "precious");
  EXPECT_FALSE(fs::exists(scratch / "run/resolved.toml"));
}

TEST(RunFolder, NoticesThatItHasVanished) {
  const ScratchFolder scratch;
  RunFolder run(scratch / "run");
  run.append_history({});
  fs::rename(scratch / "run", scratch / "moved");
  run.append_history({});
  EXPECT_THAT([&] { run.write_frame(sample_fields(0.0), sample_fractures(0.0)); },
              ThrowsMessage<CaseError>(HasSubstr("cannot create the folder: No such file or directory")));
  fs::remove_all(scratch / "moved");
  EXPECT_THAT([&] { run.append_history({}); },
              ThrowsMessage<CaseError>(HasSubstr("history.csv: cannot write: No such file or directory")));
  EXPECT_FALSE(fs::exists(scratch / "run")) << "does not come back";
}

TEST(RunFolder, SaysThatTheDiskIsFull) {
  const ScratchFolder scratch;
  RunFolder run(scratch / "run");
  run.append_history({});
  run.write_frame(sample_fields(0.0), sample_fractures(0.0));
  const std::string listed = content(scratch / "run/fields.pvd");
  {
    const SmallFilesOnly disk(1000);
    EXPECT_THAT([&] { run.write_frame(sample_fields(1e-3), sample_fractures(1e-3)); },
                ThrowsMessage<CaseError>(
                    AllOf(HasSubstr("fields_000001.vtu: cannot write: "), Not(HasSubstr("\n")))));
    EXPECT_THAT(
        [&] {
          for (int i = 0; i < 100; ++i) run.append_history(sample_history(1e-5 * i));
        },
        ThrowsMessage<CaseError>(HasSubstr("history.csv: cannot write: File too large")));
    EXPECT_THAT(
        [&] {
          for (int i = 0; i < 100; ++i) run.append_event(sample_events(1e-1)[0]);
        },
        ThrowsMessage<CaseError>(HasSubstr("events.csv: cannot write: File too large")));
    RunSummary summary;
    summary.exit = std::string(2000, 'x');
    EXPECT_THAT([&] { run.write_summary(summary); },
                ThrowsMessage<CaseError>(HasSubstr("summary.json: cannot write: File too large")));
  }
  EXPECT_FALSE(fs::exists(scratch / "run/fields/fields_000001.vtu"));
  EXPECT_FALSE(fs::exists(scratch / "run/fields/fields_000001.vtu.tmp"));
  EXPECT_FALSE(fs::exists(scratch / "run/summary.json"));
  EXPECT_EQ(content(scratch / "run/fields.pvd"), listed);
  // and goes on once there is room
  run.write_frame(sample_fields(1e-3), sample_fractures(1e-3));
  EXPECT_THAT(content(scratch / "run/fields.pvd"), HasSubstr("timestep=\"0.001\""));
}

TEST(RunFolder, SummaryIsJson) {
  const ScratchFolder scratch;
  {
    RunFolder run(scratch / "run");
    RunSummary summary;
    summary.breakdown_pressure = 12.74e6;
    summary.triangles = 190000;
    summary.magnitude_min = summary.magnitude_max = std::numeric_limits<double>::quiet_NaN();
    summary.energy_residual_max = std::numeric_limits<double>::infinity();
    summary.exit = "stopped: \"edge\\5\"\n\tat 1 ms\x01";
    run.write_summary(summary);
  }
  EXPECT_EQ(content(scratch / "run/summary.json"), R"({
  "breakdown_pressure_Pa": 12740000,
  "breakdown_time_s": 0,
  "propagation_pressure_Pa": 0,
  "final_pressure_Pa": 0,
  "broken_length_m": 0,
  "extent_x_m": 0,
  "extent_y_m": 0,
  "energy_residual_max": null,
  "energy_inserted_J_m": null,
  "energy_path_J_m": null,
  "mass_residual_max": null,
  "triangles": 190000,
  "steps": 0,
  "wall_s": 0,
  "core_ns_per_triangle_step": 0,
  "events": 0,
  "magnitude_min": null,
  "magnitude_max": null,
  "alarms": 0,
  "unstable_allowed": false,
  "exit": "stopped: \"edge\\5\"\n\u0009at 1 ms\u0001"
}
)");
}

TEST(RunFolder, LogLinesCarryTheTime) {
  const ScratchFolder scratch;
  { RunFolder(scratch / "run").log("hello"); }
  EXPECT_THAT(content(scratch / "run/run.log"),
              testing::MatchesRegex("[0-9]+-[0-9]+-[0-9]+T[0-9]+:[0-9]+:[0-9]+Z hello\n"));
}

}  // namespace
}  // namespace crackle::test
