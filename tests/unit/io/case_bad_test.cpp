// SPDX-License-Identifier: GPL-3.0-or-later
// Every block of bad_cases/*.txt gives its error, at its place; see bad_cases/README.md.
#include <gtest/gtest.h>

#include <cctype>
#include <filesystem>
#include <fstream>
#include <ostream>
#include <string>
#include <vector>

#include "../../fault.hpp"
#include "crackle/core/errors.hpp"
#include "crackle/io/case.hpp"

namespace crackle {
namespace {

namespace fs = std::filesystem;

const fs::path folder = fs::path(CRACKLE_SOURCE_DIR) / "tests/unit/io/bad_cases";

struct BadCase {
  std::string name;
  std::string text;
  std::vector<std::string> overrides;
  std::string error;  ///< "3:11: part of the message"
};

std::ostream& operator<<(std::ostream& stream, const BadCase& bad) { return stream << bad.name; }

std::string bytes(const std::string& line) {
  std::string text;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line.compare(i, 2, "\\x") == 0) {
      text += static_cast<char>(std::stoi(line.substr(i + 2, 2), nullptr, 16));
      i += 3;
    } else {
      text += line[i];
    }
  }
  return text;
}

std::vector<BadCase> read_blocks(const fs::path& path) {
  std::vector<BadCase> blocks;
  bool open = false;
  std::ifstream stream(path);
  for (std::string line; std::getline(stream, line);) {
    if (line.starts_with("=== ")) {
      blocks.push_back({path.stem().string() + " " + line.substr(4), "", {}, ""});
      open = true;
    } else if (line.starts_with("== ")) {
      blocks.push_back({path.stem().string() + " " + line.substr(3), "include = \"good.toml\"\n", {}, ""});
      open = true;
    } else if (open && line.starts_with("-> ")) {
      blocks.back().error = line.substr(3);
      open = false;
    } else if (open && line.starts_with("$ ")) {
      blocks.back().overrides.push_back(bytes(line.substr(2)));
    } else if (open) {
      blocks.back().text += bytes(line) + "\n";
    }
  }
  return blocks;
}

std::vector<BadCase> all_blocks() {
  std::vector<BadCase> all;
  for (const char* file : {"joints.txt", "keys.txt", "loads.txt", "overrides.txt", "relations.txt",
                           "syntax.txt", "values.txt"}) {
    for (BadCase& block : read_blocks(folder / file)) all.push_back(std::move(block));
  }
  return all;
}

std::string test_name(const testing::TestParamInfo<BadCase>& info) {
  std::string name;
  for (const char c : info.param.name) name += std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
  return name;
}

/// The error that a block asks for: how its line begins, and what it holds further on.
struct Expected {
  std::string place;
  std::string message;
};

Expected expected(const BadCase& bad, const std::string& file) {
  const std::size_t split = bad.error.find(": ");
  const std::string place = bad.error.substr(0, split);
  const std::string message = bad.error.substr(split + 2);
  if (place == "-") return {file + ": ", message};
  if (place.starts_with("--set")) return {place + ": ", message};
  return {file + ":" + place + ": ", message};
}

class CaseBad : public testing::TestWithParam<BadCase> {};

TEST_P(CaseBad, IsRefusedAtItsPlace) {
  const BadCase& bad = GetParam();
  const std::string file = (folder / "case.toml").string();
  ASSERT_NE(bad.error.find(": "), std::string::npos) << "the block has no error";
  const auto [place, message] = expected(bad, file);
  try {
    parse_case(bad.text, file, bad.overrides);
    FAIL() << "no error in\n" << bad.text;
  } catch (const CaseError& error) {
    const std::string what = error.what();
    EXPECT_EQ(what.substr(0, place.size()), place) << what;
    EXPECT_NE(what.find(message, place.size()), std::string::npos) << what << "\ndoes not hold\n" << message;
    EXPECT_EQ(what.find('\n'), std::string::npos) << what;
    EXPECT_EQ(error.code(), ExitCode::bad_case);
  }
  crackle_test::report_faults(crackle_test::wrong_case, 1, crackle_test::Left::refused,
                              "key, value or relation");
}

INSTANTIATE_TEST_SUITE_P(Block, CaseBad, testing::ValuesIn(all_blocks()), test_name);

TEST(CaseBadBlocks, AreManyAndTheGoodCaseIsGood) {
  EXPECT_GE(all_blocks().size(), 60U);
  EXPECT_NO_THROW(read_case((folder / "good.toml").string()));
}

}  // namespace
}  // namespace crackle
