// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace crackle {

/// A line on the terminal; nothing happens where there is none any more.
void print_line(const std::string& line);

/// Progress of a run on the terminal: a bar renewed twice a second, or one line per 5 % when the
/// output is not a terminal.
class Progress {
 public:
  struct Now {
    double time = 0.0;      ///< simulated [s]
    double pressure = 0.0;  ///< in the wellbore [Pa]
    std::int64_t step = 0;
    std::int64_t broken = 0;  ///< cohesive elements
  };

  Progress(double end_time, bool quiet);
  void show(const Now& now);
  /// Ends the bar's line.
  void finish(const Now& now);

 private:
  void print(const Now& now, bool last);

  double end_time_;
  bool quiet_, terminal_;
  int percent_ = -1;
  double first_share_ = -1.0;  // of the end time, when first shown
  std::chrono::steady_clock::time_point start_, last_;
};

}  // namespace crackle
