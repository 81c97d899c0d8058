// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "commands.hpp"
#include "crackle/io/output.hpp"
#include "status.hpp"

namespace crackle {

/// Runs a case in the quasi-static regime into its folder.
/// @return exit code
int run_quasi_static(const RunOptions& options, const Case& scene, RunFolder& folder, Status& status);

}  // namespace crackle
