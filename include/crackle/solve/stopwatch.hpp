// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <chrono>
#include <string_view>

namespace crackle {

/// Wall time spent in each part of the step.
class Stopwatch {
 public:
  enum Part { cohesive, contact, rock, fluid, events, ledger, parts };
  static constexpr std::array<std::string_view, parts> names{"cohesive", "contact", "rock and motion",
                                                             "fluid",    "events",  "ledger"};

  /// Begins timing; later laps go to the part named.
  void start() { last_ = Clock::now(); }
  void lap(Part part) {
    const auto now = Clock::now();
    seconds_[part] += std::chrono::duration<double>(now - last_).count();
    last_ = now;
  }
  double seconds(Part part) const { return seconds_[part]; }
  double total() const {
    double sum = 0.0;
    for (const double s : seconds_) sum += s;
    return sum;
  }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point last_ = Clock::now();
  std::array<double, parts> seconds_{};
};

}  // namespace crackle
