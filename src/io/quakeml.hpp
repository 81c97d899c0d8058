// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "crackle/io/case.hpp"
#include "crackle/seismic/event.hpp"

namespace crackle {

/// The events as a QuakeML 1.2 document (basic event description); valid without events too.
/// @throws CaseError when the epoch of the case is not a time
std::string quakeml_text(const std::vector<SeismicEvent>& events, const Case& scene);

}  // namespace crackle
