// SPDX-License-Identifier: GPL-3.0-or-later
//
// Cost of a step per triangle: wall time x threads (core_ns_per_triangle_step) and processor time of all
// threads (cpu_ns_per_triangle_step, which other processes disturb less). `resident_bytes_per_triangle` is
// what the process grew by from its start to the end of the steps, mesh included.
//
//   build/tests/benchmark/benchmark_step [--benchmark_filter=all/100000]
//
// whole_step: a jittered square in Hilbert order, free round its edges, gently ringing; nothing breaks.
// Cohesive elements on all edges, on demand (looked for in every step, none inserted), or none. contact: on
// all edges, with so many of them broken, far from one another. stream: y += a x over arrays of 64 MiB; what
// the memory gives at most.
#include <benchmark/benchmark.h>
#include <omp.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cmath>
#include <fstream>
#include <numbers>

#include "crackle/mesh/mesh.hpp"
#include "crackle/solve/simulation.hpp"

namespace crackle {
namespace {

enum class Elements { none, on_demand, all };

double processor_seconds() {
  rusage used{};
  getrusage(RUSAGE_SELF, &used);
  return static_cast<double>(used.ru_utime.tv_sec + used.ru_stime.tv_sec) +
         1e-6 * static_cast<double>(used.ru_utime.tv_usec + used.ru_stime.tv_usec);
}

double resident_bytes() {
  std::ifstream statm("/proc/self/statm");
  double size = 0.0, resident = 0.0;
  statm >> size >> resident;
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE));
}

Scene scene(Index triangles, Elements elements, double damping) {
  const int n = static_cast<int>(std::lround(std::sqrt(triangles / 2.0)));
  Mesh mesh = jittered(structured_rectangle({0, 0}, {1, 1}, n, n, MeshPattern::right), 0.2, 1);
  order_along_hilbert_curve(mesh);
  for (Edge& edge : mesh.edges) {
    if (edge.kind == EdgeKind::outer)
      edge.kind = EdgeKind::wellbore;  // free, so that nothing is to be solved
  }
  Scene s;
  s.mesh = std::make_shared<const Mesh>(std::move(mesh));
  s.stiffness = isotropic_plane_strain(35e9, 0.27);
  s.density = 2500;
  s.damping = {0.0, damping};
  if (elements != Elements::none) {
    s.insertion.on_demand = elements == Elements::on_demand;
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

void whole_step(benchmark::State& run, Elements elements, double damping) {
  const int threads = static_cast<int>(run.range(1));
  omp_set_num_threads(threads);
  static const double before = resident_bytes();  // of the process: a benchmark is called several times
  Simulation simulation(scene(static_cast<Index>(run.range(0)), elements, damping));
  ring(simulation.state());
  const double dt = 0.5 * simulation.stable().limit;
  const auto triangles = static_cast<double>(simulation.scene().mesh->triangle_count());
  simulation.step(dt);
  std::int64_t steps = 0;
  const double start = processor_seconds();
  for (auto _ : run) {
    simulation.step(dt);
    ++steps;
  }
  run.counters["cpu_ns_per_triangle_step"] =
      1e9 * (processor_seconds() - start) / (triangles * static_cast<double>(steps));
  run.counters["core_ns_per_triangle_step"] =
      benchmark::Counter(1e-9 * triangles * static_cast<double>(steps) / threads,
                         benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
  run.counters["resident_bytes_per_triangle"] = (resident_bytes() - before) / triangles;
}

void contact(benchmark::State& run) {
  omp_set_num_threads(1);
  Scene s = scene(static_cast<Index>(run.range(0)), Elements::all, 0.0);
  const auto broken = static_cast<Index>(run.range(1));
  const Index every = std::max(1, s.mesh->edge_count() / std::max(1, broken));
  for (Index e = every / 2; e < s.mesh->edge_count() && static_cast<Index>(s.cracks.size()) < broken;
       e += every) {
    if (s.mesh->edges[static_cast<std::size_t>(e)].kind == EdgeKind::interior) s.cracks.push_back(e);
  }
  s.contact = {250e9, 30e9, s.cohesive.tan_residual};
  Simulation simulation(std::move(s));
  ring(simulation.state());
  const double dt = 0.5 * simulation.stable().limit;
  simulation.step(dt);
  const auto spent = [&] {
    return simulation.stopwatch().seconds(Stopwatch::contact) +
           simulation.stopwatch().seconds(Stopwatch::cohesive);
  };
  const double start = spent();
  std::int64_t steps = 0;
  for (auto _ : run) {
    simulation.step(dt);
    ++steps;
  }
  run.counters["broken"] = static_cast<double>(simulation.scene().cracks.size());
  run.counters["contact_us_per_step"] = 1e6 * (spent() - start) / static_cast<double>(steps);
}

void stream(benchmark::State& run) {
  omp_set_num_threads(static_cast<int>(run.range(0)));
  std::vector<double> x(std::size_t{1} << 23, 1.0), y(x.size(), 2.0);
  for (auto _ : run) {
#pragma omp parallel for schedule(static)
    for (std::size_t i = 0; i < x.size(); ++i) y[i] += 1e-9 * x[i];
    benchmark::DoNotOptimize(y.data());
  }
  run.counters["bytes_per_second"] =
      benchmark::Counter(24.0 * static_cast<double>(x.size()), benchmark::Counter::kIsIterationInvariantRate);
}

const std::vector<std::int64_t> sizes{1000, 3000, 10000, 30000, 100000, 300000, 500000, 1000000, 2000000};

BENCHMARK_CAPTURE(whole_step, all, Elements::all, 0.0)
    ->ArgsProduct({sizes, {1, 2}})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK_CAPTURE(whole_step, all_damped, Elements::all, 0.1)
    ->ArgsProduct({sizes, {1, 2}})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK_CAPTURE(whole_step, on_demand, Elements::on_demand, 0.0)
    ->ArgsProduct({sizes, {1, 2}})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK_CAPTURE(whole_step, none, Elements::none, 0.0)
    ->ArgsProduct({sizes, {1, 2}})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK(contact)
    ->ArgsProduct({{100000}, {0, 10, 100, 1000, 10000}})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK(stream)->Arg(1)->Arg(2)->UseRealTime();

}  // namespace
}  // namespace crackle

BENCHMARK_MAIN();
