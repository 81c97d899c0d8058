// SPDX-License-Identifier: GPL-3.0-or-later
//
// Memory and output of a run are what it says before its first step, and bounded where that is asked for.
#include "resources.hpp"

#include "process.hpp"

namespace crackle_test {
namespace {

using Resources = CliTest;

TEST_F(Resources, MemoryIsAsSaid) {
  for (const Needs& needs : memory_scenes("12 mm")) expect_memory_as_said(needs, path("run"));
}

TEST_F(Resources, OutputIsAsSaid) {
  for (const Needs& needs : output_scenes("12 mm")) expect_output_as_said(needs, path("run"));
}

TEST_F(Resources, InFieldTime) {
  for (const Needs& needs : field_time_scenes()) expect_memory_as_said(needs, path("run"));
  expect_output_as_said({"straight", "kgd/smoke.toml", {"run.end_time=30 s"}}, path("run"));
  expect_output_as_said({"free paths", "free_paths/smoke.toml", {"output.fields_every=0.2 s"}}, path("run"));
}

TEST_F(Resources, ARunThatWouldWriteMoreThanIsAllowedIsRefused) {
  write("case.toml", good_case);
  const Outcome outcome =
      crackle({"run", path("case.toml"), "-q", "-o", path("out"), "--set", "output.max_bytes=1e6"});
  expect_refusal(outcome, 2, "more than output.max_bytes allows, 1.0 MB");
  EXPECT_FALSE(std::filesystem::exists(path("out/fields")));
}

}  // namespace
}  // namespace crackle_test
