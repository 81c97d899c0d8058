// SPDX-License-Identifier: GPL-3.0-or-later
#include "crackle/core/nearest.hpp"

#include <gtest/gtest.h>

#include <array>
#include <string>

namespace crackle {
namespace {

TEST(EditDistance, CountsInsertionsDeletionsReplacementsAndSwaps) {
  EXPECT_EQ(edit_distance("cohesion", "cohesion"), 0U);
  EXPECT_EQ(edit_distance("cohesion", "cohesin"), 1U);
  EXPECT_EQ(edit_distance("cohesin", "cohesion"), 1U);
  EXPECT_EQ(edit_distance("density", "densety"), 1U);
  EXPECT_EQ(edit_distance("width", "widht"), 1U);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3U);
  EXPECT_EQ(edit_distance("", "mesh"), 4U);
  EXPECT_EQ(edit_distance("Width", "width"), 0U);
}

TEST(EditDistance, CutsLongWords) { EXPECT_EQ(edit_distance(std::string(1 << 20, 'x'), "x"), 63U); }

TEST(Nearest, TakesTheClosestAndTheFirstOfEquals) {
  const std::array<std::string_view, 3> names = {"yy", "xx", "xy"};
  EXPECT_EQ(nearest("xz", names), "xx");
  EXPECT_EQ(nearest("x_y", names), "xy");
  EXPECT_EQ(nearest("word", {}), "");
  EXPECT_EQ(nearest("x_y", names, 1), "xy");
  EXPECT_EQ(nearest("x_y", names, 0), "");
  EXPECT_EQ(nearest("xy", names, 0), "xy");
  const std::string_view keys[] = {"density", "length_mean", "seed"};
  EXPECT_EQ(nearest("length", keys), "length_mean");
  EXPECT_EQ(nearest("sed", keys), "seed");
  EXPECT_EQ(letters_off("length", "length_mean"), 1U);
  EXPECT_EQ(letters_off("length", "lengths"), 1U);
  EXPECT_EQ(letters_off("length", "density"), edit_distance("length", "density"));
}

}  // namespace
}  // namespace crackle
