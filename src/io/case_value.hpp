// SPDX-License-Identifier: GPL-3.0-or-later
// One value of a case file. Private to io.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "case_schema.hpp"
#include "crackle/core/units.hpp"
#include "toml_tree.hpp"

namespace crackle {

/// What a value is read by.
struct ValueContext {
  std::string path;  ///< "rock.density", for messages
  const KeySpec& key;
  const Units& units;
  const CaseNames& names;
};

/// Checks a value against its key and puts it into its place in the scene. @throws CaseError
void read_value(const TomlNode& value, const ValueContext& context, Case& scene, std::size_t row);

/// A list for a message: "a", "b" or "c".
std::string one_of(std::span<const std::string_view> names);

}  // namespace crackle
