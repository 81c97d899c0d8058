// SPDX-License-Identifier: GPL-3.0-or-later
//
// Everything that has a name a user may write, for `crackle list` and `crackle describe`.
#pragma once

#include <string>
#include <vector>

namespace crackle {

/// A value that a key or an option takes.
struct NamedThing {
  std::string name;
  std::string meaning;  ///< one line
};

/// Values of one key or option.
struct NameGroup {
  std::string title;
  std::string written;  ///< where they are written, e.g. "cohesive.law"
  std::vector<NamedThing> things;
};

/// All groups, registered laws first.
std::vector<NameGroup> name_groups();

/// Tables of a case file, in order.
std::vector<std::string> case_table_names();

}  // namespace crackle
