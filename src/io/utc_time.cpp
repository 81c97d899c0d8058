// SPDX-License-Identifier: GPL-3.0-or-later
#include "utc_time.hpp"

#include <fmt/format.h>

#include <cmath>
#include <regex>

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

/// Nanoseconds of a decimal fraction ("" or ".25"), cut after the ninth digit.
std::int64_t fraction(const std::string& digits) {
  std::string nine = digits.empty() ? "" : digits.substr(1, 9);
  nine.resize(9, '0');
  return std::stoll(nine);
}

}  // namespace

UtcTime parse_utc(const std::string& text) {
  static const std::regex pattern(
      R"((\d{4})-(\d\d)-(\d\d)(?:[T ](\d\d):(\d\d):(\d\d)(\.\d+)?(?:Z|([+-])(\d\d):?(\d\d))?)?)");
  const auto refuse = [&text] {
    throw CaseError("\"" + text + "\" is not a time; write it as ISO 8601 in UTC, \"2000-01-01T00:00:00Z\"");
  };
  std::smatch part;
  if (!std::regex_match(text, part, pattern)) refuse();
  const auto number = [&part](std::size_t i) { return part[i].matched ? std::stoi(part[i].str()) : 0; };

  const chrono::year_month_day date{chrono::year{number(1)}, chrono::month{static_cast<unsigned>(number(2))},
                                    chrono::day{static_cast<unsigned>(number(3))}};
  if (!date.ok() || number(4) > 23 || number(5) > 59 || number(6) > 59 || number(9) > 23 || number(10) > 59) {
    refuse();
  }
  const std::int64_t seconds = 3600 * number(4) + 60 * number(5) + number(6);
  const UtcTime local{chrono::sys_days{date}, seconds * nanoseconds_a_second + fraction(part[7].str())};
  const std::int64_t east = 3600 * number(9) + 60 * number(10);
  return shifted(local, (part[8] == "-" ? east : -east) * nanoseconds_a_second);
}

UtcTime later(UtcTime time, double seconds) {
  // whole seconds apart: a double holds 200 years of seconds to the nanosecond of neither part
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
