// SPDX-License-Identifier: GPL-3.0-or-later
#include "case_value.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <utility>

#include "crackle/core/errors.hpp"
#include "crackle/core/nearest.hpp"

namespace crackle {
namespace {

using Kind = TomlNode::Kind;

/// A value as it stands in the file.
std::string as_written(const TomlNode& value) {
  switch (value.kind) {
    case Kind::text:
      return shown(value.text);
    case Kind::integer:
      return fmt::format("{}", value.integer);
    case Kind::number:
      return fmt::format("{}", value.number);
    default:
      return std::string(kind_name(value.kind));
  }
}

[[noreturn]] void wrong_type(const TomlNode& value, const ValueContext& context, std::string_view expected) {
  fail(value.place, fmt::format("{} must be {}, not {}", context.path, expected, kind_name(value.kind)));
}

void check_range(double number, const TomlNode& value, const ValueContext& context) {
  if (std::isfinite(number) && context.key.range.holds(number)) return;
  const Quantity* quantity = context.key.quantity;
  std::string_view unit = quantity ? quantity->units[0] : "";
  if (unit == "1" || value.kind == Kind::text) unit = "";
  fail(value.place,
       fmt::format(
           "{} = {}{}{} is out of range: must be {}{}", context.path, as_written(value),
           unit.empty() ? "" : " ", unit, std::isfinite(number) ? context.key.range.text : "finite",
           quantity && unit == "rad" ? fmt::format("; with a unit, for example {}", quantity->example) : ""));
}

double read_number(const TomlNode& value, const ValueContext& context) {
  const Quantity& quantity = *context.key.quantity;
  const std::string_view word = context.key.zero_word;
  double number = value.number;
  if (value.kind == Kind::text) {
    if (!word.empty() && value.text == word) return 0.0;
    try {
      number = context.units.convert(value.text, quantity.units);
    } catch (const UnitError&) {
      fail(value.place, fmt::format("{} = {} is not {} in units of {}; write for example {}{}", context.path,
                                    shown(value.text), quantity.name, fmt::join(quantity.units, " or "),
                                    quantity.example, word.empty() ? "" : fmt::format(" or \"{}\"", word)));
    }
  } else if (value.kind != Kind::integer && value.kind != Kind::number) {
    wrong_type(value, context, fmt::format("{}, for example {}", quantity.name, quantity.example));
  }
  check_range(number, value, context);
  return number;
}

/// An integer that fits T.
template <class T>
T read_count(const TomlNode& value, const ValueContext& context) {
  if (value.kind != Kind::integer) wrong_type(value, context, "a whole number");
  check_range(value.number, value, context);
  if (!std::in_range<T>(value.integer)) {
    fail(value.place, fmt::format("{} = {} is too large", context.path, value.integer));
  }
  return static_cast<T>(value.integer);
}

void check_choice(const TomlNode& value, const ValueContext& context) {
  std::vector<std::string_view> choices = context.key.choices;
  if (choices.empty()) return;
  if (const auto more = context.names.more.find(context.path); more != context.names.more.end()) {
    choices.insert(choices.end(), more->second.begin(), more->second.end());
  }
  if (std::ranges::find(choices, value.text) != choices.end()) return;
  fail(value.place,
       fmt::format(
           "{} = {} is unknown: write {}{}", context.path, shown(value.text), one_of(choices),
           choices.size() > 1 ? fmt::format("; the nearest is \"{}\"", nearest(value.text, choices)) : ""));
}

std::string read_text(const TomlNode& value, const ValueContext& context) {
  const bool moment = value.kind == Kind::date && context.key.check;  // TOML has dates of its own
  if (value.kind != Kind::text && !moment) wrong_type(value, context, "a text in quotes");
  if (value.text.find('\0') != std::string::npos)
    fail(value.place, context.path + " cannot hold a zero byte");
  check_choice(value, context);
  if (context.key.check) {
    try {
      context.key.check(value.text);
    } catch (const CaseError& error) {
      fail(value.place, fmt::format("{}: {}", context.path, error.what()));
    }
  }
  return value.text;
}

std::vector<std::string> read_texts(const TomlNode& value, const ValueContext& context) {
  if (value.kind != Kind::array) wrong_type(value, context, "a list of texts");
  std::vector<std::string> texts;
  for (const TomlNode& child : value.children) texts.push_back(read_text(child, context));
  return texts;
}

}  // namespace

std::string one_of(std::span<const std::string_view> names) {
  std::string list;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (i > 0) list += i + 1 == names.size() ? " or " : ", ";
    list += fmt::format("\"{}\"", names[i]);
  }
  return list;
}

void read_value(const TomlNode& value, const ValueContext& context, Case& scene, std::size_t row) {
  const auto put = [&](auto slot) {
    using Slotted = decltype(slot);
    if constexpr (std::is_same_v<Slotted, Ref<double>> ||
                  std::is_same_v<Slotted, Ref<std::optional<double>>>) {
      slot(scene, row) = read_number(value, context);
    } else if constexpr (std::is_same_v<Slotted, Ref<int>>) {
      slot(scene, row) = read_count<int>(value, context);
    } else if constexpr (std::is_same_v<Slotted, Ref<std::uint64_t>> ||
                         std::is_same_v<Slotted, Ref<std::optional<std::uint64_t>>>) {
      slot(scene, row) = read_count<std::uint64_t>(value, context);
    } else if constexpr (std::is_same_v<Slotted, Ref<bool>>) {
      if (value.kind != Kind::boolean) wrong_type(value, context, "true or false");
      slot(scene, row) = value.truth;
    } else if constexpr (std::is_same_v<Slotted, Ref<std::string>>) {
      slot(scene, row) = read_text(value, context);
    } else if constexpr (std::is_same_v<Slotted, Ref<std::vector<std::string>>>) {
      slot(scene, row) = read_texts(value, context);
    }
  };
  std::visit(put, context.key.slot);
}

}  // namespace crackle
