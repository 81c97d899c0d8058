// SPDX-License-Identifier: GPL-3.0-or-later
//
// A small wellbore run through fracture gives the same bits with any number of threads, also with more
// threads than processors.
#include <gtest/gtest.h>
#include <omp.h>

#include "../../granite.hpp"
#include "crackle/state/members.hpp"

namespace crackle {
namespace {

enum class Breaking { all_edges, on_demand, damage };

State run(Breaking breaking, int threads) {
  const int before = omp_get_max_threads();
  omp_set_num_threads(threads);
  Scene scene =
      granite::scene(granite::make({.segments = 40, .width = 2.0, .fine_radius = 0.1, .size_coarse = 0.15}));
  scene.stress = granite::anisotropic;
  scene.damping.ratio = 0.1;
  if (breaking == Breaking::damage) {
    DamageMaterial m{3e6, 24e6, 0.7, 0.7, 5.0, 80.0};
    m.apply(DamagePreset::recommended);
    scene.damage.law = find_softening("linear");
    scene.damage.materials = {m};
  } else {
    scene.law = find_law("evans_marathe");
    scene.insertion.on_demand = breaking == Breaking::on_demand;
  }
  scene.cohesive = granite::cohesive();
  scene.contact = {250e9, 30e9, scene.cohesive.tan_residual};
  scene.fluid = CompressibleFluid{1.45e9, 1000.0, 0.0};
  scene.pump = Pump({{0.0, 1.0, 1.6}});
  Simulation simulation(scene);
  const double dt = 0.8 * simulation.stable().limit;
  for (int i = 0; i < 350; ++i) i % 50 == 0 ? (void)simulation.step_and_account(dt) : simulation.step(dt);
  omp_set_num_threads(before);
  return simulation.state();
}

// The first column in which two states differ; empty: none.
std::string difference(State& a, State& b) {
  const std::vector<Column> left = columns_of(a, "state"), right = columns_of(b, "state");
  const auto bytes = [](const Column& column) {
    std::vector<std::byte> all(column.count * column.item_bytes());
    column.gather(all.data());
    return all;
  };
  for (std::size_t c = 0; c < left.size(); ++c) {
    if (bytes(left[c]) != bytes(right[c])) return left[c].name;
  }
  return {};
}

class Threads : public testing::TestWithParam<Breaking> {};
INSTANTIATE_TEST_SUITE_P(OnDemand, Threads,
                         testing::Values(Breaking::all_edges, Breaking::on_demand, Breaking::damage));

TEST_P(Threads, SameBitsForAnyNumber) {
  State one = run(GetParam(), 1);
  std::size_t broken = 0;
  for (const CohesiveStatus s : one.cohesive.status) broken += s >= CohesiveStatus::broken;
  for (const DamagedTriangle& d : one.damage.triangles) broken += d.failed;
  EXPECT_GT(one.mesh->triangle_count(), 4 * 256) << "several blocks";
  EXPECT_GT(broken, 10u);
  for (const int threads : {2, 3, 8}) {
    State more = run(GetParam(), threads);
    EXPECT_EQ(difference(one, more), "") << threads << " threads";
  }
  std::printf("1, 2, 3 and 8 threads: %d triangles, %lld steps, %zu broken\n", one.mesh->triangle_count(),
              static_cast<long long>(one.step), broken);
}

}  // namespace
}  // namespace crackle
