// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "crackle/io/output.hpp"

namespace crackle {

/// First line of history.csv, with its line end. @param loads their names
std::string history_header(const std::vector<std::string>& loads = {});
/// A row, with its line end; numbers in the shortest form that reads back to the same value.
std::string history_line(const HistoryRow& row);
/// The same of a run in field time.
std::string field_time_header();
std::string field_time_line(const FieldTimeRow& row);

}  // namespace crackle
