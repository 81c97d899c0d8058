// SPDX-License-Identifier: GPL-3.0-or-later
// The reference DFIT: 1 m3/min for 240 s into a fracture 50 m high, 11.5 days of fall-off.
#pragma once

#include "crackle/analysis/picks.hpp"
#include "wing.hpp"

namespace crackle::dfit {

constexpr double height = 50.0, closure_stress = 44.28e6, reservoir = 34.84e6, shut_in = 240.0;
constexpr double rate = 1.0 / 60.0;  // [m3/s]

/// One wing, edges of `step` [m] to the end of a path [m]; fall-off to 1e6 s.
inline QuasiStaticScene scene(double step, double path) {
  QuasiStaticScene s = wing::scene(wing::mesh(step, path, 10.0 * path), path, 1.5);
  s.stiffness = isotropic_plane_strain(42.5e9, 0.17);
  s.pore_pressure = reservoir;
  s.stress = {0.0, reservoir - closure_stress, 0.0};
  s.cohesive.fracture_energy_mode1 = 100.0;
  s.cohesive.tensile_strength = 10.75e6;
  s.fluid.viscosity = 1e-3;
  s.fluid.cavitation_pressure = 30e6;
  s.fluid.reference_pressure = reservoir;
  MatrixRock rock{2.35e-20, 0.05, 1.5e-8, 2e-5, reservoir};
  rock.cells = diffusion_cells(rock, 1e6);
  s.leak_off = rock;
  s.well.storage = 1.35e-8 / (2.0 * height);
  s.well.breakdown_pressure = 76e6;
  s.well.impedance = 2e10;
  s.well.impedance_time = 8.0;
  s.pump = Pump({{0.0, shut_in, rate / (2.0 * height)}});
  return s;
}

/// Runs to `end` [s] and keeps the record that a gauge in the well would; the length comes along as truth.
inline PressureRecord run(QuasiStatic& stage, double end) {
  PressureRecord record;
  const auto note = [&](const QuasiStaticRow& row) {
    record.time.push_back(row.time);
    record.pressure.push_back(row.well_pressure);
    record.rate.push_back(2.0 * height * stage.scene().pump.rate(row.time));
    record.truth["half_length_m"].push_back(row.elastic_length);
  };
  note(stage.row());
  stage.run(end, note);
  return record;
}

inline DfitAnalysis analysed(const PressureRecord& record) {
  DfitSettings settings;
  settings.since_breakdown = true;
  DfitInputs inputs;
  inputs.young_modulus = 42.5e9;
  inputs.poisson_ratio = 0.17;
  inputs.height = height;
  inputs.well_storage = 1.35e-8;
  return analyse_dfit(record, settings, inputs);
}

inline DfitAnalysis picks_of(const QuasiStaticScene& scene) {
  QuasiStatic stage(scene);
  return analysed(run(stage, shut_in + 1e6));
}

inline double value(const DfitAnalysis& a, const std::string& name) {
  return a.pick(name).value.value_or(std::nan(""));
}

}  // namespace crackle::dfit
