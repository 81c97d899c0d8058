// SPDX-License-Identifier: GPL-3.0-or-later
#include "utc_time.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string_view>

#include "crackle/core/errors.hpp"

namespace crackle {

namespace {

namespace chrono = std::chrono;

constexpr std::int64_t nanoseconds_a_second = 1'000'000'000;
constexpr std::int64_t nanoseconds_a_day = 86'400 * nanoseconds_a_second;

UtcTime shifted(UtcTime time, std::int64_t nanoseconds) {
  std::int64_t of_day = time.nanosecond + nanoseconds % nanoseconds_a_day;
  std::int64_t days = nanoseconds / nanoseconds_a_day;
  if (of_day < 0) {
    of_day += nanoseconds_a_day;
    --days;
  } else if (of_day >= nanoseconds_a_day) {
    of_day -= nanoseconds_a_day;
    ++days;
  }
  return {time.day + chrono::days{days}, of_day};
}

/// Takes a text apart from the left; what does not fit is remembered in good().
class Cursor {
 public:
  explicit Cursor(std::string_view text) : rest_(text) {}
  bool good() const { return good_; }
  bool at_end() const { return rest_.empty(); }

  bool next_is(std::string_view any_of) const {
    return !rest_.empty() && any_of.find(rest_.front()) != std::string_view::npos;
  }
  char take(std::string_view any_of) {
    good_ = good_ && next_is(any_of);
    if (!good_) return '\0';
    const char taken = rest_.front();
    rest_.remove_prefix(1);
    return taken;
  }
  int number(int digits) {
    int value = 0;
    for (int i = 0; i < digits; ++i) value = 10 * value + (take("0123456789") - '0');
    return good_ ? value : 0;
  }
  /// Digits after the point, cut after the ninth [ns].
  std::int64_t fraction() {
    std::int64_t value = 0;
    int digits = 0;
    while (next_is("0123456789")) {
      const int digit = number(1);
      if (digits < 9) value = 10 * value + digit;
      ++digits;
    }
    good_ = good_ && digits > 0;
    for (; digits < 9; ++digits) value *= 10;
    return value;
  }

 private:
  std::string_view rest_;
  bool good_ = true;
};

}  // namespace

UtcTime parse_utc(const std::string& text) {
  Cursor cursor(text);
  const int year = cursor.number(4);
  cursor.take("-");
  const int month = cursor.number(2);
  cursor.take("-");
  const int day = cursor.number(2);
  bool in_range = true;
  std::int64_t of_day = 0;  // [ns]
  std::int64_t east = 0;    // zone [s]
  if (!cursor.at_end()) {
    cursor.take("T ");
    const int hour = cursor.number(2);
    cursor.take(":");
    const int minute = cursor.number(2);
    cursor.take(":");
    const int second = cursor.number(2);
    in_range = hour < 24 && minute < 60 && second < 60;
    of_day = (3600 * hour + 60 * minute + second) * nanoseconds_a_second;
    if (cursor.next_is(".")) {
      cursor.take(".");
      of_day += cursor.fraction();
    }
    const char zone = cursor.at_end() ? 'Z' : cursor.take("Z+-");
    if (zone != 'Z') {
      const int zone_hour = cursor.number(2);
      if (cursor.next_is(":")) cursor.take(":");
      const int zone_minute = cursor.number(2);
      in_range = in_range && zone_hour < 24 && zone_minute < 60;
      east = (zone == '-' ? -60 : 60) * (60 * zone_hour + zone_minute);
    }
  }
  const chrono::year_month_day date{chrono::year{year}, chrono::month{static_cast<unsigned>(month)},
                                    chrono::day{static_cast<unsigned>(day)}};
  if (!cursor.good() || !cursor.at_end() || !in_range || !date.ok()) {
    throw CaseError("\"" + text + "\" is not a time; write it as ISO 8601 in UTC, \"2000-01-01T00:00:00Z\"");
  }
  return shifted({chrono::sys_days{date}, of_day}, -east * nanoseconds_a_second);
}

UtcTime later(UtcTime time, double seconds) {
  // whole seconds apart, so that the product with 1e9 does not overflow
  const double whole = std::floor(seconds);
  const auto nanoseconds = std::llround((seconds - whole) * 1e9);
  return shifted(shifted(time, static_cast<std::int64_t>(whole) * nanoseconds_a_second), nanoseconds);
}

std::string to_iso8601(const UtcTime& time) {
  const chrono::year_month_day date{time.day};
  const std::int64_t second = time.nanosecond / nanoseconds_a_second;
  return fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}.{:09}Z", static_cast<int>(date.year()),
                     static_cast<unsigned>(date.month()), static_cast<unsigned>(date.day()), second / 3600,
                     second / 60 % 60, second % 60, time.nanosecond % nanoseconds_a_second);
}

double decimal_year(const UtcTime& time) {
  const chrono::year_month_day date{time.day};
  const chrono::sys_days start{date.year() / chrono::January / 1};
  const double days = static_cast<double>((time.day - start).count()) +
                      static_cast<double>(time.nanosecond) / static_cast<double>(nanoseconds_a_day);
  return static_cast<int>(date.year()) + days / (date.year().is_leap() ? 366.0 : 365.0);
}

std::string wall_clock() {
  const auto now = chrono::floor<chrono::seconds>(chrono::system_clock::now());
  const auto day = chrono::floor<chrono::days>(now);
  const UtcTime time{day, (now - day).count() * nanoseconds_a_second};
  return to_iso8601(time).substr(0, 19) + "Z";
}

}  // namespace crackle
