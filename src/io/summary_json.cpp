// SPDX-License-Identifier: GPL-3.0-or-later
#include "summary_json.hpp"

#include "json_text.hpp"

namespace crackle {

std::string summary_json(const RunSummary& summary) {
  JsonObject json;
  json.add("breakdown_pressure_Pa", summary.breakdown_pressure);
  json.add("breakdown_time_s", summary.breakdown_time);
  json.add("propagation_pressure_Pa", summary.propagation_pressure);
  json.add("final_pressure_Pa", summary.final_pressure);
  json.add("broken_length_m", summary.broken_length);
  json.add("extent_x_m", summary.extent_x);
  json.add("extent_y_m", summary.extent_y);
  json.add("energy_residual_max", summary.energy_residual_max);
  json.add("energy_inserted_J_m", summary.energy_inserted);
  json.add("energy_path_J_m", summary.energy_path);
  json.add("mass_residual_max", summary.mass_residual_max);
  json.add("triangles", summary.triangles);
  json.add("steps", summary.steps);
  json.add("wall_s", summary.wall);
  json.add("core_ns_per_triangle_step", summary.core_ns_per_triangle_step);
  json.add("events", summary.events);
  json.add("magnitude_min", summary.magnitude_min);
  json.add("magnitude_max", summary.magnitude_max);
  json.add("alarms", summary.alarms);
  json.add("unstable_allowed", summary.unstable_allowed);
  json.add("exit", summary.exit);
  return json.text();
}

}  // namespace crackle
