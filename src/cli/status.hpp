// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <string>

#include "crackle/io/output.hpp"
#include "progress.hpp"

namespace crackle {

/// Keeps status.json of a run: renewed once a second while it goes on, and at its end.
class Status {
 public:
  /// Says "preparing". @throws CaseError
  Status(RunFolder& folder, double end_time);
  /// Says "running", at most once a second. @throws CaseError
  void show(const Progress::Now& now);
  /// Says how the run ended: "done", "interrupted", or "failed" with a reason. @throws CaseError
  void finish(const std::string& state, const std::string& reason = "");

 private:
  void write();

  RunFolder& folder_;
  RunStatus status_;
  std::chrono::steady_clock::time_point start_, last_, loop_start_;
  double loop_time_ = 0.0;  ///< simulated, when the loop started [s]
};

}  // namespace crackle
