// SPDX-License-Identifier: GPL-3.0-or-later
#include "threads.hpp"

#include <fmt/format.h>
#include <omp.h>

#include <latch>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "crackle/core/errors.hpp"

namespace crackle {

int require_threads(int asked) {
  const int count = asked > 0 ? asked : omp_get_num_procs();
  std::string reason;
  std::latch all(1);
  std::vector<std::jthread> threads;  // beside this one
  try {
    while (static_cast<int>(threads.size()) + 1 < count) threads.emplace_back([&all] { all.wait(); });
  } catch (const std::exception& error) {
    reason = error.what();
  }
  all.count_down();
  if (!reason.empty()) {
    throw CaseError(fmt::format("{} threads cannot be had: {} after {}; give fewer with -j", count, reason,
                                threads.size() + 1));
  }
  return count;
}

}  // namespace crackle
