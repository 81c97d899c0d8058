// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <limits>

#include "crackle/io/dfit.hpp"
#include "file.hpp"
#include "json_text.hpp"

namespace crackle {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

std::string picks_json(const std::vector<Pick>& picks) {
  std::string text;
  for (const Pick& pick : picks) {
    JsonObject object;
    object.add("name", pick.name);
    object.add("method", pick.method);
    if (pick.text.empty()) {
      object.add("value", pick.value.value_or(nan));
    } else {
      object.add("value", pick.text);
    }
    object.add("unit", pick.unit);
    object.add("time_s", pick.time.value_or(nan));
    object.add("uncertainty", pick.uncertainty.value_or(nan));
    std::string member = object.text();
    member.pop_back();
    text += (text.empty() ? "" : ",\n") + member;
  }
  return "[\n" + text + "\n]\n";
}

std::string geometry_name(Geometry geometry) {
  switch (geometry) {
    case Geometry::kgd:
      return "kgd";
    case Geometry::pkn:
      return "pkn";
    case Geometry::radial:
      return "radial";
  }
  return {};
}

void add_inputs(const DfitInputs& in, JsonObject& object) {
  object.add("young_modulus_Pa", in.young_modulus.value_or(nan));
  object.add("poisson_ratio", in.poisson_ratio.value_or(nan));
  object.add("geometry", geometry_name(in.geometry));
  object.add("height_m", in.height.value_or(nan));
  object.add("half_length_m", in.half_length.value_or(nan));
  object.add("fracture_stiffness_Pa_m", in.fracture_stiffness.value_or(nan));
  object.add("well_storage_m3_Pa", in.well_storage.value_or(nan));
  object.add("porosity", in.porosity.value_or(nan));
  object.add("total_compressibility_1_Pa", in.total_compressibility.value_or(nan));
  object.add("viscosity_Pa_s", in.viscosity.value_or(nan));
  object.add("given_reservoir_pressure_Pa", in.reservoir_pressure.value_or(nan));
}

std::string analysis_json(const PressureRecord& record, const DfitAnalysis& a) {
  using Flow = AfterClosure::Flow;
  const FallOff& f = a.fall_off;
  JsonObject object;
  object.add("record", record.source);
  object.add("pump_start_s", a.injection.start);
  object.add("shut_in_s", a.injection.shut_in);
  object.add("injected_m3", a.injection.volume);
  object.add("injected_earlier_m3", a.injection.earlier_volume);
  object.add("last_rate_m3_s", a.injection.rate);
  object.add("largest_pressure_Pa", a.injection.breakdown_pressure);
  object.add("largest_pressure_s", a.injection.breakdown_time);
  object.add("last_pumping_pressure_Pa", a.injection.shut_in_pressure);
  object.add("pump_time_s", f.pump_time);
  object.add("alpha", f.alpha);
  object.add("noise_Pa", f.noise);
  object.add("window_decades", f.window);
  object.add("derivative_noise_share", f.noise_share);
  const auto& contact = a.pick("contact_compliance").value;
  constexpr double offset = 75.0 * 6894.757293168;  // 75 psi: McClure et al. (2019)
  object.add("contact_less_75_psi_Pa", contact ? *contact - offset : nan);
  object.add("after_closure_flow", std::string(a.after_closure.flow == Flow::linear   ? "linear"
                                               : a.after_closure.flow == Flow::radial ? "radial"
                                                                                      : "none"));
  object.add("after_closure_loglog_slope", a.after_closure.loglog_slope);
  object.add("after_closure_slope", a.after_closure.flow == Flow::none ? nan : a.after_closure.slope);
  object.add("after_closure_from_s", a.after_closure.flow == Flow::none ? nan : a.after_closure.from);
  add_inputs(a.inputs, object);
  return object.text();
}

/// The row of the record that a bin of the fall-off starts nearest to.
std::size_t row_at(const PressureRecord& record, const FallOff& f, std::size_t i) {
  const auto at =
      std::lower_bound(record.time.begin(), record.time.end(), f.shut_in + f.elapsed[i] * (1.0 - 1e-12));
  return std::min(static_cast<std::size_t>(at - record.time.begin()), record.time.size() - 1);
}

std::string fall_off_csv(const PressureRecord& record, const DfitAnalysis& a) {
  const FallOff& f = a.fall_off;
  const double isip = a.pick("isip").value.value_or(nan);
  std::string text =
      "time_s,elapsed_s,pressure_Pa,samples,G,fall_per_G_Pa,fall_per_G_error_Pa,G_fall_per_G_Pa,sqrt_elapsed_"
      "s05,"
      "fall_per_sqrt_Pa_s05,sqrt_fall_per_sqrt_Pa,below_isip_Pa,fall_per_log_Pa,fall_per_log_error_Pa,"
      "inverse_sqrt_elapsed_1_s05,inverse_elapsed_1_s";
  for (const auto& [name, values] : record.truth) text += "," + name;
  text += '\n';
  const auto out = std::back_inserter(text);
  for (std::size_t i = 0; i < f.size(); ++i) {
    fmt::format_to(out, "{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}", f.shut_in + f.elapsed[i],
                   f.elapsed[i], f.pressure[i], f.count[i], f.g[i], f.by_g.value[i], f.by_g.error[i],
                   f.g[i] * f.by_g.value[i], f.root[i], f.by_root.value[i], f.root[i] * f.by_root.value[i],
                   isip - f.pressure[i], f.by_log.value[i], f.by_log.error[i], 1.0 / f.root[i],
                   1.0 / f.elapsed[i]);
    for (const auto& [name, values] : record.truth) fmt::format_to(out, ",{}", values[row_at(record, f, i)]);
    text += '\n';
  }
  return text;
}

std::string record_csv(const PressureRecord& record) {
  std::string text = record.per_metre ? "time_s,pressure_Pa,rate_m2_s\n" : "time_s,pressure_Pa,rate_m3_s\n";
  const auto out = std::back_inserter(text);
  for (std::size_t i = 0; i < record.time.size(); ++i) {
    fmt::format_to(out, "{},{},{}\n", record.time[i], record.pressure[i], record.rate[i]);
  }
  return text;
}

}  // namespace

void write_dfit(const std::string& folder, const PressureRecord& record, const DfitAnalysis& analysis) {
  namespace fs = std::filesystem;
  std::error_code reason;
  fs::create_directories(folder, reason);
  std::error_code ignored;
  if (!fs::is_directory(folder, ignored)) {
    throw CaseError(folder + ": cannot create the output folder" + (reason ? ": " + reason.message() : "") +
                    "; give another folder with -o DIR");
  }
  const auto file = [&](const char* name) { return (fs::path(folder) / name).string(); };
  write_whole_file(file("record.csv"), record_csv(record));
  write_whole_file(file("fall_off.csv"), fall_off_csv(record, analysis));
  write_whole_file(file("analysis.json"), analysis_json(record, analysis));
  write_whole_file(file("picks.json"), picks_json(analysis.picks));
}

}  // namespace crackle
