// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "commands.hpp"
#include "crackle/io/output.hpp"
#include "status.hpp"

namespace crackle {

/// Runs a case by explicit steps into its folder.
/// @return exit code
int run_dynamic(const RunOptions& options, const Case& scene, RunFolder& folder, Status& status);

}  // namespace crackle
