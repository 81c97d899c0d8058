// SPDX-License-Identifier: GPL-3.0-or-later
#include "history_csv.hpp"

#include <fmt/format.h>

namespace crackle {

std::string history_header(const std::vector<std::string>& loads) {
  std::string header =
      "time_s,time_step_s,pressure_Pa,injection_rate_m2_s,injected_m2,cavity_volume_m2,wetted_length_m,"
      "broken_tensile,broken_shear,broken_mixed,"
      "energy_kinetic_J_m,energy_strain_J_m,energy_cohesive_J_m,energy_fracture_J_m,energy_friction_J_m,"
      "energy_viscous_J_m,energy_fluid_J_m,work_external_J_m,energy_inserted_J_m,energy_path_J_m,energy_"
      "residual";
  for (const std::string& load : loads) {
    header += fmt::format(",{0}_force_x_N_m,{0}_force_y_N_m,{0}_displacement_x_m,{0}_displacement_y_m", load);
  }
  return header + '\n';
}

std::string history_line(const HistoryRow& row) {
  std::string line = fmt::format(
      "{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}", row.time, row.time_step, row.pressure,
      row.injection_rate, row.injected, row.cavity_volume, row.wetted_length, row.broken_tensile,
      row.broken_shear, row.broken_mixed, row.energy_kinetic, row.energy_strain, row.energy_cohesive,
      row.energy_fracture, row.energy_friction, row.energy_viscous, row.energy_fluid, row.work_external,
      row.energy_inserted, row.energy_path, row.energy_residual);
  for (const LoadRow& load : row.loads) {
    line += fmt::format(",{},{},{},{}", load.force.x, load.force.y, load.displacement.x, load.displacement.y);
  }
  return line + '\n';
}

std::string field_time_header() {
  return "time_s,time_step_s,pressure_Pa,rate_m3_s,perforation_rate_m2_s,fracture_pressure_Pa,"
         "least_pressure_Pa,injected_m2,well_stored_m2,fracture_volume_m2,leaked_m2,mass_defect_m2,"
         "broken_length_m,damaged_length_m,half_length_m,opening_m,mean_opening_m,contact_fraction,"
         "closure_stress_Pa,"
         "work_pump_J_m,energy_well_J_m,energy_entry_J_m,energy_viscous_J_m,energy_leaked_J_m,"
         "energy_fluid_J_m,energy_strain_J_m,energy_confinement_J_m,energy_faces_J_m,energy_fracture_J_m,"
         "energy_friction_J_m,energy_radiated_J_m,energy_residual,iterations\n";
}

std::string field_time_line(const FieldTimeRow& r) {
  return fmt::format(
      "{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n",
      r.time, r.time_step, r.pressure, r.rate, r.perforation_rate, r.fracture_pressure, r.least_pressure,
      r.injected, r.well_stored, r.fracture_volume, r.leaked, r.mass_defect, r.broken_length,
      r.damaged_length, r.half_length, r.opening, r.mean_opening, r.contact_fraction, r.closure_stress,
      r.work_pump, r.energy_well, r.energy_entry, r.energy_viscous, r.energy_leaked, r.energy_fluid,
      r.energy_strain, r.energy_confinement, r.energy_faces, r.energy_fracture, r.energy_friction,
      r.energy_radiated, r.energy_residual, r.iterations);
}

}  // namespace crackle
