// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "crackle/io/output.hpp"

namespace crackle {

/// The text of status.json, with the wall-clock time, the host and the process that writes it.
std::string status_json(const RunStatus& status);

}  // namespace crackle
