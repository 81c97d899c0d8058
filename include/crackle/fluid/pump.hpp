// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

namespace crackle {

/// Injection schedule: constant rate in each stage, none between stages.
struct PumpStage {
  double from = 0.0;  ///< [s]
  double to = 0.0;    ///< [s]
  double rate = 0.0;  ///< per metre of thickness, at reference density [m2/s]
};

class Pump {
 public:
  Pump() = default;
  explicit Pump(std::vector<PumpStage> stages) : stages_(std::move(stages)) {}

  /// Rate at a time [m2/s].
  double rate(double time) const;
  /// Volume injected between two times [m2]; exact over stage changes.
  double volume(double from, double to) const;
  /// First time [s] after `time` at which the rate changes; infinity if it never does.
  double next_change(double time) const;

 private:
  std::vector<PumpStage> stages_;
};

}  // namespace crackle
