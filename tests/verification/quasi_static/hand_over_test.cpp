// SPDX-License-Identifier: GPL-3.0-or-later
//
// A fracture that snaps in field time: over to explicit steps, and back.
#include "hand_over.hpp"

#include <gtest/gtest.h>

namespace crackle {
namespace {

TEST(HandOver, GriffithSnap) { hand_over::expect_as_theory(hand_over::griffith(6e-3)); }

}  // namespace
}  // namespace crackle
