// SPDX-License-Identifier: GPL-3.0-or-later
// Calendar time to the nanosecond: a run lasts milliseconds. Private to io.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace crackle {

/// A moment in UTC; leap seconds are not counted, as in POSIX.
struct UtcTime {
  std::chrono::sys_days day{};
  std::int64_t nanosecond = 0;  ///< of the day, 0 <= nanosecond < 86400e9

  friend bool operator==(const UtcTime&, const UtcTime&) = default;
};

/// Reads ISO 8601: "2015-06-01", "2015-06-01T12:30:00Z", with a fraction of a second and "+02:00" in
/// place of "Z"; no zone is UTC. @throws CaseError
UtcTime parse_utc(const std::string& text);

/// @param seconds may be negative [s]
UtcTime later(UtcTime time, double seconds);

/// ISO 8601 with nine decimals: "2015-06-01T12:30:00.001080250Z".
std::string to_iso8601(const UtcTime& time);

/// Year with its passed fraction: the middle of a leap year and of a common one are both .5.
double decimal_year(const UtcTime& time);

/// The wall clock, to the second: "2015-06-01T12:30:00Z".
std::string wall_clock();

}  // namespace crackle
