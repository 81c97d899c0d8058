// SPDX-License-Identifier: GPL-3.0-or-later
//
// A small run from case to catalog.
#include <gmock/gmock.h>

#include <algorithm>

#include "binary.hpp"

namespace crackle_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

using RunCommand = CliTest;

std::int64_t lines(const std::string& text) { return std::count(text.begin(), text.end(), '\n'); }

TEST_F(RunCommand, FromCaseToCatalog) {
  const std::string file = write("good.toml", good_case), out = path("out");
  const Outcome run =
      crackle({"run", file, "-q", "-j", "1", "-o", out, "--set", "output.history_every=0.2 ms", "--set",
               "run.end_time=0.75 ms"});  // before a fracture gets to the outer boundary
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_EQ(run.err + run.out, "") << "quiet";
  for (const char* name : {"resolved.toml", "history.csv", "events.csv", "events.xml", "fields.pvd",
                           "summary.json", "status.json", "run.log"}) {
    EXPECT_TRUE(std::filesystem::exists(out + "/" + name)) << name;
  }

  const std::string events = read_text(out + "/events.csv");
  ASSERT_GT(lines(events), 3) << "the case breaks";
  EXPECT_THAT(read_text(out + "/summary.json"), HasSubstr("\"alarms\": 0,")) << "and no guard minds";
  const Outcome summary = crackle({"catalog", out, "--no-figures"});
  EXPECT_EQ(summary.code, 0) << summary.err;
  EXPECT_THAT(summary.out,
              AllOf(HasSubstr(std::to_string(lines(events) - 1) + " events"), HasSubstr("tensile"),
                    HasSubstr("magnitudes"), HasSubstr("clusters"), HasSubstr("DC"), HasSubstr("b")));
  const Outcome all_in_one =
      crackle({"catalog", out, "--clustered", "--radius", "10 m", "--window", "1 s", "--to", "csv"});
  EXPECT_EQ(lines(all_in_one.out), 2) << all_in_one.err;
  expect_refusal(crackle({"catalog", out, "--radius", "10 s"}), 2, "--radius");
  expect_refusal(crackle({"catalog", out, "--window=-1"}), 2, "--window");
  EXPECT_EQ(crackle({"catalog", out, "--to", "csv"}).out, events);
  EXPECT_EQ(lines(crackle({"catalog", out, "--to", "zmap"}).out), lines(events) - 1);
  ASSERT_EQ(crackle({"catalog", out, "--to", "quakeml", "-o", path("a.xml")}).code, 0);
  EXPECT_EQ(read_text(path("a.xml")), read_text(out + "/events.xml"));
  expect_refusal(crackle({"catalog", out, "--to", "kml"}), 2, "csv, quakeml or zmap");
  expect_refusal(crackle({"catalog", out, "--to", "csv", "-o", "/proc/a.csv"}), 2, "/proc/a.csv");
  expect_refusal(crackle({"catalog", out, "-o", path("b.csv")}), 2, "--to");
}

TEST_F(RunCommand, StatusSaysHowItWent) {
  const std::string file = write("good.toml", good_case);
  ASSERT_EQ(crackle({"run", file, "-q", "-j", "1", "-o", path("a"), "--set", "run.end_time=10us"}).code, 0);
  EXPECT_THAT(read_text(path("a/status.json")),
              AllOf(HasSubstr("\"state\": \"done\""), HasSubstr("\"wall_left_s\": 0"),
                    HasSubstr("\"end_time_s\": 1e-05"), HasSubstr("\"reason\": \"\"")));
  // a step far too long is refused once the mesh is there
  ASSERT_EQ(crackle({"run", file, "-q", "-j", "1", "-o", path("b"), "--set", "run.time_step=1e-5"}).code, 2);
  EXPECT_THAT(read_text(path("b/status.json")),
              AllOf(HasSubstr("\"state\": \"failed\""), HasSubstr("run.time_step = 1e-05 s is above")));
  // nothing was run there, so the folder can be used again
  EXPECT_EQ(crackle({"run", file, "-q", "-j", "1", "-o", path("b"), "--set", "run.end_time=10us"}).code, 0);
}

TEST_F(RunCommand, UnstableRunOnlyWhereItIsAllowed) {
  const std::string file = write("good.toml", good_case);
  const std::vector<std::string> too_long{
      "run", file, "-q", "-j", "1", "--set", "run.time_step=1e-6", "--set", "run.end_time=0.1 ms"};
  const auto with = [&](std::vector<std::string> more) {
    std::vector<std::string> all = too_long;
    all.insert(all.end(), more.begin(), more.end());
    return crackle(all);
  };
  expect_refusal(with({"-o", path("a")}), 2, "run.time_step = 1e-06 s is above the stable step");
  EXPECT_EQ(with({"-o", path("a"), "--allow-unstable"}).code, 0);
  EXPECT_THAT(read_text(path("a/run.log")), HasSubstr("unstable, and goes on: the mesh oscillates"));
  EXPECT_THAT(read_text(path("a/summary.json")),
              AllOf(HasSubstr("\"unstable_allowed\": true"), testing::Not(HasSubstr("\"alarms\": 0,"))));
}

// What run resolved is a case that runs to the same.
TEST_F(RunCommand, ResolvedCaseIsTheCase) {
  const std::string file = write("good.toml", good_case);
  const auto run = [&](const std::string& from, const char* to) {
    return crackle({"run", from, "-q", "-j", "1", "-o", path(to), "--set", "run.end_time=10us"}).code;
  };
  ASSERT_EQ(run(file, "a"), 0);
  ASSERT_EQ(run(path("a/resolved.toml"), "b"), 0);
  EXPECT_EQ(read_text(path("a/resolved.toml")), read_text(path("b/resolved.toml")));
  EXPECT_EQ(read_text(path("a/history.csv")), read_text(path("b/history.csv")));
}

TEST_F(RunCommand, InterruptedRunIsWhole) {
  const std::string file = write("good.toml", good_case);
  const Outcome run = crackle({"run", file, "-q", "-j", "1", "-o", path("out"), "--set", "run.end_time=10s",
                               "--set", "fluid.pump.0.to=0.1ms", "--set", "output.fields_every=5s"},
                              path("out/fields/fields_000000.vtu"));
  EXPECT_EQ(run.code, 75) << run.err;
  EXPECT_THAT(read_text(path("out/summary.json")), HasSubstr("\"interrupted\""));
  EXPECT_THAT(read_text(path("out/status.json")), HasSubstr("\"interrupted\""));
  EXPECT_TRUE(std::filesystem::exists(path("out/fields/fields_000001.vtu"))) << "where it was stopped";
}

}  // namespace
}  // namespace crackle_test
