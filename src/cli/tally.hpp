// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "crackle/io/output.hpp"

namespace crackle {

/// What a tally keeps that does not follow from the events.
struct TallyMemory {
  double breakdown_pressure = 0.0;   ///< [Pa]
  double breakdown_time = 0.0;       ///< [s]
  double energy_residual_max = 0.0;  ///< [-]
  std::int64_t steps = 0;
  double late_sum = 0.0;        ///< pressure times time, in the last tenth of the run [Pa s]
  double late_time = 0.0;       ///< [s]
  double final_pressure = 0.0;  ///< of the last step so far [Pa]
};

/// Counts, extents and pressures that end up in summary.json.
class Tally {
 public:
  explicit Tally(double end_time, const TallyMemory& memory = {}) : memory_(memory), late_(0.9 * end_time) {
    summary_.magnitude_min = summary_.magnitude_max = std::numeric_limits<double>::quiet_NaN();
  }
  void event(const SeismicEvent& e) {
    if (e.kind == EventKind::breaking) broke(e);
    summary_.magnitude_min = std::fmin(summary_.magnitude_min, e.magnitude);
    summary_.magnitude_max = std::fmax(summary_.magnitude_max, e.magnitude);
    ++summary_.events;
  }
  void pressure(double time, double value, double dt) {
    if (value > memory_.breakdown_pressure || memory_.steps == 0) {
      memory_.breakdown_pressure = value;
      memory_.breakdown_time = time;
    }
    if (time >= late_) {
      memory_.late_sum += value * dt;
      memory_.late_time += dt;
    }
    memory_.final_pressure = value;
    ++memory_.steps;
  }
  void residual(double r) { memory_.energy_residual_max = std::max(memory_.energy_residual_max, r); }
  std::int64_t broken(FailureMode mode) const { return broken_[static_cast<std::size_t>(mode)]; }
  std::int64_t broken() const { return broken_[1] + broken_[2] + broken_[3]; }
  const TallyMemory& memory() const { return memory_; }
  RunSummary finish() const {
    RunSummary s = summary_;
    s.breakdown_pressure = memory_.breakdown_pressure;
    s.breakdown_time = memory_.breakdown_time;
    s.final_pressure = memory_.final_pressure;
    s.energy_residual_max = memory_.energy_residual_max;
    if (memory_.late_time > 0.0) s.propagation_pressure = memory_.late_sum / memory_.late_time;
    return s;
  }

 private:
  void broke(const SeismicEvent& e) {
    ++broken_[static_cast<std::size_t>(e.mode)];
    summary_.broken_length += e.length;
    low_ = {std::min(low_.x, e.place.x), std::min(low_.y, e.place.y)};
    high_ = {std::max(high_.x, e.place.x), std::max(high_.y, e.place.y)};
    summary_.extent_x = high_.x - low_.x;
    summary_.extent_y = high_.y - low_.y;
  }

  TallyMemory memory_;
  RunSummary summary_;
  std::array<std::int64_t, 4> broken_{};
  Vec2 low_{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  Vec2 high_{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  double late_;
};

/// Says when an output at regular times is due: at the step nearest to each.
class Due {
 public:
  /// @param next number of the output that comes next; a number that an integer need not hold
  explicit Due(double interval, double next = 0.0) : interval_(interval), next_(next) {}
  bool is(double time, double dt) {
    if (time + 0.5 * dt < interval_ * next_) return false;
    next_ = std::floor((time + 0.5 * dt) / interval_) + 1.0;
    return true;
  }
  double next() const { return next_; }

 private:
  double interval_, next_;
};

}  // namespace crackle
