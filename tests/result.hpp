// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>

namespace crackle {

/// A check against theory, timed from here on; its line is what scripts/verification_table reads:
///   RESULT | check | error | order | seconds
/// with the relative error, the order of convergence (- where nothing is refined) and the wall time.
class Check {
 public:
  explicit Check(std::string name) : name_(std::move(name)) {}

  void result(double error, double order = std::numeric_limits<double>::quiet_NaN()) const {
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    std::printf("RESULT | %s | %.2e | ", name_.c_str(), std::abs(error));
    std::isnan(order) ? std::printf("-") : std::printf("%.2f", order);
    std::printf(" | %.2f\n", seconds);
  }

 private:
  std::string name_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace crackle
