// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <random>
#include <set>
#include <sstream>
#include <string>

#include "crackle/core/errors.hpp"
#include "crackle/io/case.hpp"

namespace crackle {
namespace {

const std::string good_path = CRACKLE_SOURCE_DIR "/tests/unit/io/bad_cases/good.toml";

std::string resolved_again(const std::string& text) {
  return resolved_toml(parse_case(text, "resolved.toml"));
}

TEST(ResolvedToml, ReadsBackToTheSameText) {
  const std::string text = resolved_toml(read_case(good_path));
  EXPECT_EQ(resolved_again(text), text);
}

TEST(ResolvedToml, HoldsEveryKeyOnce) {
  const std::string text = resolved_toml(
      read_case(good_path, {"damping.viscosity=3", "output.fields=['a']", "rock.young_modulus_normal=30e9",
                            "rock.tensile_strength_bedding=1e6", "rock.cohesion_bedding=1e6",
                            "rock.fracture_energy_mode1_bedding=1", "rock.fracture_energy_mode2_bedding=1",
                            "fluid.cavitation_pressure=0", "well.breakdown_pressure=70e6"}));
  // absent: a list of included files, the damping that was not chosen, a mesh file, what starts damage
  const std::set<std::string> absent = {"include", "ratio", "file", "initiation"};
  for (const CaseKey& key : case_keys()) {
    const std::set<std::string> lists = {"joints", "joint_sets", "layers", "loads",
                                         "notches"};  // may be empty
    if (lists.contains(key.table)) continue;
    EXPECT_EQ(text.find("\n" + key.key + " = ") == std::string::npos, absent.contains(key.key)) << key.key;
  }
  EXPECT_EQ(text.rfind("# crackle ", 0), 0U);
}

TEST(ResolvedToml, KeepsEveryBitOfADouble) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> mantissa(1.0, 2.0);
  std::uniform_int_distribution<int> exponent(-1000, 1000);
  Case scene = read_case(good_path);
  for (int i = 0; i < 50; ++i) {
    scene.stress = {std::ldexp(mantissa(random), exponent(random)),
                    -std::ldexp(mantissa(random), exponent(random)), -0.0};
    scene.rock.density = std::ldexp(mantissa(random), exponent(random));
    const Case back = parse_case(resolved_toml(scene), "resolved.toml");
    EXPECT_EQ(back.stress, scene.stress);
    EXPECT_TRUE(std::signbit(back.stress.xy));
    EXPECT_EQ(back.rock.density, scene.rock.density);
  }
}

TEST(ResolvedToml, KeepsTexts) {
  Case scene = read_case(good_path);
  scene.title = "quote \" backslash \\ line\nend \x01 \x7f grün \t";
  scene.output.fields = {"stress_Pa", "a\"b"};
  const Case back = parse_case(resolved_toml(scene), "resolved.toml");
  EXPECT_EQ(back.title, scene.title);
  EXPECT_EQ(back.output.fields, scene.output.fields);
}

// The other moduli of bedded rock follow from those given.
TEST(ResolvedToml, FillsInTheModuliAcrossTheBedding) {
  const Case scene = read_case(good_path, {"rock.young_modulus_normal=20 GPa", "rock.bedding_angle=30 deg"});
  const Case back = parse_case(resolved_toml(scene), "resolved.toml");
  const double nu = scene.rock.poisson_ratio;
  EXPECT_EQ(back.rock.poisson_ratio_normal, nu);
  EXPECT_DOUBLE_EQ(back.rock.shear_modulus_normal.value(),
                   1.0 / (1.0 / scene.rock.young_modulus + (1.0 + 2.0 * nu) / 20e9));
  EXPECT_EQ(back.rock.bedding_angle, scene.rock.bedding_angle);
  EXPECT_FALSE(read_case(good_path).rock.shear_modulus_normal);
}

TEST(ResolvedToml, KeepsTheStrengthsAlongTheBedding) {
  const Case scene = read_case(good_path, {"rock.tensile_strength_bedding=1 MPa", "rock.bedding_exponent=3",
                                           "rock.bedding_angle=30 deg"});
  const Case back = parse_case(resolved_toml(scene), "resolved.toml");
  EXPECT_EQ(back.rock.tensile_strength_bedding, 1e6);
  EXPECT_EQ(back.rock.bedding_exponent, 3.0);
  EXPECT_FALSE(back.rock.cohesion_bedding);
}

TEST(ResolvedToml, KeepsPumpStagesAndTheChosenDamping) {
  const Case scene =
      read_case(good_path, {"fluid.pump=[{to='1 ms', rate=1}, {from='1 ms', rate='2 m2/s'}]",
                            "damping.viscosity=1e4", "run.time_step=1e-7", "wellbore.segments=64"});
  const Case back = parse_case(resolved_toml(scene), "resolved.toml");
  ASSERT_EQ(back.fluid.pump.size(), 2U);
  EXPECT_EQ(back.fluid.pump[1].from, 1e-3);
  EXPECT_EQ(back.fluid.pump[1].rate, 2.0);
  EXPECT_EQ(back.damping.viscosity, 1e4);
  EXPECT_FALSE(back.damping.ratio);
  EXPECT_EQ(back.run.time_step, 1e-7);
  EXPECT_EQ(back.wellbore.segments, 64);
}

TEST(CaseKeys, HaveUnitsDefaultsAndMeanings) {
  const std::vector<CaseKey> keys = case_keys();
  const auto find = [&](const std::string& table, const std::string& key) {
    const auto at =
        std::ranges::find_if(keys, [&](const CaseKey& k) { return k.table == table && k.key == key; });
    return at == keys.end() ? CaseKey{} : *at;
  };
  EXPECT_EQ(find("rock", "young_modulus").unit, "Pa");
  EXPECT_EQ(find("rock", "young_modulus").default_value, "");
  EXPECT_EQ(find("rock", "poisson_ratio").unit, "");
  EXPECT_EQ(find("fluid", "density").default_value, "1000.0");
  EXPECT_EQ(find("fluid.pump", "rate").unit, "m2/s");
  EXPECT_EQ(find("fluid.pump", "from").default_value, "0.0");
  EXPECT_EQ(find("run", "time_step").default_value, "\"auto\"");
  EXPECT_EQ(find("cohesive", "law").default_value, "\"benzeggagh_kenane\"");
  for (const CaseKey& key : keys) EXPECT_FALSE(key.meaning.empty()) << key.key;
}

/// Bytes of a good case replaced, dropped and doubled at random: a case comes out or a CaseError of one
/// line, never anything else.
TEST(CaseFuzz, DamagedTextsEndInOneLine) {
  std::ifstream stream(good_path);
  std::ostringstream whole;
  whole << stream.rdbuf();
  const std::string good = whole.str();
  const std::string letters = "[]{}=\"'.,#\n\\ -+0123456789eExau_\t\xff";
  std::mt19937 random(11);
  const auto below = [&](std::size_t n) { return random() % n; };
  int errors = 0;
  for (int i = 0; i < 1000; ++i) {
    std::string text = good;
    for (std::size_t change = below(4) + 1; change > 0; --change) {
      const std::size_t at = below(text.size());
      switch (below(3)) {
        case 0:
          text[at] = letters[below(letters.size())];
          break;
        case 1:
          text.erase(at, below(20));
          break;
        default:
          text.insert(below(text.size()), text.substr(at, below(40)));
      }
    }
    try {
      parse_case(text, "damaged.toml");
    } catch (const CaseError& error) {
      ++errors;
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    }
  }
  EXPECT_GT(errors, 500);
}

}  // namespace
}  // namespace crackle
