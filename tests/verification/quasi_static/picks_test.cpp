// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the analysis reads off the record of a simulated test, against the truth of the simulation.
#include <gtest/gtest.h>

#include <random>

#include "../../acceptance.hpp"
#include "dfit.hpp"

namespace crackle {
namespace {

PressureRecord with_noise(PressureRecord record, double deviation, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal(0.0, deviation);
  for (double& p : record.pressure) p += normal(random);
  return record;
}

TEST(DfitPicks, Reference) {
  QuasiStatic stage(dfit::scene(0.5, 60.0));
  const PressureRecord record = dfit::run(stage, dfit::shut_in + 1e6);
  const DfitAnalysis a = dfit::analysed(record);
  const struct {
    const char *name, *gate;
    double scale, value, bound;
  } gates[] = {{"isip", "44.50 +- 0.03 MPa", 1e-6, 44.50, 0.03},
               {"contact_compliance", "44.35 +- 0.03 MPa", 1e-6, 44.35, 0.03},
               {"closure_tangent", "42.4 +- 0.4 MPa", 1e-6, 42.4, 0.4},
               {"leak_off_coefficient", "5.1e-6 m/s^0.5 +- 8 %", 1e6, 5.1, 0.08 * 5.1},
               {"reservoir_pressure", "34.84 +- 0.05 MPa", 1e-6, 34.84, 0.05}};
  for (const auto& g : gates) {
    const double got = g.scale * dfit::value(a, g.name);
    const bool within = std::abs(got - g.value) <= g.bound;
    accept(11, std::string("DFIT, pick: ") + g.name, g.gate, text("%.3f", got), within);
    EXPECT_TRUE(within) << g.name << " " << got;
  }
  const double slope = a.after_closure.loglog_slope;
  accept(11, "DFIT, logarithmic derivative from 3e5 to 1e6 s: slope", "-0.50 to -0.53", text("%.3f", slope),
         slope <= -0.50 && slope >= -0.53);
  EXPECT_NEAR(slope, -0.515, 0.015);

  const double contact = dfit::value(a, "contact_compliance");
  const struct { double noise, bound; } noises[] = {{1e3, 5e3}, {5e3, 60e3}};
  for (const auto& n : noises) {
    double worst = 0.0;
    for (std::uint32_t seed = 1; seed <= 20; ++seed) {
      const double got = dfit::value(dfit::analysed(with_noise(record, n.noise, seed)), "contact_compliance");
      worst = std::max(worst, std::isnan(got) ? 1e9 : std::abs(got - contact));
    }
    accept(14, text("noise of %.0f kPa: contact, worst of 20", 1e-3 * n.noise),
           text("+- %.0f kPa", 1e-3 * n.bound), text("%.1f kPa", 1e-3 * worst), worst <= n.bound);
    EXPECT_LE(worst, n.bound);
  }
}

TEST(DfitPicks, ResidualAperture) {
  std::vector<double> contact, tangent;
  for (const double w0 : {30e-6, 100e-6, 300e-6}) {
    QuasiStaticScene s = dfit::scene(0.5, 60.0);
    s.closure.residual_aperture = w0;
    const DfitAnalysis a = dfit::picks_of(s);
    contact.push_back(1e-6 * dfit::value(a, "contact_compliance"));
    tangent.push_back(1e-6 * dfit::value(a, "closure_tangent"));
  }
  const double published[] = {44.327, 44.347, 44.395};
  const bool rises = contact[0] < contact[1] && contact[1] < contact[2];
  double off = 0.0;
  for (std::size_t i = 0; i < 3; ++i) off = std::max(off, std::abs(contact[i] - published[i]));
  accept(13, "residual aperture of 30, 100, 300 um: contact", "rises, 44.33 to 44.40 MPa (30 kPa)",
         text("%.3f, %.3f, %.3f (tangent %.2f, %.2f, %.2f)", contact[0], contact[1], contact[2], tangent[0],
              tangent[1], tangent[2]),
         rises && off <= 0.03);
  EXPECT_TRUE(rises);
  EXPECT_LE(off, 0.04);
}

}  // namespace
}  // namespace crackle
