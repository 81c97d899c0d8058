// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <cstdio>

namespace crackle_test {

/// What is left of a fault: the run ends with the bytes of an undisturbed one (resumed where it was stopped),
/// or it is refused with the reason and nothing has changed.
enum class Left { survived, refused };

/// The fault of a case that cannot be run, for report_faults().
inline constexpr const char* wrong_case = "wrong case files, each with its place and message";

/// One line of a test that injects faults, which scripts/faults_table reads:
///   FAULT | fault | scene | how many | survived, refused or lost | test
/// Lost: the test has failed by then.
/// @param scene where the table tells scenes apart
inline void report_faults(const char* fault, int count, Left left, const char* scene = "") {
  std::printf("FAULT | %s | %s | %d | %s | %s\n", fault, scene, count,
              testing::Test::HasFailure() ? "lost"
              : left == Left::survived    ? "survived"
                                          : "refused",
              testing::UnitTest::GetInstance()->current_test_suite()->name());
}

}  // namespace crackle_test
