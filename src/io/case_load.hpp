// SPDX-License-Identifier: GPL-3.0-or-later
// From files to one tree: includes merged, overrides applied. Private to io.
#pragma once

#include <string>

#include "toml_tree.hpp"

namespace crackle {

/// Reads a case file and what it includes; the keys of the including file win, lists are replaced as
/// a whole. @throws CaseError, also for a cycle of includes
TomlNode load_case_file(const std::string& path);

/// The same from a text; includes are relative to the folder of `name`.
TomlNode load_case_text(const std::string& text, const std::string& name);

/// Sets "table.key=value" or "table.0.key=value" (a row of a list of tables; the row after the last
/// is added). @throws CaseError that names --set and the key
void apply_override(TomlNode& root, const std::string& assignment);

}  // namespace crackle
