// SPDX-License-Identifier: GPL-3.0-or-later
//
// Any struct of numbers as a list of named columns, for a file that does not know the struct.
//
// A struct takes part by a function `members(T&, visit)` beside it that calls visit("name", member)
// for every member; one that forgets a member is found out. Structs in structs become "outer/inner", a list
// of structs one column a member, an array of structs "name0", "name1", ...; Vec2, Sym2 and arrays of numbers
// are one column of several components. What is shared (std::shared_ptr) gets no column.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

#include "crackle/core/vec2.hpp"

namespace crackle {

enum class Number : std::uint8_t { float64, int64, int32, uint16, int8, uint8 };

/// Bytes that a number takes.
constexpr std::size_t size_of(Number number) {
  switch (number) {
    case Number::float64:
    case Number::int64:
      return 8;
    case Number::int32:
      return 4;
    case Number::uint16:
      return 2;
    default:
      return 1;
  }
}

/// The same member of every item of a list (or of one struct), somewhere in memory.
struct Column {
  std::string name;  ///< "state/cohesive/histories/fracture_energy"
  Number number = Number::float64;
  std::size_t components = 1;  ///< numbers an item, one after the other
  bool list = false;           ///< the number of items may change
  std::size_t count = 1;       ///< items
  /// Copies all numbers to a place, item after item.
  std::function<void(std::byte* to)> gather;
  /// Copies the numbers of so many items back (only a list may get another number than count).
  std::function<void(const std::byte* from, std::size_t count)> scatter;

  std::size_t item_bytes() const { return components * size_of(number); }
};

namespace columns_detail {

template <class T>
inline constexpr bool is_number = std::is_arithmetic_v<T> || std::is_enum_v<T>;
template <class T>
inline constexpr bool is_array = false;
template <class T, std::size_t count>
inline constexpr bool is_array<std::array<T, count>> = true;
template <class T>
inline constexpr bool is_list = false;
template <class T>
inline constexpr bool is_list<std::vector<T>> = true;

template <class T>
inline constexpr bool is_shared = false;
template <class T>
inline constexpr bool is_shared<std::shared_ptr<T>> = true;

struct Anything {
  template <class T>
  operator T() const;  // NOLINT(google-explicit-constructor): stands for an initialiser; never called
};

// Members of an aggregate: the largest number of initialisers that it takes.
template <class T, class... Given>
consteval std::size_t member_count() {
  if constexpr (requires { T{Given{}..., Anything{}}; }) {
    return member_count<T, Given..., Anything>();
  } else {
    return sizeof...(Given);
  }
}

template <class T>
constexpr Number number_of() {
  if constexpr (std::is_enum_v<T>) {
    return number_of<std::underlying_type_t<T>>();
  } else if constexpr (std::is_same_v<T, double>) {
    return Number::float64;
  } else if constexpr (std::is_unsigned_v<T>) {
    static_assert(!std::is_same_v<T, bool> && sizeof(T) <= 2, "not one of Number");
    return sizeof(T) == 2 ? Number::uint16 : Number::uint8;
  } else {
    static_assert(std::is_integral_v<T> && sizeof(T) != 2, "not one of Number");
    return sizeof(T) == 8 ? Number::int64 : sizeof(T) == 4 ? Number::int32 : Number::int8;
  }
}

// One item, or all items of a list; `sample` is where the item lies that members are found in.
struct Owner {
  bool list = false;
  std::size_t count = 1, stride = 0;
  std::function<std::byte*(std::size_t count)> first;  // makes room for so many
  const std::byte* sample = nullptr;
};

template <class T>
const std::byte* address(const T& item) {
  return reinterpret_cast<const std::byte*>(&item);
}

// Names: one after the other, each with a zero behind it.
inline void add_names(std::vector<Column>& columns, const std::string& name,
                      std::vector<std::string>& names) {
  std::size_t bytes = 0;
  for (const std::string& n : names) bytes += n.size() + 1;
  columns.push_back({name, Number::uint8, 1, true, bytes,
                     [&names](std::byte* to) {
                       for (const std::string& n : names) {
                         std::memcpy(to, n.c_str(), n.size() + 1);
                         to += n.size() + 1;
                       }
                     },
                     [&names](const std::byte* from, std::size_t count) {
                       names.clear();
                       const std::string all(reinterpret_cast<const char*>(from), count);
                       for (std::size_t at = 0; at < all.size(); at += names.back().size() + 1)
                         names.emplace_back(all.c_str() + at);
                     }});
}

inline void add_numbers(std::vector<Column>& columns, const std::string& name, Number number,
                        std::size_t components, std::ptrdiff_t offset, const Owner& owner) {
  const std::size_t bytes = components * size_of(number);
  columns.push_back({name, number, components, owner.list, owner.count,
                     [owner, offset, bytes](std::byte* to) {
                       if (owner.count == 0) return;
                       const std::byte* from = owner.first(owner.count) + offset;
                       for (std::size_t i = 0; i < owner.count; ++i)
                         std::memcpy(to + i * bytes, from + i * owner.stride, bytes);
                     },
                     [owner, offset, bytes](const std::byte* from, std::size_t count) {
                       std::byte* first = owner.first(count);
                       for (std::size_t i = 0; i < count; ++i)
                         std::memcpy(first + offset + i * owner.stride, from + i * bytes, bytes);
                     }});
}

template <class T>
void add(std::vector<Column>& columns, const std::string& name, T& item, const Owner& owner) {
  const auto push = [&](Number number, std::size_t components) {
    add_numbers(columns, name, number, components, address(item) - owner.sample, owner);
  };
  if constexpr (is_number<T>) {
    push(number_of<T>(), 1);
  } else if constexpr (std::is_same_v<T, Vec2> || std::is_same_v<T, Sym2>) {
    push(Number::float64, sizeof(T) / sizeof(double));
  } else if constexpr (is_array<T>) {
    if constexpr (is_number<typename T::value_type>) {
      push(number_of<typename T::value_type>(), item.size());
    } else {
      for (std::size_t i = 0; i < item.size(); ++i) add(columns, name + std::to_string(i), item[i], owner);
    }
  } else if constexpr (std::is_same_v<T, std::vector<std::string>>) {
    add_names(columns, name, item);
  } else if constexpr (is_list<T>) {
    using Item = typename T::value_type;
    Item sample{};
    add(columns, name, sample,
        Owner{true, item.size(), sizeof(Item),
              [&item](std::size_t count) {
                if (item.size() != count) item.resize(count);
                return reinterpret_cast<std::byte*>(item.data());
              },
              address(sample)});
  } else if constexpr (!is_shared<T>) {
    std::size_t named = 0;
    members(item, [&](const char* member, auto& value) {
      add(columns, name + "/" + member, value, owner);
      ++named;
    });
    if (named != member_count<T>()) {
      throw std::logic_error(name + ": members() names " + std::to_string(named) + " members of " +
                             std::to_string(member_count<T>()));
    }
  }
}

}  // namespace columns_detail

/// All columns of a struct, which must live as long as they do. Writing through them changes it.
/// @throws std::logic_error where members() of a struct does not name all its members
template <class T>
std::vector<Column> columns_of(T& item, const std::string& name) {
  std::vector<Column> columns;
  columns_detail::add(
      columns, name, item,
      {false, 1, sizeof(T), [&item](std::size_t) { return reinterpret_cast<std::byte*>(&item); },
       columns_detail::address(item)});
  return columns;
}

}  // namespace crackle
