// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace crackle_test {

/// What a command left behind.
struct Outcome {
  int code = -1;  ///< exit code; -1: ended by a signal
  std::string out, err;
};

/// Runs the crackle that was built with these arguments, in the current folder.
/// @param interrupt_at a file at whose appearance it is interrupted, as by Ctrl-C; empty: never
Outcome crackle(const std::vector<std::string>& arguments, const std::string& interrupt_at = "");

/// A small case that is right: some 1300 triangles, breaks and makes events in about a second.
extern const char* const good_case;

/// The good case with one line in place of another (which has to be there).
std::string with(const std::string& line, const std::string& instead);

/// A test with a folder of its own, removed afterwards.
class CliTest : public testing::Test {
 protected:
  CliTest();
  ~CliTest() override;
  /// Writes a file into the folder. @return its path
  std::string write(const std::string& name, const std::string& text) const;
  std::string path(const std::string& name) const { return (folder_ / name).string(); }

 private:
  std::filesystem::path folder_;
};

std::string read_text(const std::filesystem::path& path);
/// All files below a folder with their bytes.
std::map<std::string, std::string> bytes_below(const std::filesystem::path& folder);

/// Expects an exit code and one line on stderr, "crackle: ..." with `part` in it.
void expect_refusal(const Outcome& outcome, int code, const std::string& part);

}  // namespace crackle_test
