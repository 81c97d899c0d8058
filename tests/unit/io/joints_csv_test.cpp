// SPDX-License-Identifier: GPL-3.0-or-later
#include "crackle/io/joints_csv.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "crackle/core/errors.hpp"

namespace crackle {
namespace {

class JointsCsv : public testing::Test {
 protected:
  JointsCsv()
      : path_((std::filesystem::temp_directory_path() /
               ("crackle_" + std::to_string(::getpid()) + "_joints.csv"))
                  .string()) {}
  ~JointsCsv() override { std::filesystem::remove(path_); }

  std::vector<Joint> read(const std::string& text) {
    std::ofstream(path_, std::ios::binary) << text;
    return read_joints_csv(path_, 3);
  }

  std::string path_;
};

TEST_F(JointsCsv, ColumnsInAnyOrderWithOthersBesideThem) {
  const std::vector<Joint> joints = read(
      "\xEF\xBB\xBF# mapped in 2015\r\nid,\"y1_m\", x1_m ,x2_m,y2_m\r\n\r\n1,0.25,-1e-3,2,3\n# "
      "end\n2,0,0,1,1");
  ASSERT_EQ(joints.size(), 2u);
  EXPECT_EQ(joints[0].from, (Vec2{-1e-3, 0.25}));
  EXPECT_EQ(joints[0].to, (Vec2{2.0, 3.0}));
  EXPECT_EQ(joints[1].set, 3);
}

TEST_F(JointsCsv, NoRowsAreNoJoints) { EXPECT_TRUE(read("x1_m,y1_m,x2_m,y2_m\n").empty()); }

TEST_F(JointsCsv, RefusesAllElse) {
  const std::vector<std::pair<std::string, std::string>> all{
      {"", ":0: the file is empty"},
      {"# nothing\n\n", ":2: the file is empty"},
      {"x1,y1,x2,y2\n0,0,1,1\n", ":1: there is no column x1_m"},
      {"x1_m,y1_m,x2_m\n", ":1: there is no column y2_m"},
      {"x1_m,y1_m,x2_m,y2_m\n0,0,1\n", ":2: this row has 3 columns instead of 4"},
      {"x1_m,y1_m,x2_m,y2_m\n0,0,1,1,1\n", ":2: this row has 5 columns instead of 4"},
      {"x1_m,y1_m,x2_m,y2_m\n1e211,0,1,1\n", ":2: x1_m is 1e+211 m, farther than 1e+12 m"},
      {"x1_m,y1_m,x2_m,y2_m\n0,0,1,1\n0,0,one,1\n", ":3: x2_m is \"one\", which is not a number"},
      {"x1_m,y1_m,x2_m,y2_m\n0,0,1 m,1\n", "x2_m is \"1 m\""},
      {"x1_m,y1_m,x2_m,y2_m\n0,0,,1\n", "x2_m is \"\""},
      {"x1_m,y1_m,x2_m,y2_m\n0,nan,1,1\n", "y1_m is \"nan\""},
      {"x1_m,y1_m,x2_m,y2_m\n0,0,inf,1\n", "x2_m is \"inf\""},
      {"x1_m,y1_m,x2_m,y2_m\n0,0,1e999,1\n", "x2_m is \"1e999\""},
      {"x1_m;y1_m;x2_m;y2_m\n0;0;1;1\n", ":1: there is no column x1_m"},
      {"x1_m,y1_m,x2_m,y2_m\n0.5,0.25,0.5,0.25\n", ":2: the joint has no length"},
  };
  for (const auto& [text, message] : all) {
    try {
      read(text);
      ADD_FAILURE() << "no error in\n" << text;
    } catch (const CaseError& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr(path_));
      EXPECT_THAT(error.what(), testing::HasSubstr(message));
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    }
  }
  std::filesystem::remove(path_);
  EXPECT_THROW(read_joints_csv(path_, 0), CaseError);
}

}  // namespace
}  // namespace crackle
