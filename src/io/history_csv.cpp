// SPDX-License-Identifier: GPL-3.0-or-later
#include "history_csv.hpp"

#include <fmt/format.h>

namespace crackle {

std::string history_header() {
  return "time_s,time_step_s,pressure_Pa,injection_rate_m2_s,injected_m2,cavity_volume_m2,wetted_length_m,"
         "broken_tensile,broken_shear,broken_mixed,"
         "energy_kinetic_J_m,energy_strain_J_m,energy_cohesive_J_m,energy_fracture_J_m,energy_friction_J_m,"
         "energy_viscous_J_m,energy_fluid_J_m,work_external_J_m,energy_residual\n";
}

std::string history_line(const HistoryRow& row) {
  return fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", row.time, row.time_step,
                     row.pressure, row.injection_rate, row.injected, row.cavity_volume, row.wetted_length,
                     row.broken_tensile, row.broken_shear, row.broken_mixed, row.energy_kinetic,
                     row.energy_strain, row.energy_cohesive, row.energy_fracture, row.energy_friction,
                     row.energy_viscous, row.energy_fluid, row.work_external, row.energy_residual);
}

}  // namespace crackle
