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

template <auto Member, auto... Rest>
auto& follow(auto& table, std::size_t row) {
  if constexpr (sizeof...(Rest) == 0) {
    return table.*Member;
  } else {
    return follow<Rest...>(pick(table.*Member, row), row);
  }
}

template <auto... Path>
Slot slot() {
  using T = std::remove_reference_t<decltype(follow<Path...>(std::declval<Case&>(), 0))>;
  return Ref<T>([](Case& scene, std::size_t row) -> T& { return follow<Path...>(scene, row); });
}

/// A list of tables, one element of the vector at Path each.
template <auto... Path>
TableSpec rows_of(std::string_view name, std::vector<KeySpec> keys) {
  return {.name = name,
          .keys = std::move(keys),
          .rows = [](const Case& scene) { return follow<Path...>(scene, 0).size(); },
          .resize = [](Case& scene, std::size_t n) { follow<Path...>(scene, 0).resize(n); }};
}

}  // namespace crackle
