// SPDX-License-Identifier: GPL-3.0-or-later
// Rows of lists of tables, such as [[joints]]: which of their keys were given. Private to io.
#pragma once

#include <fmt/format.h>

#include <initializer_list>
#include <string>
#include <string_view>

#include "case_read.hpp"

namespace crackle {

/// One row of a list of tables, or the keys of it that begin with a prefix.
class Row {
 public:
  Row(const GivenKeys& given, std::string_view table, std::size_t row, std::string_view prefix = "")
      : given_(given), table_(table), path_(fmt::format("{}.{}", table, row)), prefix_(prefix) {}

  bool has(std::string_view key) const { return given_.has(path(key)); }
  std::string path(std::string_view key) const { return fmt::format("{}.{}{}", path_, prefix_, key); }
  Place place(std::string_view key) const { return given_.place(path(key)); }

  /// Without these keys the row has no meaning.
  void need(std::initializer_list<std::string_view> keys, std::string_view why) const {
    for (const std::string_view key : keys) {
      if (!has(key))
        fail(place(key), fmt::format("missing key {}{} in [[{}]]: {}", prefix_, key, table_, why));
    }
  }
  /// These keys would be ignored.
  void refuse(std::initializer_list<std::string_view> keys, std::string_view why) const {
    for (const std::string_view key : keys) {
      if (has(key)) fail(place(key), fmt::format("{} has no meaning here: {}", path(key), why));
    }
  }

 private:
  const GivenKeys& given_;
  std::string_view table_;
  std::string path_;
  std::string_view prefix_;
};

/// What a joint, a set of them or an interface needs by its law, and the defaults of what it leaves out.
void finish_properties(Case::JointProperties& joint, const Row& row, const Case& scene);

}  // namespace crackle
