// SPDX-License-Identifier: GPL-3.0-or-later
//
// As resources_test.cpp, on meshes of a size that somebody runs.
#include "process.hpp"
#include "resources.hpp"

namespace crackle_test {
namespace {

using LargeResources = CliTest;

TEST_F(LargeResources, MemoryIsAsSaid) {
  for (const char* size : {"4 mm", "2.5 mm"}) {
    for (const Needs& needs : memory_scenes(size)) expect_memory_as_said(needs, path("run"));
  }
}

TEST_F(LargeResources, OutputIsAsSaid) {
  for (const char* size : {"8 mm", "6 mm"}) {
    for (const Needs& needs : output_scenes(size)) expect_output_as_said(needs, path("run"));
  }
}

}  // namespace
}  // namespace crackle_test
