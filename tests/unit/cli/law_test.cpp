// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <sstream>
#include <stdexcept>

#include "binary.hpp"

namespace crackle_test {
namespace {

using Row = std::array<double, 6>;  // opening, slip, normal, shear, damage, dissipated

std::vector<Row> rows_of(const Outcome& outcome) {
  if (outcome.code != 0) throw std::runtime_error(outcome.err);
  std::istringstream lines(outcome.out);
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(line, "opening_m,slip_m,normal_Pa,shear_Pa,damage,dissipated_J_m2");
  std::vector<Row> rows;
  while (std::getline(lines, line)) {
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream cells(line);
    Row row{};
    for (double& cell : row) cells >> cell;
    EXPECT_TRUE(cells) << line;
    rows.push_back(row);
  }
  return rows;
}

// validation.md B1: the paper's granite on its 3 mm edge.
TEST(Law, PaperOpening) {
  const auto rows = rows_of(crackle({"law", "evans_marathe"}));
  ASSERT_EQ(rows.size(), 200U);
  EXPECT_NEAR(rows.back()[5], 6.0946, 6e-4);
  EXPECT_EQ(rows.back()[4], 1.0);
  EXPECT_EQ(rows.back()[2], 0.0);
  for (std::size_t i = 1; i < rows.size(); ++i) {
    EXPECT_GT(rows[i][0], rows[i - 1][0]);
    EXPECT_GE(rows[i][4], rows[i - 1][4]) << "damage never heals";
    EXPECT_GE(rows[i][5], rows[i - 1][5] - 1e-9) << "dissipation never falls";
    EXPECT_LE(rows[i][2], 3e6 * (1.0 + 1e-9));
  }
}

TEST(Law, ExactCalibrationDissipatesTheFractureEnergy) {
  for (const char* law : {"evans_marathe", "linear"}) {
    const std::vector<std::string> exact{"law", law, "--set", "cohesive.calibration=exact", "--points", "50"};
    EXPECT_NEAR(rows_of(crackle(exact)).back()[5], 5.0, 5e-3) << law;
    std::vector<std::string> sliding = exact;
    sliding.insert(sliding.end(), {"--mode", "2"});
    EXPECT_NEAR(rows_of(crackle(sliding)).back()[5], 80.0, 0.08) << law;
  }
}

// validation.md B2: f_s = 24 MPa + 5 MPa tan 38 degrees; what is left is friction at 38 degrees.
TEST(Law, SlidingUnderCompression) {
  const auto rows =
      rows_of(crackle({"law", "evans_marathe", "--mode", "2", "--normal", "-5 MPa", "--points", "2000"}));
  double peak = 0.0;
  for (const Row& row : rows) peak = std::max(peak, row[3]);
  EXPECT_NEAR(peak, 27.906e6, 0.005e6);
  EXPECT_NEAR(rows.back()[3], 3.906e6, 0.005e6);
  EXPECT_EQ(rows.back()[2], -5e6);
}

TEST(Law, MixedModeLiesBetween) {
  double last = rows_of(crackle({"law", "linear", "--points", "100"})).back()[5];
  for (const char* angle : {"30 deg", "60 deg", "90 deg"}) {
    const double now =
        rows_of(crackle({"law", "linear", "--mode", "mixed", "--angle", angle, "--points", "100"})).back()[5];
    EXPECT_GT(now, last) << angle;
    last = now;
  }
}

TEST(Law, LongerEdgeTakesMoreInItsElasticBranch) {
  const double rise = rows_of(crackle({"law", "evans_marathe", "--edge", "30 mm"})).back()[5] -
                      rows_of(crackle({"law", "evans_marathe", "--edge", "0.003"})).back()[5];
  EXPECT_NEAR(rise, 2.7, 0.003);  // 2/3 f_t o_p, o_p = 2 h f_t / p_f
}

using LawOfCase = CliTest;

TEST_F(LawOfCase, TakesItsRock) {
  const std::string file = write("good.toml", good_case);
  const auto rows = rows_of(crackle({"law", "evans_marathe", "--case", file, "--points", "400"}));
  double peak = 0.0;
  for (const Row& row : rows) peak = std::max(peak, row[2]);
  EXPECT_NEAR(peak, 1e6, 1e4);
}

TEST(Law, WhatIsWrong) {
  expect_refusal(crackle({"law", "evans_marate"}), 2, "did you mean \"evans_marathe\"?");
  expect_refusal(crackle({"law", "linear", "--edge", "3 Pa"}), 2, "--edge");
  expect_refusal(crackle({"law", "linear", "--edge", "0"}), 2, "--edge");
  expect_refusal(crackle({"law", "linear", "--mode", "3"}), 2, "--mode");
  expect_refusal(crackle({"law", "linear", "--normal", "-1 MPa"}), 2, "--mode 2");
  expect_refusal(crackle({"law", "linear", "--mode", "2", "--normal", "1 MPa"}), 2,
                 "compression is negative");
  expect_refusal(crackle({"law", "linear", "--mode", "mixed", "--angle", "100 deg"}), 2, "--angle");
  expect_refusal(crackle({"law", "linear", "--points", "1"}), 2, "--points");
  expect_refusal(crackle({"law", "linear", "--set", "rock.cohesion=-1"}), 2, "rock.cohesion");
  expect_refusal(crackle({"law", "linear", "--set", "cohesive.calibration=exact", "--edge", "1 m"}), 2,
                 "longest edge");
}

}  // namespace
}  // namespace crackle_test
