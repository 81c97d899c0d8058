// SPDX-License-Identifier: GPL-3.0-or-later
#include "parameters.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <map>
#include <numbers>
#include <sstream>

namespace crackle {
namespace {

std::map<std::string, std::string> units_by_key() {
  std::map<std::string, std::string> units;
  for (const CaseKey& key : case_keys()) units[key.table + "." + key.key] = key.unit;
  return units;
}

/// A value of resolved.toml with fewer digits, and its unit.
std::string readable(const std::string& value, const std::string& unit) {
  char* end = nullptr;
  const double number = std::strtod(value.c_str(), &end);
  if (end == value.c_str() || *end != '\0') return value;
  std::string text = fmt::format("{:.6g}", number);
  if (!unit.empty()) text += " " + unit;
  const double size = std::abs(number);
  if (unit == "rad") text += fmt::format(" ({:.6g} deg)", number * 180.0 / std::numbers::pi);
  if (unit == "Pa" && size >= 1e9) text += fmt::format(" ({:.6g} GPa)", 1e-9 * number);
  if (unit == "Pa" && size >= 1e5 && size < 1e9) text += fmt::format(" ({:.6g} MPa)", 1e-6 * number);
  return text;
}

}  // namespace

std::string parameter_table(const Case& scene) {
  const auto units = units_by_key();
  std::string text, table;
  int row = -1;
  std::istringstream lines(resolved_toml(scene));
  for (std::string line; std::getline(lines, line);) {
    if (line.empty() || line[0] == '#') continue;
    if (line[0] == '[') {
      const std::size_t first = line.find_first_not_of('[');
      const std::string name = line.substr(first, line.find(']') - first);
      row = first == 2 ? (name == table ? row + 1 : 0) : -1;  // [[rows]] are numbered, as in --set
      table = name;
      continue;
    }
    const std::size_t equals = line.find(" = ");
    if (table.empty() || equals == std::string::npos) continue;  // the title stands above the table
    const std::string key = line.substr(0, equals);
    const auto unit = units.find(fmt::format("{}.{}", table, key));
    const std::string name =
        row < 0 ? fmt::format("{}.{}", table, key) : fmt::format("{}.{}.{}", table, row, key);
    text += fmt::format("  {:<30} {}\n", name,
                        readable(line.substr(equals + 3), unit == units.end() ? "" : unit->second));
  }
  return text;
}

}  // namespace crackle
