// SPDX-License-Identifier: GPL-3.0-or-later
#include "catalog_figures.hpp"

#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <vector>

namespace crackle {
namespace {

namespace fs = std::filesystem;

/// The plot scripts: of the installed program, or of the sources that it was built from.
fs::path script() {
  std::error_code ignored;
  const fs::path program = fs::read_symlink("/proc/self/exe", ignored);
  for (const fs::path& folder : {program.parent_path() / "../share/crackle/plots", fs::path(CRACKLE_PLOTS)}) {
    if (fs::exists(folder / "draw_catalog.py", ignored)) return folder / "draw_catalog.py";
  }
  return {};
}

/// @return the exit code; -1 when it could not be started
int run(const std::vector<std::string>& words) {
  std::vector<char*> arguments;
  arguments.reserve(words.size() + 1);
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t quiet;
  posix_spawn_file_actions_init(&quiet);
  posix_spawn_file_actions_addopen(&quiet, STDOUT_FILENO, "/dev/null", 1 /* O_WRONLY */, 0);
  pid_t child = 0;
  const bool started = posix_spawn(&child, arguments[0], &quiet, nullptr, arguments.data(), environ) == 0;
  posix_spawn_file_actions_destroy(&quiet);
  int status = 0;
  if (!started || waitpid(child, &status, 0) != child) return -1;
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

}  // namespace

std::string draw_catalog(const std::string& folder, const BValue& b) {
  const fs::path file = script();
  if (file.empty()) return "No figures: draw_catalog.py is not installed\n";
  std::vector<std::string> words{"/usr/bin/python3", file.string(), folder};
  if (std::isfinite(b.b)) {
    words.push_back(fmt::format("--b={}", b.b));
    words.push_back(fmt::format("--completeness={}", b.completeness));
  }
  if (run(words) != 0) return fmt::format("No figures: {} {} failed\n", file.string(), folder);
  return fmt::format("Figures: {0}/events.png, {0}/catalog.png\n", folder);
}

}  // namespace crackle
