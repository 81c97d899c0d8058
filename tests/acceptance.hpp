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

/// A line of a table of acceptance tests, which scripts/acceptance_table reads; those of smeared damage are
/// T1 to T13, those in field time have numbers:
///   ACCEPT | number | test | gate | got | yes or NO
inline void accept(const std::string& number, const std::string& test, const std::string& gate,
                   const std::string& got, bool within) {
  std::printf("ACCEPT | %s | %s | %s | %s | %s\n", number.c_str(), test.c_str(), gate.c_str(), got.c_str(),
              within ? "yes" : "NO");
}
inline void accept(int number, const std::string& test, const std::string& gate, const std::string& got,
                   bool within) {
  accept(std::to_string(number), test, gate, got, within);
}

}  // namespace crackle
