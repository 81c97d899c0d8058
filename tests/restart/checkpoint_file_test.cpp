// SPDX-License-Identifier: GPL-3.0-or-later
//
// A checkpoint of a run in the middle of breaking: read back it is the same to the bit, and the
// simulation made from it goes on as the first one would have.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "../fault.hpp"
#include "../granite.hpp"
#include "crackle/core/errors.hpp"
#include "crackle/io/checkpoint.hpp"
#include "crackle/solve/members.hpp"

namespace crackle {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

struct Variant {
  const char* name;
  bool on_demand, absorbing;
};
void PrintTo(const Variant& variant, std::ostream* stream) { *stream << variant.name; }

Scene breaking_scene(const Variant& variant) {
  Scene scene =
      granite::scene(granite::make({.segments = 24, .width = 1.0, .fine_radius = 0.1, .size_coarse = 0.1}));
  scene.stress = granite::anisotropic;
  scene.damping.ratio = 0.1;
  scene.law = find_law("evans_marathe");
  scene.cohesive = granite::cohesive();
  scene.cohesive.calibration = Calibration::y_geo;
  scene.contact = {120e9, 30e9, scene.cohesive.tan_residual};
  scene.insertion.on_demand = variant.on_demand;
  scene.absorbing_boundary = variant.absorbing;
  scene.fluid = CompressibleFluid{1.45e9, 1000.0, 0.0};
  scene.pump = Pump({{0.0, 1.0, 1.6}});
  return scene;
}

struct Kept {
  Mesh mesh;
  State state;
  SimulationMemory memory;

  std::vector<Column> columns() {
    std::vector<Column> all = columns_of(mesh, "mesh");
    for (auto&& more : {columns_of(state, "state"), columns_of(memory, "simulation")})
      all.insert(all.end(), more.begin(), more.end());
    return all;
  }
};

Kept keep(const Simulation& simulation) {
  return {*simulation.state().mesh, simulation.state(), simulation.memory()};
}

std::string pack(Kept& kept) {
  return pack_checkpoint({"1.2.3", kept.state.step, kept.state.time}, kept.columns(), "case");
}

std::vector<std::byte> bytes_of(const Column& column) {
  std::vector<std::byte> bytes(column.count * column.item_bytes());
  column.gather(bytes.data());
  return bytes;
}

// The first column in which they differ; empty: none.
std::string difference(Kept& a, Kept& b) {
  const std::vector<Column> left = a.columns(), right = b.columns();
  for (std::size_t c = 0; c < left.size(); ++c) {
    if (bytes_of(left[c]) != bytes_of(right[c])) return left[c].name;
  }
  return {};
}

// Steps, every fiftieth with the ledger, as a run does.
void run(Simulation& simulation, int steps) {
  for (int i = 0; i < steps; ++i) {
    const double dt = 0.8 * simulation.stable_limit();
    simulation.state().step % 50 == 0 ? (void)simulation.step_and_account(dt) : simulation.step(dt);
  }
}

int broken(const State& state) {
  int count = 0;
  for (const CohesiveStatus s : state.cohesive.status) count += s >= CohesiveStatus::broken;
  return count;
}

class CheckpointFile : public testing::TestWithParam<Variant> {};
INSTANTIATE_TEST_SUITE_P(Of, CheckpointFile,
                         testing::Values(Variant{"all", false, false}, Variant{"all_absorbing", false, true},
                                         Variant{"on_demand", true, false},
                                         Variant{"on_demand_absorbing", true, true}),
                         [](const auto& test) { return test.param.name; });

TEST_P(CheckpointFile, RoundTripAndGoingOnGiveTheSameBits) {
  Simulation first(breaking_scene(GetParam()));
  run(first, 330);
  ASSERT_GT(broken(first.state()), 3);
  Kept before = keep(first), after;
  EXPECT_EQ(unpack_checkpoint(pack(before), "file", after.columns()), "case");
  EXPECT_EQ(difference(before, after), "");

  auto mesh = std::make_shared<const Mesh>(std::move(after.mesh));
  after.state.mesh = mesh;
  Scene scene = breaking_scene(GetParam());
  scene.mesh = mesh;
  Simulation second(scene, std::move(after.state), std::move(after.memory));
  run(first, 120);
  run(second, 120);
  Kept one = keep(first), two = keep(second);
  std::printf("checkpoint at %d broken elements, compared at %d of %d columns\n", broken(before.state),
              broken(one.state), static_cast<int>(one.columns().size()));
  EXPECT_GT(broken(one.state), broken(before.state)) << "goes on breaking";
  EXPECT_EQ(difference(one, two), "");
}

// The comparison sees a change of any column.
TEST(CheckpointDifference, IsSeenInEveryColumn) {
  Simulation simulation(breaking_scene({"", true, true}));
  run(simulation, 330);
  Kept kept = keep(simulation);
  int checked = 0;
  for (std::size_t c = 0; c < kept.columns().size(); ++c) {
    Kept other = kept;
    const Column column = other.columns()[c];
    if (column.count == 0) continue;
    std::vector<std::byte> bytes = bytes_of(column);
    bytes.back() ^= std::byte{1};
    column.scatter(bytes.data(), column.count);
    EXPECT_EQ(difference(kept, other), column.name);
    ++checked;
  }
  EXPECT_GT(checked, 60);
}

class DamagedCheckpoint : public testing::Test {
 protected:
  DamagedCheckpoint() {
    Simulation simulation(breaking_scene({"", false, false}));
    kept_ = keep(simulation);
    bytes_ = pack(kept_);
  }
  // @param fault names it in the table of faults
  void expect_refused(const char* fault, const std::string& bytes, const std::string& why) {
    Kept untouched;
    EXPECT_THAT([&] { unpack_checkpoint(bytes, "file.h5", untouched.columns()); },
                ThrowsMessage<CaseError>(testing::AllOf(testing::StartsWith("file.h5: "), HasSubstr(why))));
    EXPECT_EQ(untouched.state.step, 0);
    EXPECT_TRUE(untouched.mesh.vertices.empty());
    crackle_test::report_faults("what is no checkpoint of this crackle", 1, crackle_test::Left::refused,
                                fault);
  }
  Kept kept_;
  std::string bytes_;
};

TEST_F(DamagedCheckpoint, Foreign) {
  expect_refused("foreign", "", "not a checkpoint of crackle");
  expect_refused("foreign", "\x89HDF\r\n\x1a\n" + std::string(1000, '\0'), "not a checkpoint of crackle");
  expect_refused("foreign", "time_s,time_step_s\n", "not a checkpoint of crackle");
  expect_refused("foreign", "crackle checkpoint\nformat 1\n", "cut short");
}

TEST_F(DamagedCheckpoint, CutShortAnywhere) {
  for (const std::size_t size : {std::size_t{20}, std::size_t{511}, std::size_t{512}, std::size_t{513},
                                 bytes_.size() / 2, bytes_.size() - 1}) {
    expect_refused("cut short or too long", bytes_.substr(0, size), "cut short");
  }
  expect_refused("cut short or too long", bytes_ + '\0', "bytes long instead of");
}

TEST_F(DamagedCheckpoint, AnyBitFlipped) {
  std::mt19937 random(1);
  int refused = 0;
  for (int i = 0; i < 300; ++i) {
    std::string flipped = bytes_;
    // half of them in the text of the head
    const std::size_t at = random() % (i % 2 == 0 ? 150 : flipped.size());
    flipped[at] = static_cast<char>(flipped[at] ^ (1 << random() % 8));
    try {
      Kept other;
      unpack_checkpoint(flipped, "file.h5", other.columns());
      ADD_FAILURE() << "byte " << at;
    } catch (const CaseError&) {
      ++refused;
    }
  }
  crackle_test::report_faults("bits flipped in a checkpoint, head and data", refused,
                              crackle_test::Left::refused);
}

TEST_F(DamagedCheckpoint, OfAnotherFormat) {
  std::string other = bytes_;
  other.replace(other.find("format 1"), 8, "format 7");
  expect_refused("of another format", other,
                 "a checkpoint of format 7 (crackle 1.2.3), this crackle reads format 1");
}

TEST_F(DamagedCheckpoint, OfACrackleThatKeepsOtherNumbers) {
  std::vector<Column> fewer = kept_.columns();
  std::erase_if(fewer, [](const Column& c) { return c.name == "state/cohesive/offset"; });
  expect_refused("with other columns", pack_checkpoint({"1.2.3", 1, 0.0}, fewer, "case"),
                 "state/cohesive/offset is not in it");
  std::vector<Column> wider = kept_.columns();
  for (Column& c : wider) {
    if (c.name == "state/cohesive/edge") c.number = Number::uint8;
  }
  expect_refused("with other columns", pack_checkpoint({"1.2.3", 1, 0.0}, wider, "case"),
                 "state/cohesive/edge holds other numbers");
}

}  // namespace
}  // namespace crackle
