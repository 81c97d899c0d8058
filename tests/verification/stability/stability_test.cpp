// SPDX-License-Identifier: GPL-3.0-or-later
//
// The stability list of cases/stability: at each point the program's own setting holds, and the naive one, or
// a step beyond the limit, is seen to fail.
#include <gtest/gtest.h>

#include "../../result.hpp"
#include "scenes.hpp"

namespace crackle::stability {
namespace {

void print(const Row& r) {
  std::printf(
      "%s %s %g %g: predicted %.4g, measured %.4g; joint work %.3g, dissipated %.3g, made %.1e, %ld of %ld "
      "stray; %s (step %ld)\n",
      r.scene.c_str(), r.setting.c_str(), r.x, r.y, r.predicted, r.measured, r.joint_work, r.dissipated,
      r.made, r.stray, r.broken, r.alarm.c_str(), r.alarm_step);
}

class Stability : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Insertion, Stability, testing::Values("all", "on_demand"),
                         [](const auto& one) { return one.param; });

TEST_P(Stability, T1FractureAtTheLimitOfTheStep) {
  const Row sound = strip(GetParam(), 0.95);
  print(sound);
  EXPECT_EQ(sound.alarm, "");
  EXPECT_EQ(sound.stray, 0);
  EXPECT_GT(sound.broken, 5);
  EXPECT_LT(sound.made, 1e-3);
  EXPECT_LT(sound.dissipated, 1.3) << "with what the process zone has taken";
  const Row beyond = strip(GetParam(), GetParam() == "all" ? 1.05 : 1.5);
  print(beyond);
  EXPECT_GT(beyond.dissipated, 3.0) << "it is seen to fail";
  ASSERT_GE(beyond.alarm_step, 0);
  EXPECT_LT(beyond.alarm_step, 50) << "and would be stopped";
}

// Blow-up against Lanczos; never below the program's own step.
void limits(const std::string& name, const std::string& setting, Row (*scene)(const std::string&, double),
            const std::vector<double>& points) {
  const Check check(name + ", " + setting + ": step at which it blows up");
  double worst = 0.0;
  for (const double x : points) {
    const Row r = scene(setting, x);
    std::printf("%s %g: blows up at %.4f of Lanczos, %.3f of the program's step\n", name.c_str(), x,
                r.measured / r.predicted, r.measured / r.bound);
    worst = std::max(worst, std::abs(r.measured / r.predicted - 1.0));
    EXPECT_GE(r.measured / r.bound, 0.998);
  }
  check.result(worst);
  EXPECT_LT(worst, 0.15);
}

TEST_P(Stability, T2SkewedTriangles) {
  limits("T2 smallest angle 3 to 60 degrees", GetParam(), skew, {3, 20, 60});
}
TEST_P(Stability, T3PoissonsRatio) {
  limits("T3 Poisson's ratio to 0.499", GetParam(), poisson, {0.27, 0.45, 0.499});
}
TEST_P(Stability, T4Penalty) { limits("T4 penalty 1 to 1000 E", GetParam(), penalty, {1, 30, 1000}); }
TEST_P(Stability, T5Damping) { limits("T5 damping 0 to 20 times critical", GetParam(), damping, {0, 1, 20}); }

TEST_P(Stability, T5FixedViscosityFallsWithTheSquareOfTheEdge) {
  const Check check("T5 fixed viscosity, " + GetParam() + ": order of the step in h, 2");
  const double order = std::log2(viscosity(GetParam(), 0.5).measured / viscosity(GetParam(), 0.25).measured);
  std::printf("%s: step falls as h^%.2f\n", GetParam().c_str(), order);
  check.result(order / 2.0 - 1.0, order);
  EXPECT_NEAR(order, 2.0, 0.1);
}

TEST_P(Stability, T6ElementsComeIntoStressedRock) {
  const Check check("T6 elements in stressed rock, " + GetParam() + ": wave over stress");
  double worst = 0.0;
  for (const double share : {0.4, 0.8}) worst = std::max(worst, activation(GetParam(), share).measured);
  const Row naive = activation(GetParam() + "-naive", 0.4);
  print(naive);
  check.result(worst);
  EXPECT_LT(worst, 1e-9);
  EXPECT_GT(naive.measured, 0.3);
}

TEST_P(Stability, T7LargeRotation) {
  const Check check("T7 rotation by 90 and 180 degrees, " + GetParam() + ": stress over E");
  double worst = 0.0;
  for (const double angle : {90.0, 180.0}) worst = std::max(worst, rotation(GetParam(), angle).measured);
  const Row naive = rotation(GetParam() + "-naive", 10.0);
  check.result(worst);
  EXPECT_LT(worst, 1e-10);
  EXPECT_GT(naive.measured, 0.01);
  EXPECT_NEAR(naive.measured / naive.predicted, 1.0, 1e-6);
}

TEST_P(Stability, T8StiffFluidInAThinCrack) {
  for (const double modulus : {2e9, 2e14}) {
    for (const double aperture : {1e-3, 1e-7}) {
      const Row r = thin_crack(GetParam(), modulus, aperture);
      print(r);
      EXPECT_EQ(r.alarm, "");
      EXPECT_LT(r.measured, 2.0);
      const Row naive = thin_crack(GetParam() + "-naive", modulus, aperture);
      print(naive);
      EXPECT_EQ(naive.predicted > 4.0, naive.alarm_step >= 0);
      EXPECT_LT(naive.alarm_step, 20);
    }
  }
}

TEST_P(Stability, T9HandOverUnderCompression) {
  const Check check("T9 hand-over, contact 0.05 to 20 times cohesive penalty, " + GetParam() +
                    ": kinetic energy");
  double worst = 0.0;
  for (const double ratio : {0.05, 1.0, 20.0}) worst = std::max(worst, handover(GetParam(), ratio).measured);
  const Row naive = handover(GetParam() + "-naive", 0.05);
  print(naive);
  check.result(worst);
  EXPECT_LT(worst, 1e-3);
  EXPECT_GT(naive.measured, 0.3 * naive.predicted);
}

TEST(StabilityOfNumbers, T14SinglePrecision) {
  const Check check("T14 displacements in single precision: traction over strength");
  const Row program = precision("all", 4.0), naive = precision("all-naive", 4.0);
  print(program);
  print(naive);
  check.result(program.measured);
  EXPECT_LT(program.measured, 1e-5);
  EXPECT_GT(naive.measured, 1.0) << "positions: the noise alone breaks the rock";
}

TEST_P(Stability, T15PumpThatDraws) {
  const Check check("T15 fluid drawn from a hole, " + GetParam() + ": pressure");
  double worst = 0.0;
  for (const double share : {0.01, 0.5}) {
    const Row r = drawing(GetParam(), share);
    print(r);
    worst = std::max(worst, std::abs(r.measured / r.predicted - 1.0));
  }
  EXPECT_EQ(drawing(GetParam(), 0.0).measured, 0.0) << "nothing flows, nothing changes";
  check.result(worst);
  EXPECT_LT(worst, 0.03);
  const Row dry = drawing(GetParam(), 1.1);
  print(dry);
  EXPECT_NE(dry.alarm.find("holds no fluid"), std::string::npos);
}

}  // namespace
}  // namespace crackle::stability
