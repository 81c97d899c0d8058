// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <numbers>
#include <sstream>
#include <string>

#include "crackle/core/errors.hpp"
#include "crackle/io/case.hpp"

namespace crackle {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::StartsWith;
using testing::ThrowsMessage;

const std::string good_path = CRACKLE_SOURCE_DIR "/tests/unit/io/bad_cases/good.toml";

std::string good_text() {
  std::ifstream stream(good_path);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

Case good(const std::vector<std::string>& overrides = {}) { return read_case(good_path, overrides); }

/// A folder of its own for each test, gone at its end.
class CaseFiles : public testing::Test {
 protected:
  CaseFiles() { fs::create_directories(folder_); }
  ~CaseFiles() override { fs::remove_all(folder_); }
  std::string write(const std::string& name, const std::string& text) {
    const fs::path path = folder_ / name;
    fs::create_directories(path.parent_path());
    std::ofstream(path, std::ios::binary) << text;
    return path.string();
  }
  fs::path folder_ = fs::path(testing::TempDir()) /
                     (std::string("case_") + testing::UnitTest::GetInstance()->current_test_info()->name());
};

TEST(CaseRead, ConvertsUnits) {
  const Case scene = good();
  EXPECT_EQ(scene.title, "granite wellbore");
  EXPECT_EQ(scene.file, good_path);
  EXPECT_EQ(scene.domain.width, 5.0);
  EXPECT_EQ(scene.mesh.size_fine, 0.003);
  EXPECT_EQ(scene.rock.young_modulus, 35e9);
  EXPECT_DOUBLE_EQ(scene.rock.friction_angle, 38.0 * std::numbers::pi / 180.0);
  EXPECT_EQ(scene.rock.fracture_energy_mode2, 50.0);
  EXPECT_EQ(scene.stress, (Sym2{-7.05e6, -4.9e6, 0.0}));
  ASSERT_EQ(scene.fluid.pump.size(), 1U);
  EXPECT_EQ(scene.fluid.pump[0].rate, 0.065);
  EXPECT_EQ(scene.seismic.latitude, 47.0);
  EXPECT_EQ(scene.seismic.depth, 1000.0);
  EXPECT_EQ(scene.seismic.epoch, "2015-06-01T00:00:00Z");
}

TEST(CaseRead, APresetIsForWhatIsNotGiven) {
  const Case y_geo = good({"cohesive.preset=y_geo"});
  EXPECT_EQ(y_geo.cohesive.law, "evans_marathe");
  EXPECT_EQ(y_geo.cohesive.calibration, "y_geo");
  EXPECT_EQ(y_geo.cohesive.insertion, "all");
  const Case exact = good({"cohesive.preset=y_geo", "cohesive.calibration=exact"});
  EXPECT_EQ(exact.cohesive.law, "evans_marathe");
  EXPECT_EQ(exact.cohesive.calibration, "exact");
}

TEST(CaseRead, FillsDefaultsThatFollowFromOtherKeys) {
  const Case scene = good();
  EXPECT_EQ(scene.cohesive.law, "benzeggagh_kenane");
  EXPECT_EQ(scene.cohesive.insertion, "on_demand");
  EXPECT_EQ(scene.cohesive.calibration, "exact");
  EXPECT_EQ(scene.cohesive.penalty, 20.0 * 35e9);
  EXPECT_EQ(scene.contact.normal_penalty, scene.cohesive.penalty);
  EXPECT_EQ(scene.contact.tangential_penalty, scene.cohesive.penalty);
  EXPECT_EQ(scene.contact.friction_angle, scene.rock.friction_angle);
  EXPECT_EQ(scene.damping.ratio, 0.1);
  EXPECT_FALSE(scene.damping.viscosity);
  EXPECT_EQ(scene.run.time_step, 0.0);
  EXPECT_EQ(scene.output.fields_every, scene.run.end_time / 20.0);
  EXPECT_EQ(scene.output.history_every, scene.run.end_time / 1000.0);
  EXPECT_EQ(scene.wellbore.segments, 0);
}

TEST(CaseRead, KeepsWhatIsGiven) {
  const Case scene = good({"cohesive.penalty=120 GPa", "contact.tangential_penalty=1 GPa",
                           "contact.friction_angle=0", "damping.viscosity=1e4", "run.time_step=1e-8"});
  EXPECT_EQ(scene.contact.normal_penalty, 120e9);
  EXPECT_EQ(scene.contact.tangential_penalty, 1e9);
  EXPECT_EQ(scene.contact.friction_angle, 0.0);
  EXPECT_EQ(scene.damping.viscosity, 1e4);
  EXPECT_FALSE(scene.damping.ratio);
  EXPECT_EQ(scene.run.time_step, 1e-8);
}

TEST(CaseRead, SortsPumpStagesAndEndsAnOpenOneWithTheRun) {
  const Case scene =
      good({"fluid.pump=[{from='1 ms', rate=2}, {to='0.5 ms', rate=1}, {from=5e-4, to=1e-3, rate=0}]"});
  ASSERT_EQ(scene.fluid.pump.size(), 3U);
  EXPECT_EQ(scene.fluid.pump[0].rate, 1.0);
  EXPECT_EQ(scene.fluid.pump[1].rate, 0.0);
  EXPECT_EQ(scene.fluid.pump[2].from, 1e-3);
  EXPECT_EQ(scene.fluid.pump[2].to, scene.run.end_time);
}

TEST(CaseRead, NamesEachMissingKeyAndItsTable) {
  for (const CaseKey& key : case_keys()) {
    // joints and notches: lists that may be empty
    if (!key.default_value.empty() || key.table == "joints" || key.table == "notches") continue;
    std::istringstream lines(good_text());
    std::string text;
    int dropped = 0;
    std::string table;
    for (std::string line; std::getline(lines, line);) {
      if (line.starts_with('['))
        table = line.substr(line.find_last_of('[') + 1, line.find(']') - line.rfind('[') - 1);
      const bool drop = table == key.table && line.starts_with(key.key + " ");
      dropped += drop;
      text += (drop ? "" : line) + "\n";
    }
    EXPECT_EQ(dropped, 1) << key.table << "." << key.key;
    EXPECT_THAT([&] { parse_case(text, "a.toml"); },
                ThrowsMessage<CaseError>(HasSubstr("missing key " + key.key + " in [")))
        << key.table;
  }
}

TEST(CaseRead, NeedsNeitherWellboreNorFluidWithoutAPump) {
  const Case scene = good({"fluid.pump=[]", "wellbore={}"});
  EXPECT_EQ(scene.wellbore.diameter, 0.0);
  EXPECT_THAT([] { good({"wellbore={}"}); }, ThrowsMessage<CaseError>(HasSubstr("missing key diameter")));
}

TEST(CaseRead, TakesNamesThatTheCallerAdds) {
  const CaseNames names{{{"cohesive.law", {"my_law"}}}};
  EXPECT_EQ(read_case(good_path, {"cohesive.law=my_law"}, names).cohesive.law, "my_law");
  EXPECT_THAT(
      [&] { read_case(good_path, {"cohesive.law=my_lew"}, names); },
      ThrowsMessage<CaseError>(HasSubstr("\"benzeggagh_kenane\" or \"my_law\"; the nearest is \"my_law\"")));
}

TEST_F(CaseFiles, MeshFileStandsForDomainAndSizes) {
  write("meshes/a.msh", "$MeshFormat");
  std::string text = good_text();
  text.replace(text.find("[domain]"), text.find("[rock]") - text.find("[domain]"),
               "[mesh]\nfile = 'meshes/a.msh'\n");
  const Case scene = read_case(write("case.toml", text));
  EXPECT_EQ(scene.mesh.file, (folder_ / "meshes/a.msh").lexically_normal().string());
  const std::string resolved = resolved_toml(scene);
  EXPECT_EQ(resolved_toml(read_case(write("elsewhere/resolved.toml", resolved))), resolved);
}

TEST_F(CaseFiles, IncludingFileWins) {
  write("parts/rock.toml", "[rock]\ndensity = 1\ncohesion = 2\n[damping]\nratio = 0.2\n");
  write("parts/more.toml", "include = 'rock.toml'\n[rock]\ncohesion = 3\nyoung_modulus = '4 Pa'\n");
  const std::string base = write("base.toml", good_text());
  const std::string text = "include = ['" + base + "', 'parts/more.toml']\n[rock]\nyoung_modulus = '5 Pa'\n" +
                           "[damping]\nviscosity = 7\n[[fluid.pump]]\nrate = 8\n";
  const Case scene = read_case(write("case.toml", text), {"rock.tensile_strength=6"});
  EXPECT_EQ(scene.rock.density, 1.0);
  EXPECT_EQ(scene.rock.cohesion, 3.0);
  EXPECT_EQ(scene.rock.young_modulus, 5.0);
  EXPECT_EQ(scene.rock.tensile_strength, 6.0);
  EXPECT_EQ(scene.rock.poisson_ratio, 0.25);
  EXPECT_EQ(scene.damping.viscosity, 7.0);
  EXPECT_FALSE(scene.damping.ratio);
  ASSERT_EQ(scene.fluid.pump.size(), 1U);
  EXPECT_EQ(scene.fluid.pump[0].rate, 8.0);
}

TEST_F(CaseFiles, ErrorOfAnIncludedFileIsPlacedThere) {
  const std::string base = write("parts/base.toml", "\n[rock]\ndensity = '2 m'\n");
  const std::string path = write("case.toml", "include = 'parts/base.toml'\n");
  EXPECT_THAT([&] { read_case(path); },
              ThrowsMessage<CaseError>(StartsWith(base + ":3:11: rock.density = \"2 m\"")));
}

TEST_F(CaseFiles, CycleOfIncludesNamesItsChain) {
  const std::string a = write("a.toml", "include = 'b.toml'\n");
  const std::string b = write("b.toml", "\ninclude = ['./a.toml']\n");
  EXPECT_THAT([&] { read_case(a); }, ThrowsMessage<CaseError>(StartsWith(
                                         b + ":2:12: files include each other: " + a + " -> " + b + " -> ")));
  const std::string own = write("own.toml", "include = 'own.toml'\n");
  EXPECT_THAT([&] { read_case(own); }, ThrowsMessage<CaseError>(HasSubstr("files include each other")));
}

TEST_F(CaseFiles, TooManyIncludesEnd) {
  write("leaf.toml", "");
  std::string list = "include = [";
  for (int i = 0; i < 300; ++i) list += "'leaf.toml',";
  const std::string path = write("case.toml", list + "]\n");
  EXPECT_THAT([&] { read_case(path); }, ThrowsMessage<CaseError>(HasSubstr("too many included files")));
}

TEST_F(CaseFiles, FilesThatCannotBeRead) {
  const auto refused = [](const std::string& path, const std::string& message) {
    EXPECT_THAT([&] { read_case(path); }, ThrowsMessage<CaseError>(StartsWith(path + ": " + message)))
        << path;
  };
  refused((folder_ / "none.toml").string(), "cannot be read: No such file");
  refused(folder_.string(), "this is a folder");
  refused(write("empty.toml", ""), "the case file is empty");
  refused(write("large.toml", std::string((16 << 20) + 1, '\n')), "too large");
  EXPECT_THROW(read_case(""), CaseError);
}

TEST(CaseOverrides, AreTomlValuesOrBareTexts) {
  EXPECT_EQ(good({"mesh.size_fine=6 mm"}).mesh.size_fine, 0.006);
  EXPECT_EQ(good({"mesh.size_fine=0.006"}).mesh.size_fine, 0.006);
  EXPECT_EQ(good({" mesh.size_fine = \"6 mm\" "}).mesh.size_fine, 0.006);
  EXPECT_EQ(good({"fluid.pump.0.rate=30 l/s"}).fluid.pump[0].rate, 0.030);
  EXPECT_EQ(good({"fluid.pump.1.rate=30 l/s", "fluid.pump.1.from=1 ms"}).fluid.pump.at(1).rate, 0.030);
  EXPECT_EQ(good({"title=a = b"}).title, "a = b");
  EXPECT_EQ(good({"seismic.reference.epoch=2020-01-01"}).seismic.epoch, "2020-01-01");
  EXPECT_EQ(good({"output.fields=['a', 'b']"}).output.fields, (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(good({"mesh.seed=1", "mesh.seed=2"}).mesh.seed, 2U);
}

TEST(CaseOverrides, MakeAListOfTablesThatIsNotThere) {
  const Case scene = good({"fluid.pump=[]", "fluid.pump.0.rate=30 l/s"});
  ASSERT_EQ(scene.fluid.pump.size(), 1U);
}

}  // namespace
}  // namespace crackle
