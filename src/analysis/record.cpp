// SPDX-License-Identifier: GPL-3.0-or-later
#include "crackle/analysis/record.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace crackle {
namespace {

constexpr std::size_t fewest_samples = 20;
constexpr double rest_rate = 0.05;                       ///< of the largest rate
constexpr double lowest_peak = 1e4, highest_peak = 1e9;  // of a pressure in a well [Pa]

/// A stretch of samples that are all pumped or all at rest.
struct Stretch {
  bool pumped = false;
  std::size_t first = 0, end = 0;
};

std::vector<Stretch> stretches_of(const PressureRecord& record) {
  const double largest = *std::max_element(record.rate.begin(), record.rate.end());
  std::vector<Stretch> stretches;
  for (std::size_t i = 0; i < record.rate.size(); ++i) {
    const bool pumped = std::abs(record.rate[i]) > rest_rate * largest;  // also where fluid flows back
    if (stretches.empty() || stretches.back().pumped != pumped) stretches.push_back({pumped, i, i});
    stretches.back().end = i + 1;
  }
  return stretches;
}

/// From its first sample to the first one after it [s].
double duration(const PressureRecord& record, const Stretch& s) {
  return record.time[std::min(s.end, record.time.size() - 1)] - record.time[s.first];
}

void check_sizes(const PressureRecord& record) {
  const std::size_t n = record.time.size();
  if (record.pressure.size() != n || record.rate.size() != n)
    throw record_error(record, 0, "time, pressure and rate have unequal numbers of samples");
  for (const auto& [name, values] : record.truth) {
    if (values.size() != n) throw record_error(record, 0, name + " has another number of samples than time");
  }
  if (n < fewest_samples) {
    throw record_error(record, n,
                       fmt::format("the record ends after {} samples; {} are the fewest that can be analysed",
                                   n, fewest_samples));
  }
}

void check_values(const PressureRecord& record) {
  for (std::size_t i = 0; i < record.time.size(); ++i) {
    if (!std::isfinite(record.time[i]) || !std::isfinite(record.pressure[i]) ||
        !std::isfinite(record.rate[i])) {
      throw record_error(record, i, "time, pressure or rate is not a finite number");
    }
    if (i > 0 && !(record.time[i] > record.time[i - 1])) {
      throw record_error(record, i,
                         fmt::format("time does not rise: {} s after {} s; sort the samples by time and "
                                     "keep one of each time",
                                     record.time[i], record.time[i - 1]));
    }
  }
}

void check_pressures(const PressureRecord& record) {
  const auto top = std::max_element(record.pressure.begin(), record.pressure.end());
  if (*top >= lowest_peak && *top <= highest_peak) return;
  throw record_error(record, static_cast<std::size_t>(top - record.pressure.begin()),
                     fmt::format("the largest pressure is {:.6g} Pa, which no well sees: is the unit of the "
                                 "pressure right?",
                                 *top));
}

double median_interval(const PressureRecord& record, std::size_t first, std::size_t end) {
  std::vector<double> intervals;
  for (std::size_t i = first; i + 1 < end; ++i) intervals.push_back(record.time[i + 1] - record.time[i]);
  if (intervals.empty()) return 0.0;
  const auto middle = intervals.begin() + static_cast<std::ptrdiff_t>(intervals.size() / 2);
  std::nth_element(intervals.begin(), middle, intervals.end());
  return *middle;
}

/// Compared with the samples around it: a logger may change its rate, and a log of a fall-off may
/// thin out with time.
void check_holes(const PressureRecord& record) {
  constexpr std::size_t around = 10;
  constexpr double longer = 10.0, share = 0.05;
  for (const Stretch& s : stretches_of(record)) {
    const std::size_t last = std::min(s.end, record.time.size() - 1);
    for (std::size_t i = s.first; i < last; ++i) {
      const double interval = record.time[i + 1] - record.time[i];
      if (interval <= share * (record.time[i + 1] - record.time[s.first])) continue;
      const double before = median_interval(record, i - std::min(i, around), i + 1);
      const double after = median_interval(record, i + 1, std::min(i + 2 + around, record.time.size()));
      if (before == 0.0 || after == 0.0 || interval <= longer * std::max(before, after)) continue;
      throw record_error(record, i + 1,
                         fmt::format("nothing was recorded for {:.6g} s before this sample, where others "
                                     "follow each other by {:.3g} s; cut the record there",
                                     interval, std::max(before, after)));
    }
  }
}

/// Injected between two times, from a sample on [m3 or m2].
double volume_between(const PressureRecord& record, std::size_t first, double from, double to) {
  double volume = 0.0;
  for (std::size_t i = first; i + 1 < record.time.size() && record.time[i] < to; ++i) {
    const double t0 = std::max(from, record.time[i]), t1 = std::min(to, record.time[i + 1]);
    if (t1 <= t0) continue;
    // pumps are switched: the rate of a sample holds until the next one
    volume += record.rate[i] * (t1 - t0);
  }
  return volume;
}

Injection describe(const PressureRecord& record, std::size_t first, const Stretch& rest, double shut_in) {
  Injection found;
  found.start = record.time[first];
  found.shut_in = shut_in;
  found.shut_in_sample = rest.first;
  while (found.shut_in_sample < rest.end && record.time[found.shut_in_sample] < shut_in)
    ++found.shut_in_sample;
  found.end_sample = rest.end;
  found.volume = volume_between(record, first, found.start, shut_in);
  found.earlier_volume = volume_between(record, 0, record.time[0], found.start);
  const double fifth = 0.2 * (shut_in - found.start);
  found.rate = volume_between(record, first, shut_in - fifth, shut_in) / fifth;
  const auto begin = record.pressure.begin() + static_cast<std::ptrdiff_t>(first);
  const auto end = record.pressure.begin() + static_cast<std::ptrdiff_t>(found.shut_in_sample);
  const auto top = std::max_element(begin, end);
  found.breakdown_pressure = *top;
  found.breakdown_time = record.time[static_cast<std::size_t>(top - record.pressure.begin())];
  found.shut_in_pressure = *(end - 1);
  return found;
}

}  // namespace

CaseError record_error(const PressureRecord& record, std::size_t sample, const std::string& message) {
  std::string place = record.source.empty() ? "record" : record.source;
  if (!record.lines.empty()) {
    place += fmt::format(":{}", record.lines[std::min(sample, record.lines.size() - 1)]);
  }
  return CaseError(place + ": " + message);
}

void check_record(const PressureRecord& record) {
  check_sizes(record);
  check_values(record);
  check_pressures(record);
  check_holes(record);
}

Injection find_injection(const PressureRecord& record, std::optional<double> shut_in) {
  const std::vector<Stretch> stretches = stretches_of(record);
  const double largest = *std::max_element(record.rate.begin(), record.rate.end());
  if (largest <= 0.0) throw record_error(record, 0, "nothing is pumped: no rate is above 0");
  std::optional<Injection> best;
  double longest = 0.0;
  std::size_t first = 0;  // sample at which the injection began
  double pumped = 0.0;    // time of pumping since then [s]
  for (std::size_t k = 0; k < stretches.size(); ++k) {
    const Stretch& s = stretches[k];
    if (s.pumped) {
      if (pumped == 0.0) first = s.first;
      pumped += duration(record, s);
      continue;
    }
    if (pumped == 0.0) continue;
    const double rest = duration(record, s);
    const double from = shut_in.value_or(record.time[s.first]);
    const bool asked = shut_in && *shut_in > record.time[first] && *shut_in < record.time[s.end - 1];
    if (shut_in ? (asked && !best) : rest > longest) {
      best = describe(record, first, s, from);
      longest = rest;
    }
    if (rest > pumped) pumped = 0.0;
  }
  if (!best) {
    const std::string where =
        shut_in ? fmt::format("at {:.6g} s", *shut_in)
                : fmt::format("(the rate never falls below {:.3g} m3/s)", rest_rate * largest);
    throw record_error(record, record.time.size(), "there is no shut-in " + where);
  }
  const std::size_t samples = best->end_sample - best->shut_in_sample;
  if (samples < fewest_samples) {
    throw record_error(record, best->end_sample - 1,
                       fmt::format("the fall-off after shut-in at {:.6g} s has {} samples; {} are the fewest "
                                   "that can be analysed",
                                   best->shut_in, samples, fewest_samples));
  }
  return *best;
}

}  // namespace crackle
