// SPDX-License-Identifier: GPL-3.0-or-later
//
// A small wellbore run through fracture gives the same bits with one thread and with two.
#include <gtest/gtest.h>
#include <omp.h>

#include <cstring>

#include "../../granite.hpp"

namespace crackle {
namespace {

template <class T>
bool same_bits(const std::vector<T>& a, const std::vector<T>& b) {
  static_assert(sizeof(T) % sizeof(double) == 0);
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}

State run(int threads) {
  const int before = omp_get_max_threads();
  omp_set_num_threads(threads);
  Scene scene =
      granite::scene(granite::make({.segments = 40, .width = 2.0, .fine_radius = 0.1, .size_coarse = 0.15}));
  scene.stress = granite::anisotropic;
  scene.damping.ratio = 0.1;
  scene.law = find_law("evans_marathe");
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

TEST(Threads, SameBitsForOneAndTwo) {
  const State one = run(1), two = run(2);
  std::size_t broken = 0;
  for (const CohesiveStatus s : one.cohesive.status) broken += s >= CohesiveStatus::broken;
  std::printf("1 and 2 threads: %d triangles, %lld steps, %zu broken\n", one.mesh->triangle_count(),
              static_cast<long long>(one.step), broken);
  EXPECT_GT(one.mesh->triangle_count(), 4 * 256) << "several blocks";
  EXPECT_GT(broken, 10u);
  EXPECT_TRUE(same_bits(one.displacement, two.displacement));
  EXPECT_TRUE(same_bits(one.velocity, two.velocity));
  EXPECT_TRUE(same_bits(one.strain_rate, two.strain_rate));
  EXPECT_EQ(one.cohesive.status, two.cohesive.status);
  EXPECT_EQ(one.cohesive.history_of, two.cohesive.history_of);
  ASSERT_EQ(one.cohesive.histories.size(), two.cohesive.histories.size());
  for (std::size_t i = 0; i < one.cohesive.histories.size(); ++i) {
    const CohesiveHistory &a = one.cohesive.histories[i], &b = two.cohesive.histories[i];
    EXPECT_EQ(std::memcmp(a.point.data(), b.point.data(), sizeof(a.point)), 0) << i;
    EXPECT_EQ(a.element, b.element);
    EXPECT_EQ(std::memcmp(&a.fracture_energy, &b.fracture_energy, sizeof(double)), 0) << i;
    EXPECT_EQ(std::memcmp(&a.kinetic_rise, &b.kinetic_rise, sizeof(double)), 0) << i;
  }
  EXPECT_TRUE(same_bits(one.fluid.cavities, two.fluid.cavities));
  EXPECT_EQ(std::memcmp(&one.dissipation, &two.dissipation, sizeof(Dissipation)), 0);
}

}  // namespace
}  // namespace crackle
