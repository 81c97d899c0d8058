// SPDX-License-Identifier: GPL-3.0-or-later
#include "gmsh_names.hpp"

#include <fmt/format.h>

#include <tuple>

namespace crackle::meshing {

std::string joint_name(Index joint) { return fmt::format("joint_{:06}", joint); }

bool joint_name_before(const std::string& a, const std::string& b) {
  const auto key = [](const std::string& name) {
    const std::size_t stem = name.find_last_not_of("0123456789") + 1;
    const std::size_t digits = std::min(name.find_first_not_of('0', stem), name.size());
    // Of two numbers without leading zeros the longer one is larger.
    return std::tuple(name.substr(0, stem), name.size() - digits, name.substr(digits), name);
  };
  return key(a) < key(b);
}

}  // namespace crackle::meshing
