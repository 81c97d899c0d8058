// SPDX-License-Identifier: GPL-3.0-or-later
//
// Highest frequency by Lanczos' method: against the eigenvalues of a matrix made from the program's own
// forces, and against the step at which a run blows up (T1 of methods.md 3.5).
#include "crackle/solve/lanczos.hpp"

#include <gtest/gtest.h>
#include <omp.h>

#include <Eigen/Dense>

#include "../../result.hpp"
#include "../solid/static_solve.hpp"

namespace crackle {
namespace {

using granite::at;

struct Body {
  const char* name;
  std::shared_ptr<const Mesh> mesh;
  double penalty;  // over Young's modulus; 0: tied
  double damping = 0.0;
};

std::vector<Body> bodies(int cells) {
  const Mesh cross = structured_rectangle({0, 0}, {1, 1}, cells, cells, MeshPattern::cross);
  const Mesh flat = structured_rectangle({0, 0}, {1, 0.2}, cells, cells, MeshPattern::right);
  return {{"tied", granite::free_body(jittered(cross, 0.25, 3)), 0.0},
          {"tied, flat triangles", granite::free_body(flat), 0.0},
          {"elements 3.43 E", granite::free_body(jittered(cross, 0.25, 4)), 3.43},
          {"elements 50 E", granite::free_body(jittered(cross, 0.25, 5)), 50.0}};
}

struct Built {
  State state;
  Bulk bulk;
  std::unique_ptr<Cohesive> cohesive;

  explicit Built(const Body& body)
      : state(body.penalty > 0.0 ? make_split_state(body.mesh) : make_tied_state(body.mesh)),
        bulk(*body.mesh, granite::stiffness(), granite::density, {}, {0.0, body.damping}) {
    set_mass(state, granite::density);
    if (body.penalty == 0.0) return;
    insert_all(state);
    cohesive = std::make_unique<Cohesive>(find_law("linear"),
                                          granite::unbreakable(body.penalty * granite::young_modulus));
  }
};

TEST(Lanczos, FindsTheLargestEigenvalue) {
  for (const Body& body : bodies(4)) {
    Built b(body);
    const NodalForces forces{b.bulk, b.cohesive.get(), {}};
    const Index size = 2 * b.state.node_count();
    Eigen::MatrixXd matrix(size, size);
    const double step = 1e-9;
    for (Index column = 0; column < size; ++column) {
      double& u =
          column % 2 == 0 ? b.state.displacement[at(column / 2)].x : b.state.displacement[at(column / 2)].y;
      u = step;
      const std::vector<Vec2> up = forces(b.state);
      u = -step;
      const std::vector<Vec2> down = forces(b.state);
      u = 0.0;
      for (Index row = 0; row < size; ++row) {
        const Vec2 change = (0.5 / step) * (down[at(row / 2)] - up[at(row / 2)]);
        matrix(row, column) =
            (row % 2 == 0 ? change.x : change.y) *
            std::sqrt(b.state.inverse_mass[at(row / 2)] * b.state.inverse_mass[at(column / 2)]);
      }
    }
    const double exact =
        std::sqrt(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(0.5 * (matrix + matrix.transpose()))
                      .eigenvalues()[size - 1]);
    const HighestFrequency found = highest_frequency(b.state, b.bulk, b.cohesive.get());
    const double bound = 2.0 / stable_step(b.state, b.bulk, b.cohesive.get()).limit;
    std::printf("%s, %d unknowns: frequency %+.1e off, residual %.1e; bound of the time step %+.1f %%\n",
                body.name, size, found.frequency / exact - 1.0, found.residual,
                100.0 * (bound / exact - 1.0));
    EXPECT_LE(found.frequency, exact * (1.0 + 1e-6));
    EXPECT_GE(found.frequency, exact * (1.0 - 1e-3));
    EXPECT_GE(bound, exact * (1.0 - 1e-6));
  }
}

TEST(Lanczos, IsThereAfterFortyProductsOnAGradedMesh) {
  const auto mesh = granite::make({.segments = 60, .width = 2.0, .fine_radius = 0.1, .size_coarse = 0.2});
  for (const double penalty : {0.0, 5.0, 50.0}) {
    const Built b({"wellbore", mesh, penalty});
    const double sure = highest_frequency(b.state, b.bulk, b.cohesive.get(), 300).frequency;
    for (const int products : {10, 20, 40}) {
      const HighestFrequency found = highest_frequency(b.state, b.bulk, b.cohesive.get(), products);
      std::printf("%d triangles, penalty %2.0f E, %d products: %.1e below, residual %.1e\n",
                  mesh->triangle_count(), penalty, products, 1.0 - found.frequency / sure, found.residual);
      if (products < 40) continue;
      EXPECT_LE(found.frequency, sure * (1.0 + 1e-12));
      EXPECT_GE(found.frequency, sure * (1.0 - 1e-3));
    }
  }
}

// Whether so many steps of length dt from a slight disturbance stay bounded.
bool stays_bounded(const Body& body, double dt, int steps) {
  Scene scene = granite::scene(body.mesh);
  scene.damping.ratio = body.damping;
  if (body.penalty > 0.0) {
    scene.law = find_law("linear");
    scene.cohesive = granite::unbreakable(body.penalty * granite::young_modulus);
  }
  Simulation simulation(scene);
  State& state = simulation.state();
  for (Index n = 0; n < state.node_count(); ++n)
    state.velocity[at(n)] = {1e-9 * std::sin(37.0 * n), 1e-9 * std::cos(53.0 * n)};
  for (int i = 0; i < steps; ++i) {
    simulation.step(dt);
    if (norm(state.velocity[at(0)]) > 1e-4 || !std::isfinite(state.velocity[at(0)].x)) return false;
  }
  for (const Vec2 v : state.velocity) {
    if (!(norm(v) < 1e-7)) return false;
  }
  return true;
}

double blow_up(const Body& body, double estimate) {
  double low = 0.9, high = 1.3;
  while (stays_bounded(body, high * estimate, 1000)) high *= 1.3;
  for (int i = 0; i < 9; ++i) {
    const double middle = 0.5 * (low + high);
    (stays_bounded(body, middle * estimate, 1000) ? low : high) = middle;
  }
  return low;
}

TEST(Lanczos, PredictsTheStepAtWhichARunBlowsUp) {
  const Check check("T1 step at which a run blows up");
  double worst = 0.0;
  for (const Body& body : bodies(5)) {
    const Built b(body);
    const double step = highest_frequency(b.state, b.bulk, b.cohesive.get()).stable_step();
    const double factor = blow_up(body, step);
    const double bound = stable_step(b.state, b.bulk, b.cohesive.get()).limit;
    std::printf("%s: blows up at %.4f of the step from Lanczos, %.3f of the proven bound\n", body.name,
                factor, factor * step / bound);
    worst = std::max(worst, std::abs(factor - 1.0));
    EXPECT_NEAR(factor, 1.0, 0.005);
    EXPECT_GE(factor * step / bound, 0.995);
  }
  check.result(worst);
}

// With viscosity the two largest eigenvalues need not meet in one mode: never too long, seldom much
// too short.
TEST(Lanczos, StepIsOnTheSafeSideWithViscosity) {
  for (Body body : bodies(5)) {
    for (const double damping : {0.1, 1.0, 10.0}) {
      body.damping = damping;
      const Built b(body);
      const double step = highest_frequency(b.state, b.bulk, b.cohesive.get()).stable_step();
      const double factor = blow_up(body, step);
      std::printf("%s, %4.1f of critical damping: blows up at %.3f of the step\n", body.name, damping,
                  factor);
      EXPECT_GE(factor, 0.995);
      EXPECT_LE(factor, 1.5);
    }
  }
}

// Few products find too low a frequency; the safe step knows that it may be.
TEST(Lanczos, SafeStepIsNeverTooLong) {
  double lowest = 1.0, sharpest = 0.0;
  for (unsigned seed = 1; seed <= 12; ++seed) {
    const auto mesh = granite::free_body(
        jittered(structured_rectangle({0, 0}, {1, 1}, 6, 6, MeshPattern::cross), 0.3, seed));
    for (const double penalty : {0.0, 10.0}) {
      const Built b({"jittered", mesh, penalty, 0.1});
      const HighestFrequency sure = highest_frequency(b.state, b.bulk, b.cohesive.get(), 200);
      for (const int products : {4, 8, 20, 40, 80}) {
        const HighestFrequency found = highest_frequency(b.state, b.bulk, b.cohesive.get(), products);
        lowest = std::min(lowest, found.frequency / sure.frequency);
        sharpest = std::max(sharpest, found.safe_step() / sure.stable_step());
        EXPECT_LE(found.frequency, sure.frequency * (1.0 + 1e-9));
        EXPECT_LE(found.viscous_rate, sure.viscous_rate * (1.0 + 1e-9));
        EXPECT_LE(found.safe_step(), sure.stable_step() * (1.0 + 1e-9))
            << products << " products, seed " << seed;
      }
    }
  }
  std::printf("estimates down to %.3f of the frequency; safe steps up to %.3f of the true one\n", lowest,
              sharpest);
  EXPECT_LT(lowest, 0.99) << "the estimate alone would have been too long a step";
  EXPECT_GT(sharpest, 0.95);
}

TEST(Lanczos, SharpenedStepIsLongerThanTheProvenOneAndStable) {
  for (const Body& body : bodies(5)) {
    const Built b(body);
    const StableStep proven = stable_step(b.state, b.bulk, b.cohesive.get());
    const StableStep step = sharpened(proven, b.state, b.bulk, b.cohesive.get());
    std::printf("%s: %.3f of the proven step\n", body.name, step.limit / proven.limit);
    EXPECT_GT(step.limit, 1.05 * proven.limit);
    EXPECT_EQ(step.proven, proven.limit);
    EXPECT_NE(step.explain(*body.mesh).find("highest frequency"), std::string::npos);
    EXPECT_TRUE(stays_bounded(body, 0.999 * step.limit, 20000)) << body.name;
  }
}

TEST(Lanczos, SameBitsWithAnyThreads) {
  const Body body{
      "cross",
      granite::free_body(jittered(structured_rectangle({0, 0}, {1, 1}, 20, 20, MeshPattern::cross), 0.2, 8)),
      10.0, 0.1};
  const Built b(body);
  const int threads = omp_get_max_threads();
  omp_set_num_threads(1);
  const HighestFrequency one = highest_frequency(b.state, b.bulk, b.cohesive.get());
  omp_set_num_threads(2);
  const HighestFrequency two = highest_frequency(b.state, b.bulk, b.cohesive.get());
  omp_set_num_threads(threads);
  EXPECT_EQ(one.frequency, two.frequency);
  EXPECT_EQ(one.viscous_rate, two.viscous_rate);
}

TEST(Lanczos, NothingThatMovesHasNoFrequency) {
  const Body body{
      "held", std::make_shared<const Mesh>(structured_rectangle({0, 0}, {1, 1}, 1, 1, MeshPattern::right)),
      0.0};
  Built b(body);
  fix_nodes(b.state, EdgeKind::outer);
  const HighestFrequency found = highest_frequency(b.state, b.bulk, nullptr);
  EXPECT_EQ(found.frequency, 0.0);
  EXPECT_EQ(found.stable_step(), std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace crackle
