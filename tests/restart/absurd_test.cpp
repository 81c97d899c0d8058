// SPDX-License-Identifier: GPL-3.0-or-later
//
// Scenes that nobody would want and nothing forbids: each ends in bounded time and memory, done or with
// the reason why not.
#include <gmock/gmock.h>
#include <sys/resource.h>

#include "../fault.hpp"
#include "process.hpp"

namespace crackle_test {
namespace {

struct Absurd {
  const char* name;
  std::vector<std::string> settings;
  int code = 0;
  const char* reason = "";
};
void PrintTo(const Absurd& scene, std::ostream* stream) { *stream << scene.name; }

const std::vector<Absurd> scenes{
    {"OneTriangleAcrossTheWellbore",
     {"mesh.size_fine=0.5", "mesh.fine_radius=0", "mesh.size_coarse=0.5", "wellbore.segments=3"}},
    {"DomainOfAMicrometre",
     {"domain.width=1e-6", "domain.height=1e-6", "wellbore.diameter=1e-7", "mesh.size_fine=1.5e-8",
      "mesh.fine_radius=1.2e-7", "mesh.size_coarse=1e-7", "run.end_time=1e-10", "fluid.pump.0.rate=1e-7"}},
    {"DomainOfAThousandKilometres",
     {"domain.width=1e6", "domain.height=1e6", "wellbore.diameter=1e5", "mesh.size_fine=1.5e4",
      "mesh.fine_radius=1.2e5", "mesh.size_coarse=1e5", "run.end_time=100"}},
    {"HardlyAnyTensileStrength", {"rock.tensile_strength=1e-3"}},
    {"HardlyAnyStrength", {"rock.tensile_strength=1e-3", "rock.cohesion=1e-3"}},
    {"NineOrdersStronger", {"rock.tensile_strength=1e12", "rock.cohesion=1e12"}},
    {"BrittleBeyondGlass", {"rock.fracture_energy_mode1=1e-12", "rock.fracture_energy_mode2=1e-12"}},
    {"TougherThanSteel", {"rock.fracture_energy_mode1=1e12", "rock.fracture_energy_mode2=1e12"}},
    {"FluidWithoutCompressibility", {"fluid.bulk_modulus=inf"}, 2, "must be finite"},
    {"FluidWithHardlyAnyCompressibility", {"fluid.bulk_modulus=1e30"}, 4, "energy residual"},
    {"FluidLikeVacuum", {"fluid.bulk_modulus=1e-3"}},
    {"PumpOfAMillion", {"fluid.pump.0.rate=1e6"}, 4, "energy residual"},
    {"EverythingTornApart",
     {"stress.xx=1e8", "stress.yy=1e8"},
     4,
     "a fracture has reached the outer boundary"},
    {"EverythingTornApartOnDemand",
     {"stress.xx=1e8", "stress.yy=1e8", "cohesive.insertion=on_demand"},
     4,
     "a fracture has reached the outer boundary"},
    {"FractureThroughTheModel",
     {"domain.width=0.6", "domain.height=0.6", "fluid.pump.0.rate=1", "run.end_time=3e-3"},
     4,
     "a fracture has reached the outer boundary"},
    {"RockLikeJelly", {"rock.young_modulus=1"}, 4, "static equilibrium"},
    {"RockLighterThanNothing", {"rock.density=1e-20", "run.regime=dynamic"}, 2, "steps, more than"},
    {"FluidThatCrushesTheRock", {"fluid.initial_pressure=1e12"}, 4, "static equilibrium"},
    {"MeshOfNanometres", {"mesh.size_fine=1e-9", "mesh.size_coarse=1e-9"}, 2, "of memory"},
    {"EndTimeOfOneStep", {"run.end_time=1e-9"}},
    {"EndTimeOfNothing", {"run.end_time=1e-300"}},
    {"EndTimeOfThirtyYears", {"run.end_time=1e9"}, 2, "steps, more than"},
    {"FramesThatFillTheDisk", {"run.end_time=60", "output.fields_every=1e-300"}, 2, "the run would write"},
    {"AFrameAStep", {"run.end_time=1e-5", "output.fields_every=1e-300", "output.history_every=1e-300"}},
};

// Beyond cases/kgd/smoke.toml, in field time.
const std::vector<Absurd> field_time_scenes{
    {"StepOfAPicosecond", {"run.end_time=1e-12"}, 4, "no step converges at 0 s"},
    {"ThirtyThousandYears", {"run.end_time=1e12"}, 4, "the fracture has come to the end of its path"},
    {"PumpOfNothing", {"fluid.pump.0.rate=0"}},
    {"PumpOfAMillion", {"fluid.pump.0.rate=1e6"}, 4, "no step converges at"},
    {"FluidLikePitch", {"fluid.viscosity=1e6"}},
    {"HardlyAnyViscosity", {"fluid.viscosity=1e-300"}, 4, "no step converges at 0 s"},
    {"FluidWithHardlyAnyCompressibility",
     {"fluid.bulk_modulus=1e30"},
     4,
     "have not come to rest within 1.2 s"},
    {"FluidLikeVacuum", {"fluid.bulk_modulus=1"}, 4, "no step converges at"},
    {"RockLikeJelly", {"rock.young_modulus=1"}, 4, "no equilibrium of the initial fracture"},
    {"TornApart", {"stress.yy=1e8"}, 2, "an effective tension of 100 MPa"},
    {"MeshOfNanometres", {"mesh.size_fine=1e-9"}, 2, "of memory"},
    {"NotchOfANanometre", {"fracture.notch=1e-9"}},
    {"NotchAKilometreOpen", {"fracture.residual_aperture=1e3"}, 4, "no step converges at 0 s"},
    {"HardlyAnyTensileStrength", {"rock.tensile_strength=1e-3"}},
    {"TougherThanSteel", {"rock.fracture_energy_mode1=1e12"}},
    {"BrittleBeyondGlass", {"rock.fracture_energy_mode1=1e-12"}},
    {"WellLikeABalloon", {"well.storage=1e30"}, 4, "no step converges at 0 s"},
    {"RockLikeASieve",
     {"fluid.leak_off=carter", "fluid.leak_off_coefficient=1e6"},
     4,
     "no step converges at 0 s"},
    {"AFrameAStep", {"output.fields_every=1e-300", "run.end_time=1e-6"}},
};

class AbsurdScene : public CliTest, public testing::WithParamInterface<Absurd> {
 protected:
  // @param stage names it in the table of faults
  void expect_bounded(const std::string& file, const std::vector<std::string>& settings, const char* stage);
};
INSTANTIATE_TEST_SUITE_P(Of, AbsurdScene, testing::ValuesIn(scenes),
                         [](const auto& test) { return test.param.name; });

using AbsurdThreads = CliTest;

TEST_P(AbsurdScene, EndsInBoundedTimeAndMemory) {
  expect_bounded(write("case.toml", good_case), {"--set", "run.end_time=20 us"}, "explicit steps");
}

class AbsurdFieldTime : public AbsurdScene {};
INSTANTIATE_TEST_SUITE_P(Of, AbsurdFieldTime, testing::ValuesIn(field_time_scenes),
                         [](const auto& test) { return test.param.name; });

TEST_P(AbsurdFieldTime, EndsInBoundedTimeAndMemory) {
  expect_bounded(std::string(CRACKLE_SOURCE_DIR) + "/cases/kgd/smoke.toml", {}, "field time");
}

void AbsurdScene::expect_bounded(const std::string& file, const std::vector<std::string>& settings,
                                 const char* stage) {
  std::vector<std::string> arguments{"run", file, "-q", "-j", "1", "-o", path("out")};
  arguments.insert(arguments.end(), settings.begin(), settings.end());
  for (const std::string& setting : GetParam().settings)
    arguments.insert(arguments.end(), {"--set", setting});
  Process process(arguments, path("process"), [] {
    const rlimit seconds{20, 20}, bytes{rlim_t{2} << 30, rlim_t{2} << 30};
    setrlimit(RLIMIT_CPU, &seconds);
    setrlimit(RLIMIT_AS, &bytes);
  });
  const Outcome outcome = process.wait();
  const char* fault =
      "absurd but valid scenes, in 2 GB and 20 s of processor time: done, or stopped with the reason";
  if (GetParam().code != 0) {
    expect_refusal(outcome, GetParam().code, GetParam().reason);
    return report_faults(fault, 1, Left::refused, stage);
  }
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  report_faults(fault, 1, Left::survived, stage);
}

TEST_F(AbsurdThreads, MoreThanThereCanBe) {
  write("case.toml", good_case);
  const std::vector<std::string> arguments{"run",   path("case.toml"),   "-q", "-o", path("out"),
                                           "--set", "run.end_time=2 us", "-j"};
  const auto with = [&](const char* threads) {
    std::vector<std::string> all = arguments;
    all.emplace_back(threads);
    return Process(all, path("process"),
                   [] {
                     const rlimit bytes{rlim_t{2} << 30, rlim_t{2} << 30};  // stacks for some 200
                     setrlimit(RLIMIT_AS, &bytes);
                   })
        .wait();
  };
  expect_refusal(with("1024"), 2, "1024 threads cannot be had");
  EXPECT_FALSE(std::filesystem::exists(path("out/resolved.toml")));
  EXPECT_EQ(with("32").code, 0) << "more than there are cores";
  report_faults("more threads than a limit lets it have", 1, Left::refused);
}

}  // namespace
}  // namespace crackle_test
