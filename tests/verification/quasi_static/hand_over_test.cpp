// SPDX-License-Identifier: GPL-3.0-or-later
//
// A fracture that snaps in field time: over to explicit steps, and back.
#include "hand_over.hpp"

#include <gtest/gtest.h>

namespace crackle {
namespace {

TEST(HandOver, GriffithSnap) {
  const hand_over::Snap snap = hand_over::griffith(6e-3);
  EXPECT_LT(std::abs(snap.pressure), 0.02);
  EXPECT_LT(std::abs(snap.length), 0.05);
  EXPECT_GT(snap.lost, 1.0);
  EXPECT_NEAR(snap.torn, 1.0, 0.03);
  EXPECT_LT(snap.mass, 1e-8);
  EXPECT_LT(snap.energy, 1e-3);
}

}  // namespace
}  // namespace crackle
