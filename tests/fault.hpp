// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <cstdio>

namespace crackle_test {

/// What is left of a fault: the run ends with the bytes of an undisturbed one (resumed where it was stopped),
/// or it is refused with the reason and nothing has changed.
enum class Left { survived, refused };

/// One line of a test that injects faults, which scripts/faults_table reads:
///   FAULT | fault | how many | survived, refused or lost | test
/// Lost: the test has failed by then.
inline void report_faults(const char* fault, int count, Left left) {
  std::printf("FAULT | %s | %d | %s | %s\n", fault, count,
              testing::Test::HasFailure() ? "lost"
              : left == Left::survived    ? "survived"
                                          : "refused",
              testing::UnitTest::GetInstance()->current_test_suite()->name());
}

}  // namespace crackle_test
