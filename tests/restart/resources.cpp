// SPDX-License-Identifier: GPL-3.0-or-later
#include "resources.hpp"

#include <regex>

#include "process.hpp"

namespace crackle_test {
namespace {

namespace fs = std::filesystem;

constexpr double allowed = 0.2;

struct Said {
  double memory = 0.0, with_checkpoint = 0.0, output = 0.0;  // [bytes]
};

double bytes_of(const std::string& number, const std::string& unit) {
  return std::stod(number) * (unit == "kB" ? 1e3 : unit == "MB" ? 1e6 : 1e9);
}

// What the log says before the first step.
Said said_in(const std::string& log) {
  const std::regex line(
      "[;Z] ([0-9.]+) (.B) of memory(, ([0-9.]+) (.B) while a checkpoint is written)?; ([0-9.]+) (.B) of "
      "output");
  std::smatch found;
  if (!std::regex_search(log, found, line)) {
    ADD_FAILURE() << "the log does not say what the run needs:\n" << log;
    return {};
  }
  const double memory = bytes_of(found[1], found[2]);
  return {memory, found[3].matched ? bytes_of(found[4], found[5]) : memory, bytes_of(found[6], found[7])};
}

struct Found {
  Said said;
  double memory = 0.0, output = 0.0;  // [bytes]
};

Found run(const Needs& needs, const std::string& folder) {
  std::vector<std::string> arguments{
      "run", std::string(CRACKLE_SOURCE_DIR) + "/cases/" + needs.case_file, "-q", "-j", "1", "-o", folder};
  for (const std::string& setting : needs.settings) arguments.insert(arguments.end(), {"--set", setting});
  Process process(arguments, folder + ".process");
  const Outcome outcome = process.wait();
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  Found found{said_in(read_text(folder + "/run.log")), process.peak_memory()};
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file()) found.output += static_cast<double>(entry.file_size());
  }
  fs::remove_all(folder);
  return found;
}

void expect_within(const std::string& what, double said, double is) {
  std::printf("%s: said %.1f MB, is %.1f MB (%+.0f %%)\n", what.c_str(), 1e-6 * said, 1e-6 * is,
              100.0 * (said / is - 1.0));
  EXPECT_NEAR(said / is, 1.0, allowed) << what;
}

}  // namespace

std::vector<Needs> memory_scenes(const std::string& size) {
  std::vector<Needs> scenes;
  for (const std::string rock : {"granite_wellbore", "heavily_fractured"}) {
    const auto add = [&](const std::string& insertion, const std::string& checkpoint) {
      scenes.push_back({rock + ", " + insertion + (checkpoint == "0 s" ? ", " : ", checkpoints, ") + size,
                        rock + "/anisotropic.toml",
                        {"mesh.size_fine=" + size, "run.end_time=4 us", "run.fast_forward=false",
                         "cohesive.insertion=" + insertion, "output.checkpoint_every=" + checkpoint}});
    };
    add("all", "0 s");
    add("all", "1 ms");
    add("on_demand", "0 s");
    add("on_demand", "1 ms");
  }
  return scenes;
}

std::vector<Needs> field_time_scenes() {
  std::vector<Needs> scenes;
  for (const std::string path : {"kgd/kgd", "free_paths/free_paths"}) {
    for (const std::string checkpoint : {"0 s", "1 ms"}) {
      scenes.push_back({path + (checkpoint == "0 s" ? "" : ", checkpoints"),
                        path + ".toml",
                        {"run.end_time=2 s", "output.checkpoint_every=" + checkpoint}});
    }
  }
  return scenes;
}

std::vector<Needs> output_scenes(const std::string& size) {
  std::vector<Needs> scenes;
  for (const std::string insertion : {"all", "on_demand"}) {
    scenes.push_back({insertion + ", " + size,
                      "granite_wellbore/smoke_anisotropic.toml",
                      {"mesh.size_fine=" + size, "run.end_time=1.3 ms", "cohesive.insertion=" + insertion}});
  }
  return scenes;
}

void expect_memory_as_said(const Needs& needs, const std::string& folder) {
  const Found found = run(needs, folder);
  const bool checkpoints = needs.name.find("checkpoints") != std::string::npos;
  expect_within("memory, " + needs.name, checkpoints ? found.said.with_checkpoint : found.said.memory,
                found.memory);
}

void expect_output_as_said(const Needs& needs, const std::string& folder) {
  const Found found = run(needs, folder);
  expect_within("output, " + needs.name, found.said.output, found.output);
}

}  // namespace crackle_test
