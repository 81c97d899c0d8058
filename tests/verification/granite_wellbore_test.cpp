// SPDX-License-Identifier: GPL-3.0-or-later
//
// The granite wellbore cases in full (3 mm) by the paper's method, by the program itself, from what it
// writes: breakdown beside the quasi-static cohesive reference with the penalty's compliance (validation.md
// D4).
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>
#include <vector>

namespace {

namespace fs = std::filesystem;

struct RunResult {
  std::string summary;
  std::vector<double> magnitudes;

  double operator[](const std::string& key) const {
    const std::size_t where = summary.find('"' + key + '"');
    if (where == std::string::npos) throw std::runtime_error("summary.json has no " + key);
    return std::stod(summary.substr(summary.find(':', where) + 1));
  }
  double share_of_magnitudes(double low, double high) const {
    const auto inside =
        std::count_if(magnitudes.begin(), magnitudes.end(), [&](double m) { return m >= low && m <= high; });
    return static_cast<double>(inside) / static_cast<double>(magnitudes.size());
  }
};

RunResult run(const std::string& name) {
  const fs::path folder =
      fs::temp_directory_path() / ("crackle_" + name + "_" + std::to_string(std::random_device{}()));
  const std::string command = std::string("'") + CRACKLE_BINARY + "' run '" + CRACKLE_SOURCE_DIR +
                              "/cases/granite_wellbore/" + name + ".toml' -o '" + folder.string() +
                              "'  > /dev/null";
  const int status = std::system(command.c_str());
  EXPECT_EQ(status, 0) << command;
  RunResult result;
  std::stringstream text;
  text << std::ifstream(folder / "summary.json").rdbuf();
  result.summary = text.str();
  std::ifstream events(folder / "events.csv");
  std::string line, cell;
  std::getline(events, line);
  std::stringstream header(line);
  int column = 0;
  while (std::getline(header, cell, ',') && cell != "magnitude") ++column;
  while (std::getline(events, line)) {
    std::stringstream row(line);
    for (int i = 0; i <= column; ++i) std::getline(row, cell, ',');
    result.magnitudes.push_back(std::stod(cell));
  }
  fs::remove_all(folder);
  return result;
}

void print(const char* name, const RunResult& r, double reference) {
  std::printf(
      "%s: breakdown %.2f MPa (%+.1f %% of %.2f) at %.3f ms, propagation %.2f MPa, %.2f x %.2f m, %zu "
      "events, %.0f %% of "
      "M in -6 .. -3.5, residual %.1e, %.0f s\n",
      name, r["breakdown_pressure_Pa"] / 1e6, 100 * (r["breakdown_pressure_Pa"] / reference - 1.0),
      reference / 1e6, r["breakdown_time_s"] * 1e3, r["propagation_pressure_Pa"] / 1e6, r["extent_x_m"],
      r["extent_y_m"], r.magnitudes.size(), 100 * r.share_of_magnitudes(-6.0, -3.5), r["energy_residual_max"],
      r["wall_s"]);
}

void expect_common(const RunResult& r, double reference) {
  EXPECT_GT(r["breakdown_pressure_Pa"], 0.97 * reference);
  EXPECT_LT(r["breakdown_pressure_Pa"], 1.09 * reference);
  EXPECT_LT(r["propagation_pressure_Pa"], 0.8 * r["breakdown_pressure_Pa"]);
  EXPECT_LT(r["energy_residual_max"], 1e-3);
  EXPECT_EQ(static_cast<std::size_t>(r["events"]), r.magnitudes.size());
  EXPECT_GT(r.share_of_magnitudes(-6.0, -3.5), 0.5);
}

TEST(GraniteWellbore, Anisotropic) {
  const RunResult r = run("anisotropic_y_geo");
  print("anisotropic", r, 12.01e6);
  expect_common(r, 12.01e6);
  EXPECT_GT(r["breakdown_time_s"], 1.0e-3);
  EXPECT_LT(r["breakdown_time_s"], 1.25e-3);
  EXPECT_GT(r["propagation_pressure_Pa"], 4e6);
  EXPECT_LT(r["propagation_pressure_Pa"], 8e6);
  EXPECT_GT(r["extent_x_m"], 2.0 * r["extent_y_m"]) << "along the larger stress";
}

TEST(GraniteWellbore, Isotropic) {
  const RunResult r = run("isotropic_y_geo");
  print("isotropic", r, 13.56e6);
  expect_common(r, 13.56e6);
  EXPECT_GT(r["propagation_pressure_Pa"], 4e6);
  EXPECT_LT(r["propagation_pressure_Pa"], 9e6);
}

}  // namespace
