// SPDX-License-Identifier: GPL-3.0-or-later
//
// Disks that are full, folders that cannot be written to or are gone: a clear error, what was written
// before is whole, and the run can be resumed when there is room again.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <sched.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>

#include "../fault.hpp"
#include "process.hpp"

namespace crackle_test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class FullDisk : public CliTest {
 protected:
  FullDisk() : case_(write("case.toml", good_case)) {}
  ~FullDisk() override {
    if (mounted_) umount2(disk().c_str(), MNT_DETACH);
  }

  std::string disk() const { return path("disk"); }
  std::vector<std::string> arguments(const std::string& folder) const {
    std::vector<std::string> all{"run", case_, "-q", "-j", "1", "-o", folder};
    all.insert(all.end(), settings_.begin(), settings_.end());
    return all;
  }
  Outcome run(const std::string& folder, const std::function<void()>& prepare = {}) {
    return Process(arguments(folder), path("process"), prepare).wait();
  }
  Outcome resume(const std::string& folder) {
    return Process({"run", "--resume", folder, "-q", "-j", "1"}, path("process")).wait();
  }
  // Fills the disk while the run goes on, makes room again and resumes it.
  // @param scene names it in the table of faults
  void fill_and_go_on(const char* scene);
  // A disk of its own for this test. @return false where that is not allowed
  bool mount_disk(const char* size) {
    if (unshare(CLONE_NEWNS) != 0 || mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) != 0)
      return false;
    fs::create_directory(disk());
    mounted_ = mount("tmpfs", disk().c_str(), "tmpfs", 0, size) == 0;
    return mounted_;
  }
  bool remount(unsigned long flags, const char* size) {
    return mount("tmpfs", disk().c_str(), "tmpfs", MS_REMOUNT | flags, size) == 0;
  }

  std::string case_;
  std::vector<std::string> settings_{"--set", "run.end_time=0.7 ms",             //
                                     "--set", "output.checkpoint_every=20 ms"};  // of wall-clock time

 private:
  bool mounted_ = false;
};

void expect_refusal_to_write(const Outcome& outcome, const std::string& reason) {
  expect_refusal(outcome, 2, "cannot write: " + reason);
}

void FullDisk::fill_and_go_on(const char* scene) {
  ASSERT_EQ(run(path("whole")).code, 0);
  const std::string folder = disk() + "/run", other = disk() + "/other";
  Process process(arguments(folder), path("process"));
  ASSERT_TRUE(wait_for(folder + "/checkpoint_b.h5", process));
  process.signal(SIGSTOP);
  write("disk/other", std::string(20 << 20, 'x'));  // as much of it as there is room for
  process.signal(SIGCONT);
  expect_refusal_to_write(process.wait(), "No space left on device; free some space");
  expect_readable_frames(folder);
  fs::remove(other);
  const Outcome again = resume(folder);
  EXPECT_EQ(again.code, 0) << again.err;
  EXPECT_THAT(read_text(folder + "/run.log"), HasSubstr("resumed from checkpoint"));
  expect_same_results(folder, path("whole"));
  report_faults("disk full (a tmpfs that another file fills); resumed", 1, Left::survived, scene);
}

TEST_F(FullDisk, StopsTheRunWhichGoesOnWhenThereIsRoom) {
  if (!mount_disk("size=20m")) GTEST_SKIP() << "no right to mount";
  fill_and_go_on("elements on all edges");
}

TEST_F(FullDisk, InFieldTime) {
  if (!mount_disk("size=20m")) GTEST_SKIP() << "no right to mount";
  case_ = std::string(CRACKLE_SOURCE_DIR) + "/cases/kgd/smoke.toml";
  settings_ = {"--set", "run.end_time=10 s",           "--set", "output.fields_every=0.5 s",
               "--set", "output.checkpoint_every=5 ms"};
  fill_and_go_on("field time");
}

TEST_F(FullDisk, IsSeenBeforeTheRunStarts) {
  if (!mount_disk("size=3m")) GTEST_SKIP() << "no right to mount";
  expect_refusal(run(disk() + "/run"), 2, "the run would write");
  report_faults("disk too small for the run", 1, Left::refused);
}

TEST_F(FullDisk, ReadOnlyFolder) {
  if (!mount_disk("size=10m")) GTEST_SKIP() << "no right to mount";
  fs::create_directory(disk() + "/run");
  ASSERT_TRUE(remount(MS_RDONLY, "size=10m"));
  expect_refusal(run(disk() + "/run"), 2, "run.log: cannot create: Read-only file system");
  expect_refusal(run(disk() + "/new"), 2, "cannot create the output folder: Read-only file system");
  report_faults("read-only disk", 2, Left::refused);
}

// As with a quota: a checkpoint is larger than any file may be, everything else is not.
TEST_F(FullDisk, LimitOfFileSize) {
  ASSERT_EQ(run(path("whole")).code, 0);
  const Outcome outcome = run(path("limited"), [] {
    const rlimit limit{400000, 400000};
    setrlimit(RLIMIT_FSIZE, &limit);
  });
  expect_refusal_to_write(outcome, "File too large");
  EXPECT_THAT(outcome.err, HasSubstr("checkpoint_a.h5"));
  EXPECT_FALSE(fs::exists(path("limited/checkpoint_a.h5.tmp")));
  expect_readable_frames(path("limited"));
  EXPECT_EQ(resume(path("limited")).code, 0);
  expect_same_results(path("limited"), path("whole"));
  report_faults("limit of file size, as a quota; resumed", 1, Left::survived);
}

TEST_F(FullDisk, FolderThatVanishesAndComesBack) {
  ASSERT_EQ(run(path("whole")).code, 0);
  const auto take_away = [&] {
    fs::remove_all(path("out"));
    fs::remove_all(path("away"));
    Process process(arguments(path("out")), path("process"));
    if (!wait_for(path("out/checkpoint_b.h5"), process)) return process.wait();
    process.signal(SIGSTOP);
    fs::rename(path("out"), path("away"));
    process.signal(SIGCONT);
    return process.wait();
  };
  Outcome outcome = take_away();
  // On a busy machine the run may have come to its end before the folder went: then once more.
  for (int i = 0; i < 4 && outcome.code == 0; ++i) outcome = take_away();
  expect_refusal(outcome, 2, "No such file or directory");
  EXPECT_FALSE(fs::exists(path("out"))) << "is not made anew";
  expect_readable_frames(path("away"));
  EXPECT_EQ(resume(path("away")).code, 0);
  expect_same_results(path("away"), path("whole"));
  report_faults("folder moved away while it runs; resumed", 1, Left::survived);
}

// What is said on the terminal goes nowhere, and not into a file that is opened in its place.
TEST_F(FullDisk, TerminalThatIsFullOrClosed) {
  const std::vector<std::string> cases{case_, std::string(CRACKLE_SOURCE_DIR) + "/cases/kgd/smoke.toml"};
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const auto run_it = [&](const std::string& folder, const std::function<void()>& prepare) {
      std::vector<std::string> words{"run", cases[i], "-j", "1", "-o", path(folder)};
      if (i == 0) words.insert(words.end(), {"--set", "run.end_time=0.1 ms"});
      return Process(words, path("process"), prepare).wait().code;
    };
    const std::string number = std::to_string(i);
    ASSERT_EQ(run_it("open" + number, {}), 0);
    EXPECT_EQ(run_it("full" + number, [] { dup2(open("/dev/full", O_WRONLY), STDERR_FILENO); }), 0);
    EXPECT_EQ(run_it("closed" + number,
                     [] {
                       for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) close(stream);
                     }),
              0);
    expect_same_results(path("full" + number), path("open" + number));
    expect_same_results(path("closed" + number), path("open" + number));
  }
  const auto list = [&] { dup2(open("/dev/full", O_WRONLY), STDOUT_FILENO); };
  expect_refusal(Process({"list"}, path("process"), list).wait(), 2, "standard output: cannot write");
  report_faults("terminal full or closed: runs by explicit steps and in field time", 4, Left::survived);
}

}  // namespace
}  // namespace crackle_test
