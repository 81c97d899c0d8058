// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include "case_schema.hpp"
#include "crackle/core/version.hpp"
#include "toml_tree.hpp"

namespace crackle {
namespace {

/// The shortest text that reads back to the same double; always a TOML float, -0 included.
std::string as_toml(double value) {
  std::string text = fmt::format("{}", value);
  if (text.find_first_of(".en") == std::string::npos) text += ".0";
  return text;
}
std::string as_toml(std::optional<double> value) { return value ? as_toml(*value) : ""; }
std::string as_toml(int value) { return fmt::format("{}", value); }
std::string as_toml(std::uint64_t value) { return fmt::format("{}", value); }
std::string as_toml(std::optional<std::uint64_t> value) { return value ? as_toml(*value) : ""; }
std::string as_toml(bool value) { return value ? "true" : "false"; }
std::string as_toml(const std::string& text) { return toml_quoted(text); }
std::string as_toml(const std::vector<std::string>& texts) {
  std::string list;
  for (const std::string& text : texts) list += (list.empty() ? "" : ", ") + toml_quoted(text);
  return "[" + list + "]";
}

/// The value of a key as TOML; empty if it has none.
std::string value_text(const KeySpec& key, Case& scene, std::size_t row) {
  const auto write = [&](auto slot) -> std::string {
    if constexpr (std::is_same_v<decltype(slot), std::monostate>) {
      return "";
    } else {
      return as_toml(slot(scene, row));
    }
  };
  const std::string text = std::visit(write, key.slot);
  return !key.zero_word.empty() && text == "0.0" ? toml_quoted(key.zero_word) : text;
}

/// Keys that were left out because a mesh file stands for them, and empty texts, stay out.
bool is_written(const KeySpec& key, const Case& scene, const std::string& text) {
  if (text.empty() || text == "\"\"") return false;
  return key.need == Need::never || is_needed(key, scene) || text != "0.0";
}

std::string table_text(const TableSpec& table, Case& scene, std::size_t row) {
  std::string text;
  for (const KeySpec& key : table.keys) {
    const std::string value = value_text(key, scene, row);
    if (is_written(key, scene, value)) text += fmt::format("{} = {}\n", key.key, value);
  }
  if (table.name.empty()) return text;
  if (text.empty()) return "";
  return table.rows ? fmt::format("\n[[{}]]\n{}", table.name, text)
                    : fmt::format("\n[{}]\n{}", table.name, text);
}

std::string default_text(const TableSpec& table, const KeySpec& key) {
  if (!key.fallback.empty()) return std::string(key.fallback);
  if (key.need != Need::never) return "";
  Case defaults;
  if (table.resize) table.resize(defaults, 1);
  return value_text(key, defaults, 0);
}

}  // namespace

std::string resolved_toml(const Case& scene) {
  Case copy = scene;
  std::string text =
      fmt::format("# crackle {}: every value of the case, in SI units, angles in radians\n", version);
  for (const TableSpec& table : case_tables()) {
    const std::size_t rows = table.rows ? table.rows(copy) : 1;
    for (std::size_t row = 0; row < rows; ++row) text += table_text(table, copy, row);
  }
  return text;
}

std::vector<CaseKey> case_keys() {
  std::vector<CaseKey> keys;
  for (const TableSpec& table : case_tables()) {
    for (const KeySpec& key : table.keys) {
      const std::string unit(key.quantity && key.quantity->units[0] != "1" ? key.quantity->units[0] : "");
      keys.push_back({std::string(table.name), std::string(key.key), unit, default_text(table, key),
                      std::string(key.meaning)});
    }
  }
  return keys;
}

}  // namespace crackle
