// SPDX-License-Identifier: GPL-3.0-or-later
#include "crackle/analysis/record.hpp"

#include <gmock/gmock.h>

#include <functional>
#include <limits>

#include "records.hpp"

namespace crackle_test {
namespace {

using crackle::PressureRecord;
using testing::HasSubstr;

PressureRecord good() {
  PressureRecord record = record_of(CarterTest{}, sampling(1.0, 0.02, 1e5));
  record.source = "well.csv";
  for (std::size_t i = 0; i < record.time.size(); ++i) record.lines.push_back(static_cast<int>(i) + 2);
  return record;
}

std::string refusal(const std::function<void(PressureRecord&)>& spoil) {
  PressureRecord record = good();
  spoil(record);
  try {
    crackle::check_record(record);
    crackle::find_injection(record);
  } catch (const crackle::CaseError& error) {
    return error.what();
  }
  return "accepted";
}

void cut(PressureRecord& r, std::size_t first, std::size_t end) {
  for (auto* v : {&r.time, &r.pressure, &r.rate}) v->erase(v->begin() + first, v->begin() + end);
  r.lines.erase(r.lines.begin() + first, r.lines.begin() + end);
}

TEST(PressureRecord, GoodOneIsTaken) {
  EXPECT_EQ(refusal([](PressureRecord&) {}), "accepted");
}

TEST(PressureRecord, BadOnesAreRefusedWithTheirLine) {
  EXPECT_THAT(refusal([](auto& r) { r.time[40] = r.time[39]; }),
              HasSubstr("well.csv:42: time does not rise"));
  EXPECT_THAT(refusal([](auto& r) { r.pressure[7] = std::numeric_limits<double>::quiet_NaN(); }),
              HasSubstr("well.csv:9: time, pressure or rate is not a finite number"));
  EXPECT_THAT(refusal([](auto& r) {
                for (double& p : r.pressure) p *= 1e-6;  // MPa taken for Pa
              }),
              HasSubstr("is the unit of the pressure right"));
  EXPECT_THAT(refusal([](auto& r) {
                for (double& p : r.pressure) p *= 6894.76;
              }),
              HasSubstr("is the unit of the pressure right"));
  EXPECT_THAT(refusal([](auto& r) {
                for (double& q : r.rate) q = 0.01;
              }),
              HasSubstr("there is no shut-in"));
  EXPECT_THAT(refusal([](auto& r) {
                for (double& q : r.rate) q = 0.0;
              }),
              HasSubstr("nothing is pumped"));
  EXPECT_THAT(refusal([](auto& r) { cut(r, 19, r.time.size()); }), HasSubstr("ends after 19 samples"));
  EXPECT_THAT(refusal([](auto& r) { cut(r, 320, r.time.size()); }), HasSubstr("has 10 samples"));
}

TEST(PressureRecord, HolesAreRefused) {
  EXPECT_THAT(refusal([](auto& r) { cut(r, 100, 160); }),
              HasSubstr("well.csv:162: nothing was recorded for 61 s"));
  EXPECT_THAT(refusal([](auto& r) { cut(r, 400, 480); }), HasSubstr("nothing was recorded for"));
  // some lost samples far into a fall-off do not matter
  EXPECT_EQ(refusal([](auto& r) { cut(r, 450, 452); }), "accepted");
}

TEST(Injection, IsFoundWithItsVolume) {
  const auto found = crackle::find_injection(good());
  EXPECT_DOUBLE_EQ(found.start, 10.0);
  EXPECT_DOUBLE_EQ(found.shut_in, 310.0);
  EXPECT_NEAR(found.volume, 3.0, 1e-12);
  EXPECT_NEAR(found.rate, 0.01, 1e-14);
  EXPECT_DOUBLE_EQ(found.shut_in_pressure, 46e6);
}

/// Two cycles of 100 s, the second of half the rate, with rests of 1000 s and `second` s.
PressureRecord two_cycles(double second) {
  PressureRecord record;
  for (double t = 0.0; t < 1200.0 + second; t += 5.0) {
    const bool first = t < 100.0, again = t >= 1100.0 && t < 1200.0;
    record.time.push_back(t);
    record.rate.push_back(first ? 0.02 : again ? 0.01 : 0.0);
    record.pressure.push_back(40e6);
  }
  return record;
}

TEST(Injection, IsTheOneWithTheLongestFallOff) {
  const auto late = crackle::find_injection(two_cycles(2000.0)),
             early = crackle::find_injection(two_cycles(500.0));
  EXPECT_DOUBLE_EQ(late.shut_in, 1200.0);
  EXPECT_NEAR(late.volume, 1.0, 1e-12);
  EXPECT_NEAR(late.earlier_volume, 2.0, 1e-12);
  EXPECT_DOUBLE_EQ(early.shut_in, 100.0);
  EXPECT_EQ(early.end_sample, 220U);  // the fall-off ends where the next cycle starts
  EXPECT_DOUBLE_EQ(crackle::find_injection(two_cycles(500.0), 1200.0).shut_in, 1200.0);
}

TEST(Injection, ShortRestBelongsToThePumping) {
  PressureRecord record = two_cycles(2000.0);
  for (std::size_t i = 0; i < record.time.size(); ++i) {
    if (record.time[i] >= 60.0 && record.time[i] < 80.0) record.rate[i] = 0.0;
    if (record.time[i] >= 1100.0) record.rate[i] = 0.0;
  }
  const auto found = crackle::find_injection(record);
  EXPECT_DOUBLE_EQ(found.start, 0.0);
  EXPECT_DOUBLE_EQ(found.shut_in, 100.0);
  EXPECT_NEAR(found.volume, 1.6, 1e-12);
}

}  // namespace
}  // namespace crackle_test
