// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace crackle_test {

/// A run, for what it needs against what was said before it started.
struct Needs {
  std::string name, case_file;
  std::vector<std::string> settings;
};

/// Scenes of that size of edge round the wellbore, started only: elements on all edges, with checkpoints and
/// without, and on demand, each with joints and without.
std::vector<Needs> memory_scenes(const std::string& size);
/// The same in field time: a straight fracture and free paths.
std::vector<Needs> field_time_scenes();
/// Runs through fracture, whose frames are as those of a run that somebody wants.
std::vector<Needs> output_scenes(const std::string& size);

/// Expects peak memory within 20 % of what the run's log says, and prints both.
void expect_memory_as_said(const Needs& needs, const std::string& folder);
/// The same for the bytes in the run's folder.
void expect_output_as_said(const Needs& needs, const std::string& folder);

}  // namespace crackle_test
