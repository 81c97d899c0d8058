// SPDX-License-Identifier: GPL-3.0-or-later
#include "case_unknown.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "crackle/core/nearest.hpp"

namespace crackle {
namespace {

std::string header(const TableSpec& table) {
  if (table.name.empty()) return "the top of the file";
  return table.rows ? fmt::format("[[{}]]", table.name) : fmt::format("[{}]", table.name);
}

std::string_view last_part(std::string_view name) { return name.substr(name.rfind('.') + 1); }

/// "[rock] or [fluid]": the tables that have this key, or the table of this name under another one.
std::string homes(std::string_view key) {
  std::string list;
  for (const TableSpec& table : case_tables()) {
    if (!find_key(table, key) && (table.name.empty() || last_part(table.name) != key)) continue;
    list += (list.empty() ? "" : " or ") + header(table);
  }
  return list;
}

/// The tables right under this one.
std::vector<std::string_view> names_in(const TableSpec& table) {
  std::vector<std::string_view> names;
  for (const KeySpec& key : table.keys) names.push_back(key.key);
  for (const TableSpec& other : case_tables()) {
    if (!other.name.empty() && join_path(table.name, last_part(other.name)) == other.name) {
      names.push_back(last_part(other.name));
    }
  }
  return names;
}

}  // namespace

std::string unknown_key(const TomlNode& node, const TableSpec& table) {
  const bool is_table = node.kind == TomlNode::Kind::table;
  const std::string what =
      fmt::format("unknown {} {} in {}", is_table ? "table" : "key", shown(node.key), header(table));
  if (const std::string home = homes(node.key); !home.empty()) {
    return fmt::format("{}: {}", what,
                       is_table ? fmt::format("write {}", home) : fmt::format("it belongs in {}", home));
  }
  const std::vector<std::string_view> here = names_in(table);
  const std::string_view close = nearest(node.key, here);
  std::string advice = fmt::format("the nearest is \"{}\"", close);
  const std::size_t distance = letters_off(node.key, close);
  for (const TableSpec& other : case_tables()) {
    if (distance < 2) break;
    const std::vector<std::string_view> there = names_in(other);
    const std::string_view better = nearest(node.key, there, std::min<std::size_t>(2, distance - 2));
    if (!better.empty()) advice += fmt::format("; {} has \"{}\"", header(other), better);
  }
  return fmt::format("{}: {}", what, advice);
}

}  // namespace crackle
