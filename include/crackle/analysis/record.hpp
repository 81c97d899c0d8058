// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "crackle/core/errors.hpp"

namespace crackle {

/// The record of a pump-in and its fall-off: one value a sample in every array.
struct PressureRecord {
  std::vector<double> time;      ///< [s], rising
  std::vector<double> pressure;  ///< in the well [Pa]
  std::vector<double> rate;      ///< injected [m3/s]; of a run in the plane, per metre of height [m2/s]
  bool per_metre = false;        ///< whether rates are per metre of height
  /// What no field record knows, by the name of its column: closure_stress_Pa, contact_fraction,
  /// half_length_m of a simulated test; each as long as the others.
  std::map<std::string, std::vector<double>> truth;
  std::string source;      ///< file, for messages
  std::vector<int> lines;  ///< of each sample in that file, from 1, for messages; may be empty
};

/// An error at a sample of a record: "file:line: message".
CaseError record_error(const PressureRecord& record, std::size_t sample, const std::string& message);

/// Refuses a record that cannot be analysed: arrays of unequal length, fewer than 20 samples, a value
/// that is not finite, time that does not rise, pressures that are no pressures in Pa, a hole in the
/// sampling. A hole is an interval of more than ten times those around it and of more than a twentieth
/// of the time since the last change between pumping and rest. @throws CaseError
void check_record(const PressureRecord& record);

/// One injection and the fall-off that follows it.
struct Injection {
  double start = 0.0;               ///< when pumping began [s]
  double shut_in = 0.0;             ///< when it ended [s]
  std::size_t shut_in_sample = 0;   ///< first sample at rest
  std::size_t end_sample = 0;       ///< one past the last sample of the fall-off
  double volume = 0.0;              ///< injected from start to shut-in [m3 or m2]
  double earlier_volume = 0.0;      ///< injected before start, by earlier cycles [m3 or m2]
  double rate = 0.0;                ///< at the end: mean over the last fifth of pumping [m3/s or m2/s]
  double shut_in_pressure = 0.0;    ///< last pressure while pumping [Pa]
  double breakdown_time = 0.0;      ///< of the largest pressure while pumping [s]
  double breakdown_pressure = 0.0;  ///< [Pa]
};

/// Finds the injection with the longest fall-off, or the one that a given shut-in ends. A sample is
/// at rest where the rate is below a twentieth of the largest; a rest no longer than the pumping
/// before it belongs to the same injection. Time of shut-in: the first sample at rest.
/// @param shut_in time [s] that replaces the one found
/// @throws CaseError where nothing was pumped, nothing was shut in, or the fall-off has fewer than 20
/// samples
Injection find_injection(const PressureRecord& record, std::optional<double> shut_in = {});

}  // namespace crackle
