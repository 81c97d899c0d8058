// SPDX-License-Identifier: GPL-3.0-or-later
//
// A fracture that snaps in field time: over to explicit steps, and back.
#include <gtest/gtest.h>

#include "hand_over.hpp"

namespace crackle {
namespace {

TEST(HandOver, GriffithSnapOnAFinerMesh) { hand_over::expect_as_theory(hand_over::griffith(3e-3)); }

}  // namespace
}  // namespace crackle
