// SPDX-License-Identifier: GPL-3.0-or-later
#include "toml_tree.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "crackle/core/errors.hpp"

namespace crackle {
namespace {

bool is_control(char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }

std::string one_line(std::string_view text) {
  std::string line(text);
  std::ranges::replace_if(line, is_control, ' ');
  return line;
}

}  // namespace

const TomlNode* TomlNode::find(std::string_view child_key) const {
  const auto at = std::ranges::find(children, child_key, &TomlNode::key);
  return at == children.end() ? nullptr : &*at;
}

TomlNode* TomlNode::find(std::string_view child_key) {
  const auto at = std::ranges::find(children, child_key, &TomlNode::key);
  return at == children.end() ? nullptr : &*at;
}

std::string_view kind_name(TomlNode::Kind kind) {
  switch (kind) {
    case TomlNode::Kind::table:
      return "a table";
    case TomlNode::Kind::array:
      return "a list";
    case TomlNode::Kind::text:
      return "a text";
    case TomlNode::Kind::integer:
      return "an integer";
    case TomlNode::Kind::number:
      return "a number";
    case TomlNode::Kind::boolean:
      return "true or false";
    case TomlNode::Kind::date:
      return "a date";
  }
  return "a value";
}

std::string toml_quoted(std::string_view text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      quoted += '\\';
      quoted += c;
    } else if (is_control(c)) {
      quoted += fmt::format("\\u{:04X}", static_cast<unsigned>(c));
    } else {
      quoted += c;
    }
  }
  return quoted + '"';
}

std::string shown(std::string_view text) {
  constexpr std::size_t longest = 60;
  if (text.size() <= longest) return toml_quoted(text);
  std::size_t cut = longest;
  while (cut > 0 && (static_cast<unsigned char>(text[cut]) & 0xC0U) == 0x80U) --cut;  // inside a UTF-8 letter
  return toml_quoted(std::string(text.substr(0, cut)) + "...");
}

void fail(const Place& place, std::string_view message) {
  std::string at = one_line(place.file);
  if (place.line > 0) at += fmt::format(":{}:{}", place.line, place.column);
  throw CaseError(at, 0, 0, one_line(message));
}

}  // namespace crackle
