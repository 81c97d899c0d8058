// SPDX-License-Identifier: GPL-3.0-or-later
#include "case_read.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "case_load.hpp"
#include "case_schema.hpp"
#include "case_unknown.hpp"
#include "case_value.hpp"
#include "crackle/core/units.hpp"

namespace crackle {
namespace {

using Kind = TomlNode::Kind;

/// Where a table is in the file: its name in the key table, and with the row, "fluid.pump.0".
struct Spot {
  const TableSpec& table;
  std::size_t row = 0;
  std::string path;
};

class Reader {
 public:
  Reader(ReadCase& read, const CaseNames& names) : read_(read), names_(names) {}

  void read_table(const TomlNode& node, const Spot& spot) {
    for (const TomlNode& child : node.children) {
      const bool plain = !child.key.empty() && child.key.find('.') == std::string::npos;
      const TableSpec* table = plain ? find_table(join_path(spot.table.name, child.key)) : nullptr;
      if (table) {
        read_sub_table(child, *table);
      } else if (const KeySpec* key = find_key(spot.table, child.key)) {
        const std::string path = join_path(spot.path, child.key);
        read_value(child, {path, *key, units_, names_}, read_.scene, spot.row);
        read_.given.add(path, child.place);
      } else {
        fail(child.key_place, unknown_key(child, spot.table));
      }
    }
  }

  void check_needed() const {
    for (const TableSpec& table : case_tables()) {
      const std::size_t rows = table.rows ? table.rows(read_.scene) : 1;
      for (std::size_t row = 0; row < rows; ++row) {
        const std::string path = table.rows ? fmt::format("{}.{}", table.name, row) : std::string(table.name);
        for (const KeySpec& key : table.keys) check_needed(table, key, join_path(path, key.key));
      }
    }
  }

 private:
  void read_sub_table(const TomlNode& node, const TableSpec& table) {
    const std::string name(table.name);
    read_.given.add(name, node.place);
    if (!table.rows) {
      if (node.kind != Kind::table) {
        fail(node.place,
             fmt::format("{0} must be a table, not {1}: write [{0}]", name, kind_name(node.kind)));
      }
      read_table(node, {table, 0, name});
      return;
    }
    const auto is_table = [](const TomlNode& row) { return row.kind == Kind::table; };
    if (node.kind != Kind::array || !std::ranges::all_of(node.children, is_table)) {
      fail(node.place, fmt::format("{0} must be a list of tables: write [[{0}]] above each", name));
    }
    table.resize(read_.scene, node.children.size());
    for (std::size_t row = 0; row < node.children.size(); ++row) {
      const std::string path = fmt::format("{}.{}", name, row);
      read_.given.add(path, node.children[row].place);
      read_table(node.children[row], {table, row, path});
    }
  }

  void check_needed(const TableSpec& table, const KeySpec& key, const std::string& path) const {
    if (!is_needed(key, read_.scene) || read_.given.has(path)) return;
    const std::string header =
        table.rows ? fmt::format("[[{}]]", table.name) : fmt::format("[{}]", table.name);
    fail(read_.given.place(path),
         fmt::format("missing key {} in {} ({}): write for example {} = {}", key.key, header, key.meaning,
                     key.key, key.quantity ? key.quantity->example : "..."));
  }

  ReadCase& read_;
  const CaseNames& names_;
  Units units_;
};

ReadCase read_tree(TomlNode root, const std::string& file, const std::vector<std::string>& overrides,
                   const CaseNames& names) {
  for (const std::string& assignment : overrides) apply_override(root, assignment);
  ReadCase read;
  read.scene.file = file;
  read.given.set_file(file);
  if (root.children.empty()) fail({file, 0, 0, 0}, "the case file is empty");
  Reader reader(read, names);
  reader.read_table(root, {*find_table(""), 0, ""});
  reader.check_needed();
  finish_case(read);
  return read;
}

}  // namespace

Place GivenKeys::latest(std::initializer_list<std::string_view> paths) const {
  Place latest = file_;
  for (const std::string_view path : paths) {
    if (Place at = place(std::string(path)); at.layer > latest.layer) latest = std::move(at);
  }
  return latest;
}

Place GivenKeys::place(std::string path) const {
  while (!path.empty()) {
    if (const auto at = places_.find(path); at != places_.end()) return at->second;
    const std::size_t dot = path.rfind('.');
    path.resize(dot == std::string::npos ? 0 : dot);
  }
  return file_;
}

Case read_case(const std::string& path, const std::vector<std::string>& overrides, const CaseNames& names) {
  return read_tree(load_case_file(path), path, overrides, names).scene;
}

Case parse_case(const std::string& text, const std::string& name, const std::vector<std::string>& overrides,
                const CaseNames& names) {
  return read_tree(load_case_text(text, name), name, overrides, names).scene;
}

}  // namespace crackle
