// SPDX-License-Identifier: GPL-3.0-or-later
// Slots from pointers to members: slot<&Case::rock, &Case::Rock::density>() is where rock.density lies.
// Private to io.
#pragma once

#include <type_traits>
#include <utility>

#include "case_schema.hpp"

namespace crackle {

template <class T>
T& pick(T& table, std::size_t) {
  return table;
}
template <class T>
T& pick(std::vector<T>& rows, std::size_t row) {
  return rows[row];
}

template <auto member, auto... rest>
auto& follow(auto& table, std::size_t row) {
  if constexpr (sizeof...(rest) == 0) {
    return table.*member;
  } else {
    return follow<rest...>(pick(table.*member, row), row);
  }
}

template <auto... path>
Slot slot() {
  using T = std::remove_reference_t<decltype(follow<path...>(std::declval<Case&>(), 0))>;
  return Ref<T>([](Case& scene, std::size_t row) -> T& { return follow<path...>(scene, row); });
}

/// A list of tables, one element of the vector at `path` each.
template <auto... path>
TableSpec rows_of(std::string_view name, const std::vector<KeySpec>& keys) {
  return {.name = name,
          .keys = keys,
          .rows = [](const Case& scene) { return follow<path...>(scene, 0).size(); },
          .resize = [](Case& scene, std::size_t n) { follow<path...>(scene, 0).resize(n); }};
}

}  // namespace crackle
