// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a case leaves open is chosen by numbers that `crackle check` prints, and each choice can be forced.
#include <gmock/gmock.h>

#include <sstream>

#include "../../fault.hpp"
#include "binary.hpp"

namespace crackle_test {
namespace {

using testing::HasSubstr;
using testing::Not;

// A coarse KGD fracture, K_m = 7.2 by its viscosity.
constexpr const char* kgd = R"(
[domain]
width = "120 m"
height = "120 m"
[mesh]
size_fine = "1 m"
fine_radius = "6 m"
size_coarse = "20 m"
[rock]
density = 2500
young_modulus = "30 GPa"
poisson_ratio = 0.25
tensile_strength = "10 MPa"
cohesion = "20 MPa"
friction_angle = "35 deg"
fracture_energy_mode1 = 31.25
fracture_energy_mode2 = 31.25
pore_pressure = "10 MPa"
[stress]
yy = "-9 MPa"
[fluid]
viscosity = "1e-6 Pa s"
[[fluid.pump]]
rate = "1e-4 m2/s"
to = "100 s"
[fracture]
notch = "2 m"
[run]
end_time = "100 s"
)";

class Regime : public CliTest {
 protected:
  /// What check says of the fracture with settings.
  std::string said(const std::vector<std::string>& settings) const {
    std::vector<std::string> arguments{"check", write("kgd.toml", kgd)};
    for (const std::string& setting : settings) {
      arguments.push_back("--set");
      arguments.push_back(setting);
    }
    const Outcome outcome = crackle(arguments);
    return outcome.out;
  }
};

TEST_F(Regime, QuasiStaticWhereInertiaIsPast) {
  EXPECT_THAT(said({}), HasSubstr("regime: quasi-static (the run lasts"));
  EXPECT_THAT(said({"run.end_time=0.02 s", "fluid.pump.0.to=0.02 s"}), HasSubstr("regime: dynamic ("));
  // A rate at which the notch would grow at 0.3 of the Rayleigh speed.
  EXPECT_THAT(said({"fluid.pump.0.rate=0.3 m2/s"}), HasSubstr("regime: dynamic ("));
  EXPECT_THAT(said({"fluid.pump.0.rate=0.3 m2/s", "run.regime=quasi_static"}),
              HasSubstr("regime: quasi-static, as run.regime says"));
}

TEST_F(Regime, WellboreOrNotchToStartFrom) {
  const std::vector<std::string> bored{"wellbore.diameter=4 m", "fracture.notch=0",
                                       "run.regime=quasi_static"};
  EXPECT_THAT(said(bored),
              AllOf(HasSubstr("2 wings from the wall of the wellbore along x; "),
                    HasSubstr("the wall of the wellbore breaks from 11.00 MPa (Hubbert-Willis)")));
  std::vector<std::string> free = bored;
  free.insert(free.end(), {"stress.xx=-5 MPa", "stress.yy=-5 MPa", "stress.xy=1 MPa"});
  EXPECT_THAT(said(free), HasSubstr("2 wings from the wall of the wellbore, free; 1 edges, 0 of them open"));
  const std::string file = write("kgd.toml", kgd);
  const auto refused = [&](const std::vector<std::string>& settings, const char* why) {
    std::vector<std::string> arguments{"check", file};
    for (const std::string& setting : settings) {
      arguments.emplace_back("--set");
      arguments.push_back(setting);
    }
    expect_refusal(crackle(arguments), 2, why);
  };
  refused({"wellbore.diameter=5 m", "run.regime=quasi_static"}, "it has to end outside of the wellbore");
  refused({"run.regime=dynamic", "fluid.wets=tip"}, "fluid.wets = \"tip\" is of field time");
}

// 12 mu q/2 h/2 / w3 with w = 20 um / (1 + 9 x 9/30) = 5.4 um, over the total stress of 19 MPa.
TEST_F(Regime, ClosedNotchOfAWellThatStoresNothing) {
  const std::vector<std::string> closed{"fluid.viscosity=1e-3", "fracture.residual_aperture=20 um"};
  EXPECT_THAT(said(closed),
              HasSubstr("a closed notch, 5.41 um open: its pressure may begin at 1.92e+03 MPa"));
  std::vector<std::string> storing = closed;
  storing.emplace_back("well.storage=1e-9");
  EXPECT_THAT(said(storing), Not(HasSubstr("closed notch")));
}

TEST_F(Regime, FlowByToughnessAndViscosity) {
  EXPECT_THAT(said({}), HasSubstr("flow: viscous (K_m = 7.17: toughness rules, pressure is uniform"));
  EXPECT_THAT(said({"fluid.viscosity=1e-3 Pa s"}),
              HasSubstr("flow: viscous (K_m = 1.27: toughness and viscosity both"));
  EXPECT_THAT(said({"fluid.viscosity=0"}), HasSubstr("flow: uniform (no viscosity"));
  EXPECT_THAT(said({"fluid.flow=uniform"}), HasSubstr("flow: uniform, as fluid.flow says"));
}

TEST_F(Regime, LeakOffByWhatWouldLeak) {
  const std::vector<std::string> porous{"rock.porosity=0.05", "rock.pore_compressibility=1.5e-8 Pa-1",
                                        "rock.pore_viscosity=2e-5 Pa s"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.end(), porous.begin(), porous.end());
    return said(more);
  };
  EXPECT_THAT(said({}), HasSubstr("leak-off: none (the rock has no permeability"));
  EXPECT_THAT(with({"rock.permeability=1e-26 m2"}), HasSubstr("leak-off: none ("));
  EXPECT_THAT(with({"rock.permeability=1e-20 m2"}), HasSubstr("leak-off: carter ("));
  EXPECT_THAT(with({"rock.permeability=1e-20 m2", "run.end_time=1e5 s"}), HasSubstr("leak-off: diffusion ("));
  EXPECT_THAT(with({"rock.permeability=1e-20 m2", "fluid.leak_off=none"}),
              HasSubstr("leak-off: none, as fluid.leak_off says"));
}

// What field time does not take is refused with the reason, by run and check alike.
struct Untaken {
  const char* name;
  const char* text;      ///< after the case
  const char* settings;  ///< of --set, a blank between
  const char* reason;
};
void PrintTo(const Untaken& scene, std::ostream* stream) { *stream << scene.name; }

const std::vector<Untaken> untaken{
    {"PumpedNotches", "[[notches]]\nx1 = 5\ny1 = 0\nx2 = 9\ny2 = 0\n", "",
     "the well pumps into fracture.notch or its own wall alone"},
    {"Loads", "[[loads]]\nside = \"top\"\ntraction_y = -1e6\n[boundary]\nouter = \"free\"\n", "",
     "[[loads]] are not yet taken"},
    {"StrengthsAlongTheBedding", "", "rock.tensile_strength_bedding=1e6",
     "along the bedding are not yet taken"},
    {"SmearedDamage", "", "cohesive.insertion=none", "cohesive.insertion = \"none\" has none"},
    {"ViscousFlowWithoutViscosity", "", "fluid.flow=viscous fluid.viscosity=0",
     "needs a fluid.viscosity above 0"},
    {"Tension", "", "stress.yy=1e6", "an effective tension of 1 MPa across the fracture"},
    {"AbsorbingBoundary", "", "boundary.outer=absorbing",
     "nothing moves that boundary.outer = \"absorbing\""},
    {"StraightPathThroughLayers", "[[layers]]\nbottom = 10\nyoung_modulus = 2e10\n", "fracture.path=straight",
     "\"straight\" cannot be: there are layers"},
    {"StraightPathUnderAStressGradient", "", "fracture.path=straight stress.gradient_xx=1e4",
     "\"straight\" cannot be: the stress changes with depth"},
    {"StraightPathAtAnAngle", "", "fracture.path=straight fracture.angle=0.1", "\"straight\" cannot be"},
    {"PathThatEndsInTheNotch", "", "mesh.fine_radius=2.5", "it has to be above fracture.notch"},
};

// What it takes beside rock that is one: check says how much of it there is.
TEST_F(Regime, LayersJointsAndNotches) {
  const std::string layered = write("layered.toml", std::string(kgd) + R"(
[[layers]]
bottom = 4
young_modulus = 2e10
stress_yy = -9.5e6
[[joints]]
x1 = 4
y1 = -2
x2 = 4
y2 = 2
law = "bonded"
tensile_strength = 1e6
cohesion = 1e6
friction_angle = 0.5
fracture_energy_mode1 = 1
fracture_energy_mode2 = 1
[[notches]]
x1 = -6
y1 = -2
x2 = -6
y2 = 2
fluid = "none"
)");
  const Outcome outcome = crackle({"check", layered, "--set", "boundary.outer=free"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out,
              AllOf(HasSubstr("regime: quasi-static ("), HasSubstr("8 edges of joints, 4 of them bonded"),
                    HasSubstr(" in layers.0"), HasSubstr("note: joints that hold break by opening")));
}

// A mesh of a file: that of the generator gives the same bytes.
TEST_F(Regime, MeshOfAFile) {
  std::string made = kgd;
  made.insert(made.find("notch"), "path = \"free\"\n");
  const std::string file = write("made.toml", made);
  ASSERT_EQ(crackle({"mesh", file, "-o", path("made.msh")}).code, 0);
  std::string read = made.substr(made.find("[rock]"));  // no domain, no sizes
  read = "[mesh]\nfile = \"made.msh\"\n" + read;
  const std::string other = write("read.toml", read);
  const auto regime = [](const std::string& scene) {
    const std::string out = crackle({"check", scene}).out;
    const std::size_t line = out.find("\nregime: ");
    return out.substr(line, out.find('\n', line + 1) - line);
  };
  EXPECT_THAT(regime(other), HasSubstr("regime: quasi-static (the run lasts"));
  EXPECT_EQ(regime(other), regime(file)) << "the size of the domain is that of the file";
  for (const auto& [scene, out] : {std::pair{file, "made"}, {other, "read"}}) {
    const Outcome outcome = crackle({"run", scene, "-q", "-o", path(out), "--set", "run.regime=quasi_static",
                                     "--set", "run.end_time=1 s", "--set", "fluid.pump.0.to=1 s"});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
  }
  EXPECT_EQ(read_text(path("read/history.csv")), read_text(path("made/history.csv")));
  const auto refused = [&](const std::string& setting, const char* why) {
    expect_refusal(crackle({"run", other, "-q", "-o", path("no"), "--set", setting}), 2, why);
  };
  refused("fracture.notch=0", "[[joint_sets]]");
  refused("wellbore.diameter=1", "mesh.file has no curve \"wellbore_wall\"");
}

class FieldTimeRefusal : public CliTest, public testing::WithParamInterface<Untaken> {};
INSTANTIATE_TEST_SUITE_P(Of, FieldTimeRefusal, testing::ValuesIn(untaken),
                         [](const auto& test) { return test.param.name; });

TEST_P(FieldTimeRefusal, SaysWhatIsNotTaken) {
  const std::string file = write("bad.toml", std::string(kgd) + GetParam().text);
  std::vector<std::string> settings;
  std::stringstream words(GetParam().settings);
  for (std::string word; words >> word;) settings.insert(settings.end(), {"--set", word});
  for (std::vector<std::string> command :
       {std::vector<std::string>{"check", file}, {"run", file, "-q", "-o", path("out")}}) {
    command.insert(command.end(), settings.begin(), settings.end());
    const Outcome outcome = crackle(command);
    expect_refusal(outcome, 2, GetParam().reason);
    EXPECT_THAT(outcome.err, HasSubstr("bad.toml: run.regime = \"quasi_static\": "));
  }
  EXPECT_FALSE(std::filesystem::exists(path("out/resolved.toml")));
  report_faults(wrong_case, 1, Left::refused, "field time");
}

}  // namespace
}  // namespace crackle_test
