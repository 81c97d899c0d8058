// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "crackle/io/case.hpp"
#include "crackle/seismic/event.hpp"

namespace crackle {

/// The events as ten tab-separated columns, no header: longitude, latitude, decimal year, month, day,
/// magnitude, depth [km], hour, minute, second.
/// @throws CaseError when the epoch of the case is not a time
std::string zmap_text(const std::vector<SeismicEvent>& events, const Case& scene);

}  // namespace crackle
