// SPDX-License-Identifier: GPL-3.0-or-later
#include "crackle/core/units.hpp"

#include <gtest/gtest.h>

#include <array>
#include <clocale>
#include <numbers>

namespace crackle {
namespace {

struct Conversion {
  const char* text;
  const char* target;
  double value;
};

class UnitsConvert : public testing::TestWithParam<Conversion> {};

TEST_P(UnitsConvert, GivesTheNumberInTheTarget) {
  const auto& [text, target, value] = GetParam();
  EXPECT_DOUBLE_EQ(Units().convert(text, target), value) << text;
}

INSTANTIATE_TEST_SUITE_P(
    Examples, UnitsConvert,
    testing::Values(
        Conversion{"35 GPa", "Pa", 35e9}, Conversion{"35GPa", "Pa", 35e9}, Conversion{"  +4 MPa ", "Pa", 4e6},
        Conversion{"-4.85 MPa", "Pa", -4.85e6}, Conversion{"5 J/m2", "J/m2", 5.0},
        Conversion{"5 J m-2", "J/m2", 5.0}, Conversion{"5 J/m^2", "J/m2", 5.0},
        Conversion{"5 J/m²", "J/m2", 5.0}, Conversion{"5 N/m", "J/m2", 5.0}, Conversion{"2 1/m2", "m-2", 2.0},
        Conversion{"2 m-2", "1/m2", 2.0}, Conversion{"65 l/s", "m3/s", 0.065},
        Conversion{"65 L/s", "m3/s", 0.065}, Conversion{"1 m3/min", "m3/s", 1.0 / 60.0},
        Conversion{"0.065 m2/s", "m2/s", 0.065}, Conversion{"65 l/s/m", "m2/s", 0.065},
        Conversion{"38 deg", "rad", 38.0 * std::numbers::pi / 180.0}, Conversion{"0.5 rad", "rad", 0.5},
        Conversion{"90°", "degree", 90.0}, Conversion{"1 rad", "degree", 180.0 / std::numbers::pi},
        Conversion{"1.2e-3 s", "s", 1.2e-3}, Conversion{"3 mm", "m", 0.003}, Conversion{"100 us", "s", 1e-4},
        Conversion{"1.68 ms", "s", 1.68e-3}, Conversion{"2 mD", "m2", 2 * 9.869233e-16},
        Conversion{"1 cP", "Pa s", 1e-3}, Conversion{"10 MPa s", "Pa s", 1e7}, Conversion{"0.25", "1", 0.25},
        Conversion{"25 %", "1", 0.25}, Conversion{"2.7 g/cm3", "kg/m3", 2700.0}));

TEST(Units, KeepsDecimalNumbersExact) {
  const Units units;
  EXPECT_EQ(units.convert("65 l/s", "m3/s"), 0.065);
  EXPECT_EQ(units.convert("3 mm", "m"), 0.003);
  EXPECT_EQ(units.convert("6 mm", "m"), 0.006);
  EXPECT_EQ(units.convert("7 us", "s"), 7e-6);
  EXPECT_EQ(units.convert("1.68 ms", "s"), 1.68e-3);
  EXPECT_EQ(units.convert("-4.85 MPa", "Pa"), -4.85e6);
  EXPECT_EQ(units.convert("0 mm", "m"), 0.0);
  EXPECT_EQ(units.convert("1.45 GPa", "Pa"), 1.45e9);
}

TEST(Units, TakesTheFirstTargetOfTheSameDimension) {
  const std::array<std::string_view, 2> rate = {"m2/s", "m3/s"};
  EXPECT_EQ(Units().convert("65 l/s", rate), 0.065);
  EXPECT_EQ(Units().convert("0.065 m2/s", rate), 0.065);
  EXPECT_THROW(Units().convert("65 l", rate), UnitError);
}

struct Refusal {
  const char* text;
  const char* target;
  const char* message;
};

class UnitsRefuse : public testing::TestWithParam<Refusal> {};

TEST_P(UnitsRefuse, WithAMessage) {
  const auto& [text, target, message] = GetParam();
  try {
    ADD_FAILURE() << text << " came out as " << Units().convert(text, target) << " " << target;
  } catch (const UnitError& error) {
    EXPECT_NE(std::string(error.what()).find(message), std::string::npos) << error.what();
  }
}

INSTANTIATE_TEST_SUITE_P(
    Examples, UnitsRefuse,
    testing::Values(Refusal{"", "m", "number"}, Refusal{"mm", "m", "number"},
                    Refusal{"3 mn", "m", "known unit"}, Refusal{"3 GPa", "m", "not in units of m"},
                    Refusal{"3", "m", "not in units of m"}, Refusal{"3 1/s", "s", "not in units of s"},
                    Refusal{"3 Hz", "s", "not in units of s"}, Refusal{"0.5", "rad", "not in units"},
                    Refusal{"38 deg", "1", "not in units"}, Refusal{"6 7 mm", "m", "known unit"},
                    Refusal{"3 m 3", "m", "known unit"}, Refusal{"3-m", "m", "known unit"},
                    Refusal{"10 mm @ 5", "m", "known unit"}, Refusal{"1 m/0", "m", "known unit"},
                    Refusal{"1 m/2", "m", "known unit"}, Refusal{"1 Pa m0.5", "Pa", "known unit"},
                    Refusal{"3 MPa Pa", "Pa", "not in units"}, Refusal{"3 m99999999999", "m", "known unit"},
                    Refusal{"3,5 mm", "m", "known unit"}, Refusal{"20 degC", "K", "linear scale"},
                    Refusal{"nan m", "m", "finite"}, Refusal{"inf m", "m", "finite"},
                    Refusal{"1e999 m", "m", "finite"}, Refusal{"1e308 km", "m", "finite"},
                    Refusal{"3 \xff\xfe", "m", "known unit"}, Refusal{"3 ((((((((((m", "m", "known unit"}));

TEST(Units, DoNotDependOnTheLocale) {
  const char* comma = nullptr;
  for (const char* name : {"de_DE.UTF-8", "de_DE.utf8", "fr_FR.UTF-8"}) {
    if (!comma) comma = std::setlocale(LC_ALL, name);
  }
  if (!comma) GTEST_SKIP() << "no locale with a decimal comma is installed";
  const double opening = Units().convert("1.5 mm", "m");
  std::setlocale(LC_ALL, "C");
  EXPECT_EQ(opening, 0.0015);
}

}  // namespace
}  // namespace crackle
