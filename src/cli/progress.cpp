// SPDX-License-Identifier: GPL-3.0-or-later
#include "progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace crackle {
namespace {

std::string duration(double seconds) {
  const auto s = static_cast<std::int64_t>(std::llround(seconds));
  if (s < 60) return fmt::format("{} s", s);
  if (s < 3600) return fmt::format("{} min {:02} s", s / 60, s % 60);
  return fmt::format("{} h {:02} min", s / 3600, s % 3600 / 60);
}

// A terminal that is gone is no reason to stop a run.
void put(const std::string& text) {
  std::fputs(text.c_str(), stderr);
  std::fflush(stderr);
}

}  // namespace

void print_line(const std::string& line) { put(line + "\n"); }

Progress::Progress(double end_time, bool quiet)
    : end_time_(end_time),
      quiet_(quiet),
      terminal_(isatty(STDERR_FILENO) != 0),
      start_(std::chrono::steady_clock::now()),
      last_(start_) {}

void Progress::show(const Now& now) {
  if (quiet_) return;
  if (terminal_) {
    const auto t = std::chrono::steady_clock::now();
    if (t - last_ < std::chrono::milliseconds(500)) return;
    last_ = t;
    print(now, false);
    return;
  }
  const int percent = static_cast<int>(100.0 * now.time / end_time_ + 1e-9) / 5 * 5;
  if (percent == percent_) return;
  percent_ = percent;
  print(now, false);
}

void Progress::finish(const Now& now) {
  if (!quiet_ && terminal_) print(now, true);
}

void Progress::print(const Now& now, bool last) {
  const double share = now.time / end_time_;
  if (first_share_ < 0.0) first_share_ = share;
  const double done = share - first_share_;
  const double wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  const std::string left = last           ? fmt::format("took {}", duration(wall))
                           : done > 0.005 ? fmt::format("{} left", duration(wall * (1.0 - share) / done))
                                          : std::string("...");
  const bool short_run = end_time_ < 1.0;
  const double unit = short_run ? 1e-3 : 1.0;
  const std::string text =
      fmt::format("{:5.1f} %  t = {:.3f} of {:.3f} {}  step {}  {:.2f} MPa  {} broken  {}", 100.0 * share,
                  now.time / unit, end_time_ / unit, short_run ? "ms" : "s", now.step, 1e-6 * now.pressure,
                  now.broken, left);
  if (!terminal_) {
    print_line(text);
    return;
  }
  constexpr int width = 24;
  const int full = std::clamp(static_cast<int>(share * width), 0, width);
  put(fmt::format("\r\033[K[{}{}] {}{}", std::string(static_cast<std::size_t>(full), '#'),
                  std::string(static_cast<std::size_t>(width - full), '.'), text, last ? "\n" : ""));
}

}  // namespace crackle
