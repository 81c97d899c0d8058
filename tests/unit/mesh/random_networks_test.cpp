// SPDX-License-Identifier: GPL-3.0-or-later
#include "random_networks.hpp"

#include <gtest/gtest.h>

namespace crackle {
namespace {

TEST(RandomNetworks, SixtyByCgal) { test::expect_sound_networks(0, 60, "cgal"); }
TEST(RandomNetworks, TenByGmsh) { test::expect_sound_networks(0, 10, "gmsh"); }

}  // namespace
}  // namespace crackle
