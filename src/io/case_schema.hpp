// SPDX-License-Identifier: GPL-3.0-or-later
// The one table of all keys of a case file. Reading, checking, resolved.toml and case_keys() walk it:
// a new key is one line in case_schema.cpp. Private to io.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "crackle/io/case.hpp"

namespace crackle {

/// The member of a Case that a key fills; `row` counts tables of a list such as [[fluid.pump]].
template <class T>
using Ref = T& (*)(Case&, std::size_t row);
using Slot = std::variant<std::monostate, Ref<double>, Ref<std::optional<double>>, Ref<int>,
                          Ref<std::uint64_t>, Ref<std::optional<std::uint64_t>>, Ref<bool>, Ref<std::string>,
                          Ref<std::vector<std::string>>>;

/// What a number measures.
struct Quantity {
  std::string_view name;                ///< for messages, with its article
  std::vector<std::string_view> units;  ///< the first is SI; the others are taken for it one to one
  std::string_view example;             ///< a value as a case file writes it
};

/// The values that a number may have.
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_allowed = true;
  bool high_allowed = true;
  std::string_view text = {};  ///< "above 0: why"
  bool holds(double value) const {
    return (low_allowed ? value >= low : value > low) && (high_allowed ? value <= high : value < high);
  }
};

/// When a case must give a key.
enum class Need { never, always, without_mesh_file, with_pump };

struct KeySpec {
  std::string_view key = {};
  Slot slot = {};  ///< none: the loader of files reads it
  Need need = Need::never;
  std::string_view meaning = {};
  std::string_view fallback = {};      ///< the default in words, where it is not the value in Case{}
  const Quantity* quantity = nullptr;  ///< of a number
  Range range = {};                    ///< of a number or a count, in SI
  std::string_view zero_word = {};     ///< the word that stands for 0, which is then outside the range
  std::vector<std::string_view> choices = {};        ///< of a text; empty: any
  void (*check)(const std::string& text) = nullptr;  ///< of a text; throws CaseError
};

struct TableSpec {
  std::string_view name = {};  ///< "rock", "fluid.pump"; empty: the top of the file
  std::vector<KeySpec> keys = {};
  std::size_t (*rows)(const Case&) = nullptr;    ///< of a list of tables
  void (*resize)(Case&, std::size_t) = nullptr;  ///< of a list of tables
};

/// Every table and key, in the order of resolved.toml.
const std::vector<TableSpec>& case_tables();

/// Null if there is none.
const TableSpec* find_table(std::string_view name);
const KeySpec* find_key(const TableSpec& table, std::string_view key);

/// "rock.density"; "title" at the top.
std::string join_path(std::string_view table, std::string_view key);

/// Whether this case must give the key.
bool is_needed(const KeySpec& key, const Case& scene);

}  // namespace crackle
