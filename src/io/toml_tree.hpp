// SPDX-License-Identifier: GPL-3.0-or-later
// A TOML text as a tree of values that know where they were written. Private to io; only
// toml_parse.cpp knows the parser behind it.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace crackle {

/// Where something is written.
struct Place {
  std::string file = {};  ///< or "--set key" on the command line
  int line = 0;           ///< from 1; 0: no line
  int column = 0;         ///< from 1
  int layer = 0;          ///< a higher layer overrides a lower one: included file, including file, --set
};

struct TomlNode {
  enum class Kind { table, array, text, integer, number, boolean, date };

  Kind kind = Kind::table;
  std::string key = {};                 ///< in its table; empty in an array
  Place key_place = {};                 ///< of the key; of the value in an array
  Place place = {};                     ///< of the value; of the header of a table
  std::string text = {};                ///< of a text or a date
  double number = 0.0;                  ///< of a number or an integer
  std::int64_t integer = 0;             ///< of an integer
  bool truth = false;                   ///< of a boolean
  std::vector<TomlNode> children = {};  ///< of a table or an array, in the order of the text

  /// The child of a table; null if there is none.
  TomlNode* find(std::string_view child_key);
  const TomlNode* find(std::string_view child_key) const;
};

/// "a table", "a number", ... for messages.
std::string_view kind_name(TomlNode::Kind kind);

/// @param name stands for the file in places. @throws CaseError with the place of what is wrong
TomlNode parse_toml(std::string_view text, const std::string& name);

/// A value alone, as on the right of an equals sign; a text that is no TOML value is taken as a
/// string, so that --set needs no inner quotes. @throws CaseError if it is not UTF-8
TomlNode parse_toml_value(std::string_view text, const Place& place);

/// A string as TOML writes it, with its quotes.
std::string toml_quoted(std::string_view text);

/// The same for a message: on one line, cut when long.
std::string shown(std::string_view text);

/// @throws CaseError, the message made one line
[[noreturn]] void fail(const Place& place, std::string_view message);

}  // namespace crackle
