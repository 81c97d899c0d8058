// SPDX-License-Identifier: GPL-3.0-or-later
//
// Plates with notches in smeared damage: a centre slot pulled apart (T6), inclined smeared notches (T9), a
// slot under pressure (T8).
//   centre slot  K = σ √(πa) F, F = (1 − 0.025 α² + 0.06 α⁴) √sec(πα/2)
//   inclined     largest hoop stress (Erdogan and Sih 1963)
#include <gtest/gtest.h>

#include <numeric>

#include "../../acceptance.hpp"
#include "../../result.hpp"
#include "crackle/mesh/grid.hpp"
#include "scenes.hpp"

namespace crackle {
namespace {

using granite::at;
using namespace smeared;

constexpr double mm = 1e-3;

struct Peak {
  double stress = 0.0, dissipated = 0.0, residual = 0.0, wing = 0.0;
  Index failed = 0, damaged = 0;
};

// Mean direction of the failed triangles ahead of a notch's tips, within 8 mm: weighted by opening [rad].
double wing_direction(const State& state, Vec2 tip) {
  double xx = 0.0, xy = 0.0, yy = 0.0;
  for (const DamagedTriangle& d : state.damage.triangles) {
    const Vec2 c = granite::centroid(*state.mesh, d.triangle);
    for (const double side : {1.0, -1.0}) {
      const Vec2 r = c - side * tip;
      if (!d.failed || norm(r) > 8.0 * mm || dot(r, side * tip) < 0.0) continue;
      xx += d.opening * r.x * r.x;
      xy += d.opening * r.x * r.y;
      yy += d.opening * r.y * r.y;
    }
  }
  return 0.5 * std::atan2(2.0 * xy, xx - yy);
}

Peak pull_plate(Scene s, double width, double height, double ligament, Vec2 tip, double end) {
  strengthen_ends(s, 0.5 * height);
  Pull body(s, 0.5 * height, 0.03, 1e-4);
  const State& state = body.simulation.state();
  Peak peak;
  while (state.time < end && body.force / width > 0.3 * peak.stress - 1e4) {
    body.step();
    peak.stress = std::max(peak.stress, body.force / width);
  }
  peak.dissipated = state.dissipation.fracture / (5.0 * ligament);
  peak.residual = body.residual;
  peak.failed = failed(state);
  peak.damaged = static_cast<Index>(state.damage.triangles.size());
  peak.wing = wing_direction(state, tip) * 180.0 / std::numbers::pi;
  return peak;
}

void print(const std::string& what, const Peak& p, double reference) {
  std::printf("%-44s peak %.3f MPa (%+.1f %%), D/GL %.3f, wings %+.0f deg, %d failed of %d, ledger %.1e\n",
              what.c_str(), 1e-6 * p.stress, 100.0 * (p.stress / reference - 1.0), p.dissipated, p.wing,
              p.failed, p.damaged, p.residual);
  EXPECT_LT(p.residual, 1e-3) << what;
}

Mesh plate(double width, double height, int nx, int ny, const std::string& kind) {
  const Vec2 low{-0.5 * width, -0.5 * height}, high{0.5 * width, 0.5 * height};
  if (kind == "right") return structured_rectangle(low, high, nx, ny, MeshPattern::right);
  if (kind == "alternate") {
    std::vector<double> x, y;
    for (int i = 0; i <= nx; ++i) x.push_back(low.x + width * i / nx);
    for (int j = 0; j <= ny; ++j) y.push_back(low.y + height * j / ny);
    return grid_rectangle(x, y);
  }
  return jittered(structured_rectangle(low, high, nx, ny, MeshPattern::right), 0.28, 3);
}

/// A slot of 20 x 1 mm in triangles with legs of 1 mm, or a part of that; on a lattice, or with nodes moved
/// at random.
Peak pull_slotted_plate(int parts, bool moved, std::uint64_t seed = 3) {
  constexpr double width = 60 * mm, height = 101 * mm;
  Mesh mesh = without(plate(width, height, 60 * parts, 101 * parts, "right"),
                      [](Vec2 c) { return std::abs(c.y) < 0.5 * mm && std::abs(c.x) < 10 * mm; });
  if (moved) mesh = jittered(mesh, 0.28, seed);
  const Scene s = scene(granite::free_body(std::move(mesh)), rock(DamagePreset::recommended));
  return pull_plate(s, width, height, 40 * mm, {10 * mm, 0.0}, 0.9e-3);
}

constexpr double slot_strength = 2.286e6;  // by LEFM [Pa]

TEST(DamagedPlate, CentreSlotBreaksAtGriffithsStress) {
  const Check check("T6 damaged plate with a slot: peak stress");
  double worst = 0.0;
  bool within = true;
  for (const std::string kind : {"right", "jittered"}) {
    const Peak p = pull_slotted_plate(1, kind == "jittered");
    print("slot, " + kind, p, slot_strength);
    worst = std::max(worst, std::abs(p.stress / slot_strength - 1.0));
    EXPECT_GT(p.stress, 0.93 * slot_strength);
    EXPECT_LT(p.stress, 1.05 * slot_strength);
    EXPECT_GT(p.dissipated, 0.93);
    EXPECT_LT(p.dissipated, 1.06);
    within = within && p.stress > 0.93 * slot_strength && p.stress < 1.05 * slot_strength;
    accept("T6", "plate with a centre slot, " + kind + ": dissipated over G L", "0.93 to 1.06",
           text("%.3f", p.dissipated), p.dissipated > 0.93 && p.dissipated < 1.06);
  }
  check.result(worst);
  accept("T6", "plate with a centre slot, two meshes: peak against 2.286 MPa", "-7 to +5 %",
         text("%.1f %% at most", 100 * worst), within);
}

TEST(DamagedPlate, CentreSlotBreaksAlikeOnHalfTheMesh) {
  const Check check("T6 damaged plate with a slot: change of the peak from 1 mm to 0.5 mm");
  const auto change = [](bool moved, std::uint64_t seed, Peak& sum_coarse, Peak& sum_fine) {
    const Peak coarse = pull_slotted_plate(1, moved, seed), fine = pull_slotted_plate(2, moved, seed);
    const std::string mesh =
        moved ? text("slot, nodes moved, %d, ", static_cast<int>(seed)) : "slot, lattice, ";
    print(mesh + "1 mm", coarse, slot_strength);
    print(mesh + "0.5 mm", fine, slot_strength);
    sum_coarse.stress += coarse.stress;
    sum_fine.stress += fine.stress;
    return fine.stress / coarse.stress - 1.0;
  };
  Peak coarse, fine;
  const double lattice = change(false, 0, coarse, fine);
  coarse = fine = {};
  double worst = 0.0;
  for (const std::uint64_t seed : {3, 4, 5, 6})
    worst = std::max(worst, std::abs(change(true, seed, coarse, fine)));
  const double mean = fine.stress / coarse.stress - 1.0;
  check.result(std::max(std::abs(lattice), std::abs(mean)));
  EXPECT_LT(std::abs(lattice), 0.03);
  EXPECT_LT(std::abs(mean), 0.03);
  const std::string what = "plate with a centre slot: change of the peak from 1 mm to 0.5 mm, ";
  accept("T6", what + "lattice", "3 %", text("%+.1f %%", 100 * lattice), std::abs(lattice) <= 0.03);
  accept("T6", what + "mean of four meshes with nodes moved at random", "3 %", text("%+.1f %%", 100 * mean),
         std::abs(mean) <= 0.03);
  accept("T6", what + "single ones of these, which scatter", "none", text("%.1f %% at most", 100 * worst),
         true);
}

TEST(DamagedPlate, InclinedNotchNeedsAllStressDropped) {
  const Check check("T9 damaged plate with an inclined notch: peak stress");
  double worst = 0.0, locked = 0.0, residual = 0.0;
  for (const double degrees : {30.0, 45.0}) {  // from x; the load is along y
    const double reference = degrees == 30.0 ? 2.365e6 : 2.69e6;
    for (const std::string kind : {"right", "alternate", "jittered"}) {
      const auto mesh = granite::free_body(plate(100 * mm, 101 * mm, 100, 101, kind));
      const double angle = degrees * std::numbers::pi / 180.0;
      const Vec2 tip{10 * mm * std::cos(angle), 10 * mm * std::sin(angle)};
      for (const bool all : {true, false}) {
        DamageMaterial m = rock(DamagePreset::recommended);
        m.drop_all = all;
        Scene s = scene(mesh, m);
        s.damage.cut = notch(*mesh, 10 * mm, angle);
        const Peak p = pull_plate(s, 100 * mm, 101 * mm, 80 * mm, tip, 0.8e-3);
        print("notch at " + std::to_string(static_cast<int>(degrees)) + ", " + kind +
                  (all ? "" : ", stress along it kept"),
              p, reference);
        residual = std::max(residual, p.residual);
        if (all) worst = std::max(worst, std::abs(p.stress / reference - 1.0));
        // along the mesh's diagonals nothing has to zigzag
        if (!all && degrees == 45.0 && kind != "right") locked = std::max(locked, p.stress / reference - 1.0);
      }
    }
  }
  check.result(worst);
  accept("T9", "notch at 30 and 45 degrees, three meshes: peak against 2.365 and 2.69 MPa", "8 %",
         text("%.1f %% at most", 100 * worst), worst < 0.08);
  accept("T9", "the same with the stress along a failed crack kept, 45 degrees: it locks",
         "19 % or more on a mesh", text("%+.1f %%", 100 * locked), locked > 0.19);
  accept("T13", "energy residual, plates with notches", "1e-3", text("%.1e", residual), residual < 1e-3);
  EXPECT_LT(worst, 0.08);
  EXPECT_GT(locked, 0.19) << "documented: on some meshes it locks";
}

// Pressure, ramped, at which a slot has grown by 5 mm, over the reference less 1.
double slot_under_pressure(const std::string& kind, bool wets_damaged, double reference) {
  Mesh mesh = plate(100 * mm, 101 * mm, 100, 101, "right");
  mesh = without(mesh, [](Vec2 c) { return std::abs(c.y) < 0.5 * mm && std::abs(c.x) < 10 * mm; });
  if (kind != "right") mesh = jittered(mesh, 0.28, 3);
  const auto body = granite::with_free_sides(std::move(mesh), [](Vec2 x) { return norm(x) < 20 * mm; });
  Scene s = scene(body, rock(DamagePreset::recommended));
  s.fluid = CompressibleFluid{1e7, 1000.0, 0.0};
  s.wets_damaged = wets_damaged;
  Simulation simulation(s);
  State& state = simulation.state();
  set_mass(state, s.density);  // the outer boundary is free
  const double dt = 0.8 * simulation.stable().limit;
  double pressure = 0.0, grown = 0.0, first = 0.0;
  while (grown < 5 * mm && pressure < 5e6) {
    pressure = 4e6 * state.time / 0.9e-3;
    Cavity& cavity = state.fluid.cavities[0];
    cavity.pressure = pressure;
    cavity.mass = s.fluid->mass(simulation.fluid()->volume(0), pressure);
    simulation.step(dt);
    for (const SeismicEvent& e : simulation.new_events()) {
      if (first == 0.0) first = pressure;
      grown = std::max(grown, std::abs(e.place.x) - 10 * mm);
    }
  }
  std::printf("slot, %s: first failed at %.3f MPa, 5 mm grown at %.3f MPa (%+.1f %%), %d failed of %zu\n",
              kind.c_str(), 1e-6 * first, 1e-6 * pressure, 100.0 * (pressure / reference - 1.0),
              failed(state), state.damage.triangles.size());
  return pressure / reference - 1.0;
}

// Wet from failed triangle to failed triangle: the cohesive zone is dry.
TEST(DamagedPlate, SlotUnderPressureGrows) {
  const Check check("T8 damaged plate, slot under pressure: pressure at 5 mm of growth");
  double worst = 0.0;
  for (const std::string kind : {"right", "jittered"})
    worst = std::max(worst, std::abs(slot_under_pressure(kind, false, 3.04e6)));
  check.result(worst);
  accept("T8", "slot under pressure, wet when failed: pressure at 5 mm of growth against 3.04 MPa", "6 %",
         text("%.1f %% at most", 100 * worst), worst < 0.06);
  EXPECT_LT(worst, 0.06);
}

// The pressure acts up to the tip, the cohesive zone is wet: K = p √(πa) 1.02 = K_Ic.
TEST(DamagedPlate, SlotWithAWetTipGrowsAtGriffithsPressure) {
  const Check check(
      "T8 damaged plate, slot under pressure, fluid in damaged triangles: pressure at 5 mm of growth");
  double worst = 0.0;
  for (const std::string kind : {"right", "jittered"})
    worst = std::max(worst, std::abs(slot_under_pressure(kind, true, 2.40e6)));
  check.result(worst);
  accept("T8", "the same with the fluid in damaged triangles, up to the tip, against Griffith's 2.40 MPa",
         "6 %", text("%.1f %% at most", 100 * worst), worst < 0.06);
  EXPECT_LT(worst, 0.06);
}

}  // namespace
}  // namespace crackle
