// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "crackle/seismic/event.hpp"

namespace crackle {

/// First line of events.csv, with its line end.
std::string events_header();
/// A row, with its line end; numbers in the shortest form that reads back to the same value.
std::string event_line(const SeismicEvent& event);

}  // namespace crackle
