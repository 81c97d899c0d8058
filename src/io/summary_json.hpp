// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "crackle/io/output.hpp"

namespace crackle {

/// The text of summary.json; a value that is not a finite number becomes null.
std::string summary_json(const RunSummary& summary);

}  // namespace crackle
