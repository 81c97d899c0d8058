// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "box_bounce.hpp"

namespace crackle::test {
namespace {

TEST(ContactBounceLong, TriangleKeepsItsEnergyOver10000Bounces) { bounce_in_box(10000, 0.05); }

}  // namespace
}  // namespace crackle::test
