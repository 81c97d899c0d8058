// SPDX-License-Identifier: GPL-3.0-or-later
#include "crackle/fluid/leak_off.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "../../acceptance.hpp"
#include "crackle/fluid/fracture_flow.hpp"
#include "crackle/fluid/well.hpp"

namespace crackle {
namespace {

const MatrixRock rock{2.35e-20, 0.05, 1.5e-8, 2e-5, 34.84e6};

// A face at constant pressure: V = 2 Δp √(k φ c_t t/(π μ)).
TEST(LeakOff, DiffusionAtConstantPressure) {
  const MatrixDiffusion diffusion(rock);
  const double rise = 9.44e6;
  std::vector<double> profile(diffusion.cells(), rock.reservoir_pressure);
  double time = 0.0, volume = 0.0, next = 10.0, worst = 0.0;
  while (time < 1e6) {
    const double dt = std::max(0.01, 0.02 * time);
    const auto r = diffusion.response(profile, dt);
    volume += r.slope * (rock.reservoir_pressure + rise) + r.constant;
    diffusion.advance(profile, dt, rock.reservoir_pressure + rise);
    time += dt;
    if (time < next) continue;
    next *= 10.0;
    const double exact =
        2.0 * rise *
        std::sqrt(rock.permeability * rock.porosity * rock.compressibility * time / (M_PI * rock.viscosity));
    std::printf("diffusion, %8.0f s: volume %.4f of the exact; stored %.1e off\n", time, volume / exact,
                diffusion.stored(profile) / volume - 1.0);
    worst = std::max(worst, std::abs(volume / exact - 1.0));
    EXPECT_NEAR(volume / exact, 1.0, 0.01);
    EXPECT_NEAR(diffusion.stored(profile) / volume, 1.0, 1e-10);
  }
  accept(10, "diffusion from a face at constant pressure, 10 to 1e6 s: volume", "1 %",
         text("%.2f %%", 100.0 * worst), worst <= 0.01);
}

TEST(LeakOff, CarterIsExactOverAStepAndStopsAtTheReservoir) {
  const CarterLeakOff carter{5e-6, 10e6, 2e6};
  EXPECT_NEAR(carter.volume(0.0, 4.0, 20e6).value, 2.0 * 5e-6 * 2.0, 1e-18);
  const double first = carter.volume(0.0, 1.0, 20e6).value;
  EXPECT_NEAR(first + carter.volume(first, 3.0, 20e6).value, carter.volume(0.0, 4.0, 20e6).value, 1e-18);
  // Half a face leaks half as much, and what a starved one has not leaked it leaks later.
  EXPECT_NEAR(carter.volume(0.0, 4.0, 20e6, 0.5).value, 5e-6 * 2.0, 1e-18);
  const double starved = carter.volume(0.0, 1.0, 11e6).value;
  EXPECT_NEAR(starved, 0.5 * first, 1e-18);
  EXPECT_GT(carter.volume(starved, 3.0, 20e6).value, carter.volume(first, 3.0, 20e6).value);
  EXPECT_EQ(carter.volume(0.0, 4.0, 9e6).value, 0.0);
  EXPECT_NEAR(carter.volume(0.0, 4.0, 11e6).value, 5e-6 * 2.0, 1e-18);
}

// Slopes against differences.
TEST(FractureFluid, Slopes) {
  const FractureFluid fluid{.reference_pressure = 1e7, .cavitation_pressure = 0.0};
  for (const double p : {2e7, 1e6, -1e6, -5e6}) {
    const double step = 10.0;
    const double slope = (fluid.density(p + step).value - fluid.density(p - step).value) / (2.0 * step);
    EXPECT_NEAR(fluid.density(p).slope / slope, 1.0, 1e-4) << p;
  }
  EXPECT_NEAR(fluid.density(-1e-3).value, fluid.density(1e-3).value, 1e-8);
  const double w = 1e-4;
  EXPECT_NEAR(fluid.conductivity(w).value, w * w * w / 12e-3, 1e-22);
  EXPECT_EQ(fluid.conductivity(1e-9).value, fluid.conductivity(fluid.smallest_aperture).value);
  Well well;
  well.impedance = 2e10;
  well.impedance_time = 5.0;
  well.perforation = 1e12;
  well.tortuosity = 1e8;
  for (const double q : {1e-3, -1e-4}) {
    const double step = 1e-9;
    const double slope = (well.loss(q + step, 1.0).value - well.loss(q - step, 1.0).value) / (2.0 * step);
    EXPECT_NEAR(well.loss(q, 1.0).slope / slope, 1.0, 1e-5) << q;
  }
  EXPECT_GT(well.loss(1e-3, 1.0).value, well.loss(1e-3, 6.0).value + 1e7);
}

}  // namespace
}  // namespace crackle
