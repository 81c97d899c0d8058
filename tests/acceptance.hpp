// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdio>
#include <string>

namespace crackle {

/// What a format and its values make.
template <class... Values>
std::string text(const char* format, Values... values) {
  char line[200];
  std::snprintf(line, sizeof line, format, values...);
  return line;
}

/// A line of the table of acceptance tests in field time, which scripts/acceptance_table reads:
///   ACCEPT | number | test | gate | got | yes or NO
inline void accept(int number, const std::string& test, const std::string& gate, const std::string& got,
                   bool within) {
  std::printf("ACCEPT | %d | %s | %s | %s | %s\n", number, test.c_str(), gate.c_str(), got.c_str(),
              within ? "yes" : "NO");
}

}  // namespace crackle
