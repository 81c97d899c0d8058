// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace crackle {

/// What `crackle run` and `crackle check` take from the command line.
struct RunOptions {
  std::string case_file;
  std::string output;                  ///< run folder; empty: runs/<case name>
  std::vector<std::string> overrides;  ///< --set table.key=value
  int threads = 0;                     ///< 0: all cores
  std::optional<std::uint64_t> seed;   ///< of the mesh
  bool quiet = false;
};

/// Each command returns the exit code of the program, or throws an Error that carries it.
int run_command(const RunOptions& options);

}  // namespace crackle
