// SPDX-License-Identifier: GPL-3.0-or-later
//
// The catalog format of ZMAP (Wiemer 2001, Seismological Research Letters 72). The third column is the
// year with its fraction, to 1e-12 of a year (32 microseconds); the seconds have nine decimals.
#include "zmap.hpp"

#include <fmt/format.h>

#include "geographic.hpp"
#include "utc_time.hpp"

namespace crackle {

std::string zmap_text(const std::vector<SeismicEvent>& events, const Case& scene) {
  const UtcTime epoch = parse_utc(scene.seismic.epoch);
  std::string text;
  for (const SeismicEvent& event : events) {
    const Geographic place = to_geographic(event.place, scene.seismic);
    const UtcTime time = later(epoch, event.time);
    const std::chrono::year_month_day date{time.day};
    const std::int64_t second = time.nanosecond / 1'000'000'000;
    text += fmt::format("{}\t{}\t{:.12f}\t{}\t{}\t{}\t{}\t{}\t{}\t{}.{:09}\n", place.longitude,
                        place.latitude, decimal_year(time), static_cast<unsigned>(date.month()),
                        static_cast<unsigned>(date.day()), event.magnitude, place.depth / 1000.0,
                        second / 3600, second / 60 % 60, second % 60, time.nanosecond % 1'000'000'000);
  }
  return text;
}

}  // namespace crackle
