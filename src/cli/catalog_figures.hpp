// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "crackle/seismic/b_value.hpp"

namespace crackle {

/// Draws the figures of a catalog into its run folder, by scripts/plots/draw_catalog.py (where Python and
/// its modules are there). @return what to tell the user, with a line end
std::string draw_catalog(const std::string& folder, const BValue& b);

}  // namespace crackle
