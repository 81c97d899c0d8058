// SPDX-License-Identifier: GPL-3.0-or-later
#include "gmsh_names.hpp"

#include <fmt/format.h>

#include <string_view>
#include <tuple>

namespace crackle::meshing {

namespace {

/// Where the digits at the end of a name begin.
std::size_t digits_of(const std::string& name) { return name.find_last_not_of("0123456789") + 1; }

}  // namespace

std::string joint_name(const std::string& set, Index joint) {
  return set.empty() ? fmt::format("joint_{:06}", joint) : fmt::format("joint_{}_{:06}", set, joint);
}

std::string set_of_joint_name(const std::string& name) {
  std::size_t begin = std::string_view("joint").size(), end = name.size();
  const std::size_t digits = digits_of(name);
  if (digits < end && (digits == begin || name[digits - 1] == '_')) end = digits;
  while (begin < end && name[begin] == '_') ++begin;
  while (end > begin && name[end - 1] == '_') --end;
  return name.substr(begin, end - begin);
}

bool joint_name_before(const std::string& a, const std::string& b) {
  const auto key = [](const std::string& name) {
    const std::size_t stem = digits_of(name);
    const std::size_t digits = std::min(name.find_first_not_of('0', stem), name.size());
    // Of two numbers without leading zeros the longer one is larger.
    return std::tuple(stem < name.size(), name.size() - digits, name.substr(digits), name);
  };
  return key(a) < key(b);
}

}  // namespace crackle::meshing
