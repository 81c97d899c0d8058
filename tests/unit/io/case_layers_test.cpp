// SPDX-License-Identifier: GPL-3.0-or-later
// [[layers]] of a case: what they take from [rock] and [stress], and back from resolved.toml.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "crackle/core/errors.hpp"
#include "crackle/io/case.hpp"

namespace crackle {
namespace {

const std::string good_path = CRACKLE_SOURCE_DIR "/tests/unit/io/bad_cases/good.toml";

Case with_layers(const std::string& layers, std::vector<std::string> more = {}) {
  more.insert(more.begin(), "layers=" + layers);
  return read_case(good_path, more);
}

TEST(CaseLayers, TakeFromTheRockWhatTheyDoNotSay) {
  const Case scene = with_layers(
      "[{bottom='0.1 m', young_modulus='20 GPa', stress_xx='-3 MPa'}, {top='-0.2 m', dip='5 deg'}]");
  ASSERT_EQ(scene.layers.size(), 2U);
  const Case::Layer& first = scene.layers[0];
  EXPECT_EQ(first.bottom, 0.1);
  EXPECT_FALSE(first.top);
  EXPECT_EQ(first.rock.young_modulus, 20e9);
  EXPECT_EQ(first.rock.poisson_ratio, scene.rock.poisson_ratio);
  EXPECT_EQ(first.rock.tensile_strength, scene.rock.tensile_strength);
  EXPECT_EQ(first.rock.density, scene.rock.density);
  EXPECT_EQ(first.stress, (Sym2{-3e6, scene.stress.yy, scene.stress.xy}));
  EXPECT_EQ(first.penalty, 20.0 * 20e9);
  EXPECT_EQ(first.interface.law, "perfect");
  EXPECT_EQ(scene.layers[1].rock.young_modulus, scene.rock.young_modulus);
  EXPECT_EQ(scene.layers[1].stress, scene.stress);
}

TEST(CaseLayers, OfBeddedRockFillInTheirOwnModuli) {
  const Case scene =
      with_layers("[{bottom=0.1, young_modulus='30 GPa'}]", {"rock.young_modulus_normal=20 GPa"});
  const Case::Rock& rock = scene.layers[0].rock;
  EXPECT_EQ(rock.young_modulus_normal, 20e9);
  EXPECT_DOUBLE_EQ(rock.shear_modulus_normal.value(),
                   1.0 / (1.0 / 30e9 + (1.0 + 2.0 * rock.poisson_ratio) / 20e9));
}

TEST(CaseLayers, ReadBackToTheSameText) {
  const std::string text = resolved_toml(with_layers(
      "[{bottom=0.1, top=0.2, dip='3 deg', young_modulus='20 GPa', tensile_strength_bedding='1 MPa', "
      "interface='bonded', interface_tensile_strength='1 MPa', interface_cohesion='2 MPa', "
      "interface_friction_angle='30 deg', interface_fracture_energy_mode1=1, "
      "interface_fracture_energy_mode2=5}, "
      "{top=-0.2, penalty='100 GPa'}]"));
  const Case back = parse_case(text, "resolved.toml");
  EXPECT_EQ(resolved_toml(back), text);
  EXPECT_EQ(back.layers[0].interface.tensile_strength, 1e6);
  EXPECT_EQ(back.layers[0].interface.normal_penalty, back.cohesive.penalty);
  EXPECT_EQ(back.layers[0].rock.tensile_strength_bedding, 1e6);
  EXPECT_EQ(back.layers[0].penalty, 20.0 * 20e9) << "though cohesive.penalty is given now";
}

}  // namespace
}  // namespace crackle
