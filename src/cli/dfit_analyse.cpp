// SPDX-License-Identifier: GPL-3.0-or-later
//
// `crackle dfit-analyse`: picks of a fall-off, from a field record or from a run.
#include <fmt/format.h>

#include <filesystem>

#include "commands.hpp"
#include "crackle/core/errors.hpp"
#include "crackle/io/dfit.hpp"
#include "load.hpp"

namespace crackle {
namespace {

namespace fs = std::filesystem;

bool is_folder(const std::string& path) {
  std::error_code ignored;
  return fs::is_directory(path, ignored);
}

std::string output_folder(const DfitOptions& options) {
  if (!options.output.empty()) return options.output;
  const fs::path record(options.record);
  if (is_folder(options.record)) return (record / "dfit").string();
  return record.stem().string() + "_dfit";
}

/// What a run knows of its rock and well.
DfitSetup known_of(const DfitOptions& options, const PressureRecord& record) {
  DfitSetup known;
  if (record.per_metre) known.inputs.height = 1.0;
  const fs::path resolved = fs::path(options.record) / "resolved.toml";
  if (is_folder(options.record) && fs::exists(resolved)) {
    const Case scene = load_case(resolved.string(), {}, {});
    known.inputs.young_modulus = scene.rock.young_modulus;
    known.inputs.poisson_ratio = scene.rock.poisson_ratio;
    if (!record.per_metre) {
      known.inputs.height = scene.well.height;
      known.inputs.well_storage = scene.well.storage;
    }
    if (scene.fluid.leak_off == "diffusion") {
      known.inputs.porosity = scene.rock.porosity;
      known.inputs.total_compressibility = scene.rock.pore_compressibility;
      known.inputs.viscosity = scene.rock.pore_viscosity;
    }
  }
  return known;
}

std::string shown_value(const Pick& pick) {
  if (!pick.found()) return "none";
  if (!pick.value) return pick.text;
  if (pick.unit == "Pa") {
    return fmt::format("{:.3f} MPa +- {:.3f}", 1e-6 * *pick.value, 1e-6 * pick.uncertainty.value_or(0.0));
  }
  return fmt::format("{:.4g} {}+- {:.2g}", *pick.value, pick.unit == "1" ? "" : pick.unit + " ",
                     pick.uncertainty.value_or(0.0));
}

void print_summary(const PressureRecord& record, const DfitAnalysis& a, const std::string& folder) {
  const FallOff& f = a.fall_off;
  fmt::print("{}: shut-in at {:.6g} s, {:.4g} {} injected, t_p = {:.6g} s, fall-off of {:.4g} h\n",
             record.source, f.shut_in, a.injection.volume, record.per_metre ? "m3 a metre" : "m3",
             f.pump_time, f.elapsed.back() / 3600.0);
  fmt::print(
      "derivatives over {:g} decades of time: noise of {:.3g} Pa makes {:.2g} % of the median slope\n\n",
      f.window, f.noise, 100.0 * f.noise_share);
  for (const Pick& pick : a.picks) {
    const std::string time = pick.time ? fmt::format("{:.6g} s", *pick.time) : "";
    fmt::print("{:<22}{:<30}{:<14}{}\n", pick.name, shown_value(pick), time, pick.method);
  }
  fmt::print(
      "\n{0}: picks.json, analysis.json, fall_off.csv, record.csv; figures: scripts/plots/draw_dfit.py {0}\n",
      folder);
}

}  // namespace

int dfit_analyse_command(const DfitOptions& options) {
  const PressureRecord record =
      read_pressure_record(options.record, {options.time, options.pressure, options.rate});
  check_record(record);
  const DfitSetup setup = read_dfit_setup(options.inputs, options.overrides, known_of(options, record));
  const DfitAnalysis analysis = analyse_dfit(record, setup.settings, setup.inputs);
  const std::string folder = output_folder(options);
  write_dfit(folder, record, analysis);
  print_summary(record, analysis, folder);
  return 0;
}

}  // namespace crackle
