// SPDX-License-Identifier: GPL-3.0-or-later
//
// A run that was interrupted and resumed leaves the same bytes as one that was not.
#include <gmock/gmock.h>
#include <sys/stat.h>

#include <csignal>
#include <fstream>
#include <sstream>

#include "../fault.hpp"
#include "crackle/io/checkpoint.hpp"
#include "crackle/state/members.hpp"
#include "process.hpp"

namespace crackle_test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

constexpr const char* sigterm = "SIGTERM while it breaks or grows; resumed with 1 and 2 threads";
constexpr const char* unusable = "no checkpoint that can be used";

class Resume : public CliTest {
 protected:
  Resume() { write("case.toml", good_case); }

  std::vector<std::string> arguments(const std::string& folder, const std::vector<std::string>& more = {}) {
    std::vector<std::string> all{"run",
                                 path("case.toml"),
                                 "-q",
                                 "-j",
                                 "1",
                                 "-o",
                                 path(folder),
                                 "--set",
                                 "run.end_time=0.75 ms",
                                 "--set",
                                 "output.checkpoint_every=0 s"};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  Outcome run(const std::string& folder, const std::vector<std::string>& more = {}) {
    return Process(arguments(folder, more), path("process")).wait();
  }
  Outcome resume(const std::string& folder, const std::string& threads = "1") {
    return Process({"run", "--resume", path(folder), "-q", "-j", threads}, path("process")).wait();
  }
  // Stops a run when a frame has appeared.
  Outcome interrupted(Process& process, const std::string& folder, int frame) {
    const std::string number = std::to_string(frame);
    EXPECT_TRUE(wait_for(
        path(folder + "/fields/fields_" + std::string(6 - number.size(), '0') + number + ".vtu"), process));
    process.signal(SIGTERM);
    return process.wait();
  }
  Outcome interrupted_run(const std::string& folder, int frame, const std::vector<std::string>& more = {}) {
    Process process(arguments(folder, more), path("process"));
    return interrupted(process, folder, frame);
  }
  Outcome interrupted_resume(const std::string& folder, int frame, const std::string& threads) {
    Process process({"run", "--resume", path(folder), "-q", "-j", threads}, path("process"));
    return interrupted(process, folder, frame);
  }
  void flip_a_bit(const std::string& name) {
    std::string bytes = read_text(path(name));
    bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 1);
    write(name, bytes);
  }
};

// In the middle of breaking, twice, with one thread and with two.
TEST_F(Resume, LeavesTheSameBytes) {
  ASSERT_EQ(run("whole").code, 0);
  EXPECT_EQ(interrupted_run("parts", 4).code, 75);
  EXPECT_THAT(read_text(path("parts/summary.json")), HasSubstr("\"interrupted\""));
  EXPECT_EQ(interrupted_resume("parts", 15, "2").code, 75);
  const std::string events = read_text(path("parts/events.csv"));
  EXPECT_GT(std::count(events.begin(), events.end(), '\n'), 2) << "it breaks already";
  EXPECT_LT(events.size(), read_text(path("whole/events.csv")).size()) << "and not all of it has";
  EXPECT_EQ(interrupted_resume("parts", 17, "1").code, 75);
  EXPECT_EQ(resume("parts", "2").code, 0);
  expect_same_results(path("parts"), path("whole"));
  report_faults(sigterm, 3, Left::survived, "elements on all edges");
}

TEST_F(Resume, LeavesTheSameBytesWithSmearedDamage) {
  const std::vector<std::string> damage{"--set", "cohesive.insertion=none"};
  ASSERT_EQ(run("whole", damage).code, 0);
  EXPECT_EQ(interrupted_run("parts", 15, damage).code, 75);
  const std::string events = read_text(path("parts/events.csv"));
  EXPECT_GT(std::count(events.begin(), events.end(), '\n'), 2) << "it breaks already";
  EXPECT_EQ(resume("parts", "2").code, 0);
  expect_same_results(path("parts"), path("whole"));
  report_faults(sigterm, 1, Left::survived, "smeared damage");
}

// While it still meshes, settles or climbs the ramp: at the first instant at which there is a run.
TEST_F(Resume, StoppedBeforeTheFirstStep) {
  for (const char* insertion : {"all", "on_demand"}) {
    const std::vector<std::string> how{"--set", std::string("cohesive.insertion=") + insertion,
                                       "--set", "run.fast_forward=true",
                                       "--set", "run.end_time=0.6 ms"};
    const std::string whole = std::string("whole_") + insertion, parts = std::string("parts_") + insertion;
    ASSERT_EQ(run(whole, how).code, 0);
    Process process(arguments(parts, how), path("process"));
    ASSERT_TRUE(wait_for(path(parts + "/run.log"), process));
    process.signal(SIGTERM);
    EXPECT_EQ(process.wait().code, 75);
    EXPECT_EQ(resume(parts).code, 0);
    expect_same_results(path(parts), path(whole));
    report_faults("SIGTERM before the first step; resumed", 1, Left::survived, insertion);
  }
}

// A specimen under a load, with a notch: no wellbore, no fluid.
TEST_F(Resume, LeavesTheSameBytesOfALoadedNotchedBeam) {
  for (const std::string variant : {"smoke", "smoke_damage"}) {
    const auto arguments = [&](const std::string& folder) {
      return std::vector<std::string>{
          "run",       std::string(CRACKLE_SOURCE_DIR) + "/cases/three_point_bending/" + variant + ".toml",
          "-q",        "-j",
          "1",         "-o",
          path(folder)};
    };
    ASSERT_EQ(Process(arguments("whole_" + variant), path("process")).wait().code, 0);
    Process process(arguments("parts_" + variant), path("process"));
    EXPECT_EQ(interrupted(process, "parts_" + variant, 2).code, 75);
    EXPECT_EQ(interrupted_resume("parts_" + variant, 4, "2").code, 75);
    EXPECT_EQ(resume("parts_" + variant).code, 0);
    expect_same_results(path("parts_" + variant), path("whole_" + variant));
    report_faults(sigterm, 2, Left::survived, "loaded beam");
  }
}

TEST_F(Resume, LeavesTheSameBytesWithElementsOnDemand) {
  const std::vector<std::string> on_demand{"--set", "cohesive.insertion=on_demand"};
  ASSERT_EQ(run("whole", on_demand).code, 0);
  EXPECT_EQ(interrupted_run("parts", 15, on_demand).code, 75);
  EXPECT_EQ(resume("parts", "2").code, 0);
  expect_same_results(path("parts"), path("whole"));
  report_faults(sigterm, 1, Left::survived, "on demand");
}

TEST_F(Resume, LeavesTheSameBytesWithViscousFlow) {
  const std::vector<std::string> viscous{"--set", "cohesive.insertion=on_demand",
                                         "--set", "fluid.flow=viscous",
                                         "--set", "fluid.viscosity=1e-3 Pa s"};
  ASSERT_EQ(run("whole", viscous).code, 0);
  EXPECT_EQ(interrupted_run("parts", 15, viscous).code, 75);
  EXPECT_EQ(resume("parts", "2").code, 0);
  expect_same_results(path("parts"), path("whole"));
  report_faults(sigterm, 1, Left::survived, "viscous flow");
}

// Layers of other density, stiffness, strength and stress, one with an interface that may part.
TEST_F(Resume, LeavesTheSameBytesInLayeredRock) {
  write("case.toml", std::string(good_case) + R"(
[[layers]]
top = "-0.04 m"
young_modulus = "25 GPa"
density = "2300 kg/m3"
tensile_strength = "2 MPa"
stress_xx = "-4 MPa"
interface = "bonded"
interface_tensile_strength = "1 MPa"
interface_cohesion = "5 MPa"
interface_friction_angle = "30 deg"
interface_fracture_energy_mode1 = "2 J/m2"
interface_fracture_energy_mode2 = "20 J/m2"
)");
  for (const char* insertion : {"all", "on_demand"}) {
    const std::vector<std::string> how{"--set", std::string("cohesive.insertion=") + insertion};
    const std::string whole = std::string("whole_") + insertion, parts = std::string("parts_") + insertion;
    ASSERT_EQ(run(whole, how).code, 0);
    EXPECT_EQ(interrupted_run(parts, 15, how).code, 75);
    const std::string events = read_text(path(parts + "/events.csv"));
    EXPECT_GT(std::count(events.begin(), events.end(), '\n'), 2) << "it breaks already";
    EXPECT_EQ(resume(parts, "2").code, 0);
    expect_same_results(path(parts), path(whole));
    report_faults(sigterm, 1, Left::survived, "layers");
  }
}

TEST_F(Resume, LeavesTheSameBytesWithAnAbsorbingBoundary) {
  const std::vector<std::string> absorbing{"--set", "boundary.outer=absorbing"};
  ASSERT_EQ(run("whole", absorbing).code, 0);
  EXPECT_EQ(interrupted_run("parts", 15, absorbing).code, 75);
  EXPECT_EQ(resume("parts").code, 0);
  expect_same_results(path("parts"), path("whole"));
  report_faults(sigterm, 1, Left::survived, "absorbing boundary");
}

// In field time, while it grows and leaks by diffusion; any number of threads.
TEST_F(Resume, LeavesTheSameBytesInFieldTime) {
  const auto arguments = [&](const std::string& folder, const std::string& threads) {
    return std::vector<std::string>{"run",
                                    std::string(CRACKLE_SOURCE_DIR) + "/cases/kgd/smoke.toml",
                                    "-q",
                                    "-j",
                                    threads,
                                    "-o",
                                    path(folder),
                                    "--set",
                                    "run.end_time=40 s",
                                    "--set",
                                    "output.fields_every=4 s",
                                    "--set",
                                    "fluid.leak_off=diffusion",
                                    "--set",
                                    "rock.permeability=1e-18 m2",
                                    "--set",
                                    "rock.porosity=0.05",
                                    "--set",
                                    "rock.pore_compressibility=1e-9 1/Pa",
                                    "--set",
                                    "rock.pore_viscosity=1 cP"};
  };
  ASSERT_EQ(Process(arguments("whole", "1"), path("process")).wait().code, 0);
  for (const char* threads : {"2", "8"}) {
    const std::string folder = std::string("threads") + threads;
    ASSERT_EQ(Process(arguments(folder, threads), path("process")).wait().code, 0);
    expect_same_results(path(folder), path("whole"));
  }
  Process process(arguments("parts", "1"), path("process"));
  EXPECT_EQ(interrupted(process, "parts", 2).code, 75);
  EXPECT_THAT(read_text(path("parts/summary.json")), HasSubstr("\"interrupted\""));
  EXPECT_EQ(interrupted_resume("parts", 6, "2").code, 75);
  EXPECT_EQ(resume("parts").code, 0);
  expect_same_results(path("parts"), path("whole"));
  report_faults(sigterm, 2, Left::survived, "field time");
}

// In field time, amid the explicit steps of a snap.
TEST_F(Resume, LeavesTheSameBytesAmidASnap) {
  write("case.toml", "include = \"" + std::string(CRACKLE_SOURCE_DIR) +
                         "/cases/granite_wellbore/smoke_field_time_snap.toml\"\n");
  const std::vector<std::string> how{"--set", "run.end_time=48.92 s", "--set",
                                     "output.fields_every=48.9092 s"};
  ASSERT_EQ(run("whole", how).code, 0);
  EXPECT_THAT(read_text(path("whole/run.log")), HasSubstr("in equilibrium again"));
  EXPECT_EQ(interrupted_run("parts", 1, how).code, 75);
  const std::string log = read_text(path("parts/run.log"));
  EXPECT_THAT(log, HasSubstr("the fracture snaps"));
  EXPECT_THAT(log, Not(HasSubstr("in equilibrium again")));
  EXPECT_EQ(resume("parts").code, 0);
  expect_same_results(path("parts"), path("whole"));
}

// The mesh is in the checkpoint: the file of joints may be another by then.
TEST_F(Resume, LeavesTheSameBytesInFieldTimeWhereTheJointsFileHasChanged) {
  write("joints.csv", "x1_m,y1_m,x2_m,y2_m\n2.5,-1,2.5,4\n");
  write("case.toml", "include = \"" + std::string(CRACKLE_SOURCE_DIR) + R"(/cases/free_paths/free_paths.toml"
[domain]
width = "40 m"
height = "40 m"
[mesh]
size_fine = "0.5 m"
fine_radius = "4 m"
size_coarse = "4 m"
[[joint_sets]]
file = "joints.csv"
residual_friction_angle = "42 deg"
)");
  const std::vector<std::string> how{"--set", "run.end_time=3 s", "--set", "output.fields_every=0.5 s"};
  ASSERT_EQ(run("whole", how).code, 0);
  EXPECT_EQ(interrupted_run("parts", 2, how).code, 75);
  write("joints.csv", "x1_m,y1_m,x2_m,y2_m\n2.2,-1,2.9,3\n");
  EXPECT_EQ(resume("parts").code, 0);
  expect_same_results(path("parts"), path("whole"));
  report_faults("file of joints changed since; resumed", 1, Left::survived);
}

// Joints that slide and break while the run is interrupted, three times, with the fluid in some of them.
class ResumeWithJoints : public Resume, public testing::WithParamInterface<const char*> {};

TEST_P(ResumeWithJoints, LeavesTheSameBytes) {
  write("case.toml", std::string(good_case) + R"(
[[joint_sets]]
density = "150 1/m2"
length_mean = "60 mm"
region_radius = "0.3 m"
clear_distance = "20 mm"
seed = 2
residual_friction_angle = "10 deg"
)");
  std::vector<std::string> joints;
  for (std::stringstream words(GetParam()); joints.size() < 4;) {
    joints.emplace_back("--set");
    std::getline(words, joints.emplace_back(), ' ');
  }
  ASSERT_EQ(run("whole", joints).code, 0);
  const auto expect_slips_under_way = [&](const std::string& checkpoint) {
    crackle::SlipMemory slips;
    crackle::unpack_checkpoint(read_text(path("parts/" + checkpoint)), checkpoint,
                               crackle::columns_of(slips, "state/slips"));
    std::printf("%s: %zu edges of %zu slip events under way\n", checkpoint.c_str(), slips.edges.size(),
                slips.events.size());
    EXPECT_GT(slips.events.size(), 0U) << "nothing slides just then";
  };
  EXPECT_EQ(interrupted_run("parts", 14, joints).code, 75);
  expect_slips_under_way("checkpoint_a.h5");
  EXPECT_EQ(interrupted_resume("parts", 17, "2").code, 75);
  expect_slips_under_way("checkpoint_b.h5");
  const std::string events = read_text(path("parts/events.csv")), all = read_text(path("whole/events.csv"));
  EXPECT_NE(events.find(",breaking,"), std::string::npos) << "it breaks already";
  for (const char* kind : {",slip,", ",breaking,"}) {
    EXPECT_NE(all.find(kind, events.size()), std::string::npos) << kind << " comes after that too";
  }
  EXPECT_EQ(interrupted_resume("parts", 19, "1").code, 75);
  expect_slips_under_way("checkpoint_a.h5");
  EXPECT_EQ(resume("parts", "2").code, 0);
  expect_same_results(path("parts"), path("whole"));
  report_faults(sigterm, 3, Left::survived, "joints");
}

INSTANTIATE_TEST_SUITE_P(All, ResumeWithJoints,
                         testing::Values("cohesive.insertion=all fluid.joints=whole",
                                         "cohesive.insertion=on_demand fluid.joints=whole",
                                         "cohesive.insertion=on_demand fluid.joints=edge"));

TEST_F(Resume, WritesACheckpointWhenAsked) {
  Process process(arguments("out"), path("process"));
  ASSERT_TRUE(wait_for(path("out/fields/fields_000002.vtu"), process));
  process.signal(SIGUSR1);
  EXPECT_TRUE(wait_for(path("out/checkpoint_a.h5"), process));
  EXPECT_EQ(process.wait().code, 0) << "and goes on";
  EXPECT_FALSE(fs::exists(path("out/checkpoint_a.h5"))) << "of no use any more";
  const Outcome again = resume("out");
  EXPECT_EQ(again.code, 0) << again.err;
}

TEST_F(Resume, OfARunWithoutCheckpointBeginsAnew) {
  ASSERT_EQ(run("whole").code, 0);
  Process process(arguments("killed"), path("process"));
  ASSERT_TRUE(wait_for(path("killed/fields/fields_000012.vtu"), process));
  process.signal(SIGKILL);
  EXPECT_EQ(process.wait().code, -1);
  EXPECT_EQ(resume("killed").code, 0);
  expect_same_results(path("killed"), path("whole"));
  report_faults("SIGKILL before the first checkpoint", 1, Left::survived);
}

// Whole files, but for the older checkpoint.
TEST_F(Resume, TakesTheOlderCheckpointWhereTheNewerIsDamaged) {
  ASSERT_EQ(run("whole").code, 0);
  ASSERT_EQ(interrupted_run("parts", 5).code, 75);
  ASSERT_EQ(interrupted_resume("parts", 14, "1").code, 75);
  ASSERT_TRUE(fs::exists(path("parts/checkpoint_b.h5")));
  flip_a_bit("parts/checkpoint_b.h5");
  EXPECT_EQ(resume("parts").code, 0);
  EXPECT_THAT(read_text(path("parts/run.log")),
              testing::AllOf(HasSubstr("checkpoint_b.h5: it is damaged"), HasSubstr("from checkpoint_a.h5")));
  expect_same_results(path("parts"), path("whole"));
  report_faults("newer checkpoint damaged: the older is taken", 1, Left::survived);
}

TEST_F(Resume, RefusesWhereNoCheckpointCanBeUsed) {
  ASSERT_EQ(interrupted_run("out", 2).code, 75);
  ASSERT_EQ(interrupted_resume("out", 5, "1").code, 75);
  flip_a_bit("out/checkpoint_a.h5");
  fs::resize_file(path("out/checkpoint_b.h5"), 1000);
  const auto before = results(path("out"));
  const Outcome outcome = resume("out");
  expect_refusal(outcome, 2, "no checkpoint can be used");
  EXPECT_THAT(outcome.err, testing::AllOf(HasSubstr("checkpoint_a.h5: it is damaged"),
                                          HasSubstr("checkpoint_b.h5: it is 1000 bytes long instead of")));
  EXPECT_EQ(results(path("out")), before);
  report_faults(unusable, 1, Left::refused, "both damaged");
}

TEST_F(Resume, RefusesACheckpointOfAnotherCase) {
  ASSERT_EQ(interrupted_run("out", 2).code, 75);
  std::string resolved = read_text(path("out/resolved.toml"));
  const std::size_t at = resolved.find("density = 2500");
  ASSERT_NE(at, std::string::npos);
  write("out/resolved.toml", resolved.replace(at, 14, "density = 2600"));
  expect_refusal(resume("out"), 2, "it is of another case than resolved.toml");
  report_faults(unusable, 1, Left::refused, "of another case");
}

TEST_F(Resume, RefusesWhereTheTablesWereCut) {
  ASSERT_EQ(interrupted_run("out", 12).code, 75);
  fs::resize_file(path("out/history.csv"), 100);
  expect_refusal(resume("out"), 2,
                 "history.csv or events.csv is shorter than when checkpoint_a.h5 was written");
  report_faults(unusable, 1, Left::refused, "history.csv cut short before it");
}

TEST_F(Resume, RefusesWhatIsNoRun) {
  expect_refusal(resume("nothing"), 2, "there is no run to resume");
  EXPECT_FALSE(fs::exists(path("nothing")));
  fs::create_directory(path("empty"));
  expect_refusal(resume("empty"), 2, "there is no run to resume");
  expect_refusal(crackle({"run", path("case.toml"), "--resume", path("empty")}), 2, "case excludes --resume");
  expect_refusal(crackle({"run"}), 2, "case is required");
  report_faults("resumed what is no run", 4, Left::refused);
}

TEST_F(Resume, SecondProcessInOneFolderIsRefused) {
  Process first(arguments("out", {"--set", "run.end_time=10 s", "--set", "fluid.pump.0.to=0.1 ms", "--set",
                                  "output.fields_every=5 s"}),
                path("process"));
  ASSERT_TRUE(wait_for(path("out/run.log"), first));
  expect_refusal(crackle(arguments("out")), 2, "out: another crackle is running in this folder");
  ASSERT_TRUE(wait_for(path("out/fields.pvd"), first));
  expect_refusal(crackle({"run", "--resume", path("out")}), 2, "another crackle is running in this folder");
  first.signal(SIGINT);
  EXPECT_EQ(first.wait().code, 75) << "the first is not disturbed";
  report_faults("second process in the folder of a run", 2, Left::refused);
}

}  // namespace
}  // namespace crackle_test
