// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "crackle/core/errors.hpp"
#include "crackle/io/case.hpp"

namespace crackle {

/// Names that case keys take beyond those of the case reader: all registered laws.
CaseNames registered_names();

/// The case of a file, with what the command line says on top. @throws CaseError
Case load_case(const std::string& file, std::vector<std::string> overrides, std::optional<std::string> seed);

/// A quantity given on the command line: a number in SI, or a text with a unit ("3 mm").
/// @param option names it in messages @throws CaseError
double quantity(const std::string& option, const std::string& text, std::string_view unit);

/// An error on a name that is not among those known, with the nearest one.
CaseError unknown_name(const std::string& what, const std::string& name,
                       const std::vector<std::string>& known);

}  // namespace crackle
