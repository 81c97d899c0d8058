// SPDX-License-Identifier: GPL-3.0-or-later
#include "summary_json.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string_view>

namespace crackle {

namespace {

/// JSON has neither NaN nor infinity.
std::string json(double value) { return std::isfinite(value) ? fmt::format("{}", value) : "null"; }
std::string json(std::int64_t value) { return fmt::format("{}", value); }

/// Quoted and escaped (RFC 8259, section 7).
std::string json(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      quoted += '\\';
      quoted += c;
    } else if (c == '\n') {
      quoted += "\\n";
    } else if (static_cast<unsigned char>(c) < 0x20) {
      quoted += fmt::format("\\u{:04x}", static_cast<unsigned>(static_cast<unsigned char>(c)));
    } else {
      quoted += c;
    }
  }
  return quoted + '"';
}

}  // namespace

std::string summary_json(const RunSummary& summary) {
  std::string text;
  const auto add = [&text](std::string_view key, const auto& value) {
    text += fmt::format("{}  \"{}\": {}", text.empty() ? "{\n" : ",\n", key, json(value));
  };
  add("breakdown_pressure_Pa", summary.breakdown_pressure);
  add("breakdown_time_s", summary.breakdown_time);
  add("propagation_pressure_Pa", summary.propagation_pressure);
  add("broken_length_m", summary.broken_length);
  add("extent_x_m", summary.extent_x);
  add("extent_y_m", summary.extent_y);
  add("energy_residual_max", summary.energy_residual_max);
  add("triangles", summary.triangles);
  add("steps", summary.steps);
  add("wall_s", summary.wall);
  add("core_ns_per_triangle_step", summary.core_ns_per_triangle_step);
  add("events", summary.events);
  add("magnitude_min", summary.magnitude_min);
  add("magnitude_max", summary.magnitude_max);
  add("exit", summary.exit);
  return text + "\n}\n";
}

}  // namespace crackle
