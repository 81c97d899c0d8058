// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <sstream>

#include "crackle/core/errors.hpp"
#include "toml_tree.hpp"

namespace crackle {
namespace {

/// Tables in tables, lists in lists: no case needs more, and a tree is walked by recursion.
constexpr int deepest = 16;

Place at(const toml::source_region& source, const std::string& name) {
  return {name, static_cast<int>(source.begin.line), static_cast<int>(source.begin.column), 0};
}

/// toml++ bounds the depth of values but not of dotted keys, and takes its tables down by recursion:
/// a.a.a. ... would end in a stack overflow. Two dots in a row are no key (but a row of dots in a comment).
void check_dotted_keys(std::string_view text, const std::string& name) {
  constexpr int most_dots = 100;
  Place place{name, 1, 1, 0};
  int dots = 0;
  char before = '\n';
  for (const char c : text) {
    if (c == '.' && ++dots > most_dots) fail(place, "a key of too many parts");
    if (std::string_view("=,[]{}#\n").find(c) != std::string_view::npos || (c == '.' && before == '.'))
      dots = 0;
    ++place.column;
    if (c == '\n') place = {name, place.line + 1, 1, 0};
    before = c;
  }
}

TomlNode convert(const toml::node& value, const std::string& name, int depth);

/// In the order of the text: toml++ sorts by key.
void sort_by_place(std::vector<TomlNode>& children) {
  std::ranges::stable_sort(children, [](const TomlNode& a, const TomlNode& b) {
    return std::pair(a.key_place.line, a.key_place.column) < std::pair(b.key_place.line, b.key_place.column);
  });
}

std::vector<TomlNode> convert_children(const toml::node& value, const std::string& name, int depth) {
  std::vector<TomlNode> children;
  if (const toml::table* table = value.as_table()) {
    for (const auto& [key, child] : *table) {
      children.push_back(convert(child, name, depth + 1));
      children.back().key = key.str();
      children.back().key_place = at(key.source(), name);
    }
    sort_by_place(children);
  } else if (const toml::array* array = value.as_array()) {
    for (const toml::node& child : *array) children.push_back(convert(child, name, depth + 1));
  }
  return children;
}

TomlNode convert(const toml::node& value, const std::string& name, int depth) {
  using Kind = TomlNode::Kind;
  TomlNode node;
  node.place = node.key_place = at(value.source(), name);
  if (depth > deepest) fail(node.place, "tables and lists nested too deeply");
  if (value.is_table() || value.is_array()) {
    node.kind = value.is_table() ? Kind::table : Kind::array;
    node.children = convert_children(value, name, depth);
  } else if (const auto* text = value.as_string()) {
    node.kind = Kind::text;
    node.text = text->get();
  } else if (const auto* integer = value.as_integer()) {
    node.kind = Kind::integer;
    node.integer = integer->get();
    node.number = static_cast<double>(node.integer);
  } else if (const auto* number = value.as_floating_point()) {
    node.kind = Kind::number;
    node.number = number->get();
  } else if (value.is_boolean()) {
    node.kind = Kind::boolean;
    node.truth = value.as_boolean()->get();
  } else {
    node.kind = Kind::date;
    std::ostringstream stream;
    stream.imbue(std::locale::classic());
    if (const auto* moment = value.as_date_time()) stream << moment->get();
    if (const auto* day = value.as_date()) stream << day->get();
    node.text = stream.str();
  }
  return node;
}

void set_place(TomlNode& node, const Place& place) {
  node.place = node.key_place = place;
  for (TomlNode& child : node.children) set_place(child, place);
}

}  // namespace

TomlNode parse_toml(std::string_view text, const std::string& name) {
  check_dotted_keys(text, name);
  try {
    return convert(toml::parse(text, name), name, 0);
  } catch (const toml::parse_error& error) {
    fail(at(error.source(), name), fmt::format("not TOML: {}", error.description()));
  }
}

TomlNode parse_toml_value(std::string_view text, const Place& place) {
  TomlNode node;
  try {
    const TomlNode root = parse_toml(fmt::format("value = {}\n", text), place.file);
    if (root.children.size() == 1 && root.children[0].key == "value") node = root.children[0];
  } catch (const CaseError&) {  // then it is a text without its quotes
  }
  if (node.key.empty()) {
    try {
      node = parse_toml("value = " + toml_quoted(text) + "\n", place.file).children.at(0);
    } catch (const CaseError&) {
      fail(place, "the value is not UTF-8 text");
    }
  }
  set_place(node, place);
  return node;
}

}  // namespace crackle
