// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "random_networks.hpp"

namespace crackle {
namespace {

TEST(RandomNetworksLong, ThousandByCgal) { test::expect_sound_networks(0, 1000, "cgal"); }
TEST(RandomNetworksLong, HundredByGmsh) { test::expect_sound_networks(0, 100, "gmsh"); }

}  // namespace
}  // namespace crackle
