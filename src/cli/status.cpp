// SPDX-License-Identifier: GPL-3.0-or-later
#include "status.hpp"

#include <limits>

namespace crackle {
namespace {

double seconds_between(std::chrono::steady_clock::time_point from, std::chrono::steady_clock::time_point to) {
  return std::chrono::duration<double>(to - from).count();
}

}  // namespace

Status::Status(RunFolder& folder, double end_time)
    : folder_(folder), start_(std::chrono::steady_clock::now()) {
  status_.end_time = end_time;
  status_.wall_left = std::numeric_limits<double>::quiet_NaN();
  write();
}

void Status::show(const Progress::Now& now) {
  const auto clock = std::chrono::steady_clock::now();
  const bool first = status_.state != "running";
  status_.time = now.time;
  status_.step = now.step;
  status_.broken = now.broken;
  if (!first && clock - last_ < std::chrono::seconds(1)) return;
  if (first) {
    status_.state = "running";
    loop_start_ = clock;
    loop_time_ = now.time;
  }
  if (const double passed = now.time - loop_time_; passed > 0.0) {
    status_.wall_left = seconds_between(loop_start_, clock) * (status_.end_time - now.time) / passed;
  }
  write();
}

void Status::finish(const std::string& state, const std::string& reason) {
  status_.state = state;
  status_.reason = reason;
  if (state == "done") status_.wall_left = 0.0;
  write();
}

void Status::write() {
  last_ = std::chrono::steady_clock::now();
  status_.wall = seconds_between(start_, last_);
  folder_.write_status(status_);
}

}  // namespace crackle
