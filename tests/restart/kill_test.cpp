// SPDX-License-Identifier: GPL-3.0-or-later
//
// Killed (SIGKILL) at random instants, 30 of them of one scene, most of them while something is being
// written, and resumed each time: what is left in the end is what an undisturbed run leaves.
#include <csignal>
#include <random>

#include "../fault.hpp"
#include "process.hpp"

namespace crackle_test {
namespace {

namespace fs = std::filesystem;

bool unfinished_file_below(const std::string& folder) {
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.path().extension() == ".tmp") return true;
  }
  return false;
}

class Kill : public CliTest {
 protected:
  // Kills runs of a case, each resumed until it is done, at so many random instants in all.
  // @param scene names it in the table of faults
  void kill_and_resume(const char* scene, const std::vector<std::string>& case_and_settings, int times);
};

TEST_F(Kill, ThirtyTimes) {
  // a checkpoint every 2 ms of wall-clock time: nearly always
  kill_and_resume("elements on all edges",
                  {write("case.toml", good_case), "--set", "run.end_time=0.7 ms", "--set",
                   "output.checkpoint_every=2 ms"},
                  30);
}

TEST_F(Kill, WithSmearedDamage) {
  kill_and_resume("smeared damage",
                  {write("case.toml", good_case), "--set", "run.end_time=0.6 ms", "--set",
                   "output.checkpoint_every=2 ms", "--set", "cohesive.insertion=none"},
                  6);
}

// Three layers with bedding along them, a slit under pressure, elements on demand.
TEST_F(Kill, LayeredAndBedded) {
  kill_and_resume(
      "layered and bedded",
      {std::string(CRACKLE_SOURCE_DIR) + "/cases/layered_block/smoke.toml", "--set",
       "rock.tensile_strength_bedding=3 MPa", "--set", "rock.cohesion_bedding=15 MPa", "--set",
       "run.end_time=0.2 ms", "--set", "output.fields_every=50 us", "--set", "output.checkpoint_every=5 ms"},
      4);
}

TEST_F(Kill, DamageInLayers) {
  kill_and_resume(
      "smeared damage in layers",
      {std::string(CRACKLE_SOURCE_DIR) + "/cases/layered_block/smoke_damage.toml", "--set",
       "run.end_time=0.2 ms", "--set", "output.fields_every=50 us", "--set", "output.checkpoint_every=5 ms"},
      4);
}

TEST_F(Kill, InFieldTime) {
  kill_and_resume("field time",
                  {std::string(CRACKLE_SOURCE_DIR) + "/cases/dfit_teaching/smoke.toml", "--set",
                   "output.checkpoint_every=2 ms"},
                  12);
}

TEST_F(Kill, InFieldTimeInLayers) {
  kill_and_resume("field time, layers and veins",
                  {std::string(CRACKLE_SOURCE_DIR) + "/cases/free_paths/smoke_layers.toml", "--set",
                   "output.checkpoint_every=2 ms"},
                  6);
}

TEST_F(Kill, LoadedNotchedBeam) {
  kill_and_resume("loaded beam",
                  {std::string(CRACKLE_SOURCE_DIR) + "/cases/three_point_bending/smoke.toml", "--set",
                   "output.checkpoint_every=1 ms"},
                  6);
}

void Kill::kill_and_resume(const char* scene, const std::vector<std::string>& case_and_settings, int times) {
  const auto arguments = [&](const std::string& folder) {
    std::vector<std::string> all{"run"};
    all.insert(all.end(), case_and_settings.begin(), case_and_settings.end());
    all.insert(all.end(), {"-q", "-j", "1", "-o", path(folder)});
    return all;
  };
  double whole_time = 0.0;
  {
    Process whole(arguments("whole"), path("process"));
    while (!whole.has_ended()) {
      whole_time = std::max(whole_time, whole.processor_time() < 1e8 ? whole.processor_time() : 0.0);
      usleep(1000);
    }
    ASSERT_EQ(whole.wait().code, 0);
  }
  std::mt19937 random(7);
  std::uniform_real_distribution<double> instant(0.05 * whole_time, 0.5 * whole_time);
  int kills = 0, before_first_checkpoint = 0, while_writing = 0, runs = 0;
  while (kills < times) {
    const std::string folder = "killed" + std::to_string(++runs);
    for (bool done = false; !done;) {
      const bool begun = fs::exists(path(folder + "/resolved.toml"));
      Process process(begun ? std::vector<std::string>{"run", "--resume", path(folder), "-q", "-j", "1"}
                            : arguments(folder),
                      path("process"));
      const double until = kills < times ? instant(random) : 1e9;
      while (!process.has_ended() && process.processor_time() < until) usleep(200);
      if (process.has_ended()) {
        const Outcome outcome = process.wait();
        ASSERT_EQ(outcome.code, 0) << outcome.err;
        done = true;
        continue;
      }
      process.signal(SIGKILL);
      process.wait();
      ++kills;
      if (!fs::exists(path(folder))) continue;
      before_first_checkpoint += !fs::exists(path(folder + "/checkpoint_a.h5"));
      while_writing += unfinished_file_below(path(folder));
      expect_readable_frames(path(folder));
    }
    expect_same_results(path(folder), path("whole"));
  }
  std::printf(
      "%d kills in %d runs, %d before the first checkpoint, %d with a file half written; lost: nothing\n",
      kills, runs, before_first_checkpoint, while_writing);
  EXPECT_TRUE(while_writing > 0 || times < 30);
  report_faults("SIGKILL at random instants, some with a file half written", kills, Left::survived, scene);
}

}  // namespace
}  // namespace crackle_test
