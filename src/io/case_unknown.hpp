// SPDX-License-Identifier: GPL-3.0-or-later
// What to say about a key that no table has. Private to io.
#pragma once

#include <string>

#include "case_schema.hpp"
#include "toml_tree.hpp"

namespace crackle {

/// Names the nearest valid key or table, and the table a key belongs to if it is misplaced.
std::string unknown_key(const TomlNode& node, const TableSpec& table);

}  // namespace crackle
