// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "crackle/io/case.hpp"

namespace crackle {

/// Every value of a case as a table for people: key, value in SI, unit.
std::string parameter_table(const Case& scene);

}  // namespace crackle
