// SPDX-License-Identifier: GPL-3.0-or-later
//
// Cost of a step in core-nanoseconds per triangle and step, whole and by kernel, for cohesive
// elements on all edges and on none. Each benchmark's counter core_ns_per_triangle_step is wall time
// x threads / triangles.
//
//   build/tests/benchmark/benchmark_step [--benchmark_filter=all/100000]
//
// The scene: a jittered mesh in Hilbert order, elastic, gently ringing; nothing breaks.
#include <benchmark/benchmark.h>
#include <omp.h>

#include <cmath>
#include <numbers>

#include "crackle/mesh/mesh.hpp"
#include "crackle/solve/simulation.hpp"

namespace crackle {
namespace {

Scene scene(Index triangles, bool elements, double damping) {
  const int n = static_cast<int>(std::lround(std::sqrt(triangles / 2.0)));
  Mesh mesh = jittered(structured_rectangle({0, 0}, {1, 1}, n, n, MeshPattern::right), 0.2, 1);
  order_along_hilbert_curve(mesh);
  Scene s;
  s.mesh = std::make_shared<const Mesh>(std::move(mesh));
  s.stiffness = isotropic_plane_strain(35e9, 0.27);
  s.density = 2500;
  s.stress = {-7.05e6, -4.9e6, 0.0};
  s.damping = {0.0, damping};
  if (elements) {
    s.law = find_law("evans_marathe");
    const double tan_phi = std::tan(38.0 * std::numbers::pi / 180.0);
    s.cohesive = {3e6, 24e6, tan_phi, tan_phi, 5.0, 80.0, 120e9, 120e9, Calibration::y_geo};
  }
  return s;
}

// A field of small velocities, so that no number is denormal or trivially zero.
void ring(State& state) {
  for (Index n = 0; n < state.node_count(); ++n) {
    const Vec2 x = state.node_reference(n);
    if (state.inverse_mass[static_cast<std::size_t>(n)] > 0.0) {
      state.velocity[static_cast<std::size_t>(n)] = {1e-4 * std::sin(7.0 * x.x + x.y),
                                                     1e-4 * std::cos(5.0 * x.y)};
    }
  }
}

void whole_step(benchmark::State& run, bool elements, double damping) {
  const int threads = static_cast<int>(run.range(1));
  omp_set_num_threads(threads);
  Simulation simulation(scene(static_cast<Index>(run.range(0)), elements, damping));
  ring(simulation.state());
  const double dt = 0.5 * simulation.stable().limit;
  const auto triangles = static_cast<double>(simulation.scene().mesh->triangle_count());
  std::int64_t steps = 0;
  for (auto _ : run) {
    simulation.step(dt);
    ++steps;
  }
  run.counters["core_ns_per_triangle_step"] =
      benchmark::Counter(1e-9 * triangles * static_cast<double>(steps) / threads,
                         benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

void rock_forces(benchmark::State& run) {
  omp_set_num_threads(1);
  Simulation simulation(scene(static_cast<Index>(run.range(0)), false, 0.0));
  const Index triangles = simulation.scene().mesh->triangle_count();
  std::vector<Vec2> forces(static_cast<std::size_t>(3 * triangles));
  for (auto _ : run) {
    simulation.bulk().corner_forces(simulation.state(), 0, triangles, forces.data());
    benchmark::DoNotOptimize(forces.data());
  }
  run.counters["core_ns_per_triangle_step"] = benchmark::Counter(
      1e-9 * triangles, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void cohesive_tractions(benchmark::State& run) {
  omp_set_num_threads(1);
  Simulation simulation(scene(static_cast<Index>(run.range(0)), true, 0.0));
  Cohesive cohesive(simulation.scene().law, simulation.scene().cohesive);
  for (auto _ : run) cohesive.add_tractions(simulation.state());
  run.counters["core_ns_per_triangle_step"] =
      benchmark::Counter(1e-9 * simulation.scene().mesh->triangle_count(),
                         benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

const std::vector<std::int64_t> sizes{10000, 100000, 1000000};

BENCHMARK_CAPTURE(whole_step, all, true, 0.0)
    ->ArgsProduct({sizes, {1, 2}})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK_CAPTURE(whole_step, all_damped, true, 0.1)
    ->ArgsProduct({sizes, {1, 2}})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK_CAPTURE(whole_step, none, false, 0.0)
    ->ArgsProduct({sizes, {1, 2}})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK(rock_forces)->ArgsProduct({sizes})->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(cohesive_tractions)->ArgsProduct({sizes})->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace crackle

BENCHMARK_MAIN();
