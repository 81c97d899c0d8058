// SPDX-License-Identifier: GPL-3.0-or-later
//
// Breakdown of the anisotropic wellbore with elements on demand and linear softening, pumped at a tenth of
// the paper's rate, against the quasi-static cohesive reference for a straight path (validation.md D4), over
// meshes.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <numeric>
#include <random>
#include <sstream>
#include <vector>

#include "../result.hpp"

namespace crackle {
namespace {

namespace fs = std::filesystem;

constexpr double reference = 12.45e6;  // [Pa]

// By the program, from what it writes [Pa].
double breakdown_pressure(const std::string& size, const std::string& fine_radius, int seed) {
  const fs::path folder =
      fs::temp_directory_path() / ("crackle_breakdown_" + std::to_string(std::random_device{}()));
  const std::string command = std::string("'") + CRACKLE_BINARY + "' run '" + CRACKLE_SOURCE_DIR +
                              "/cases/accuracy_speed/breakdown.toml' -o '" + folder.string() +
                              "' -q -j 1 --seed " + std::to_string(seed) +
                              " --set cohesive.law=linear --set 'fluid.pump.0.rate=6.5 l/s' --set "
                              "fluid.pump.0.to=1 --set 'run.end_time=12.3 ms'" +
                              " --set 'mesh.size_fine=" + size + "' --set 'mesh.fine_radius=" + fine_radius +
                              "'";
  const int status = std::system(command.c_str());
  EXPECT_EQ(status, 0) << command;
  std::stringstream text;
  text << std::ifstream(folder / "summary.json").rdbuf();
  fs::remove_all(folder);
  const std::string summary = text.str(), key = "\"breakdown_pressure_Pa\":";
  return std::stod(summary.substr(summary.find(key) + key.size()));
}

// Mean over seeds, as an error.
double mean_error(const char* size, const char* fine_radius) {
  const Check check(std::string("D4 breakdown, slow pump, five meshes of ") + size + ": mean");
  std::vector<double> errors;
  for (int seed = 1; seed <= 5; ++seed) {
    errors.push_back(breakdown_pressure(size, fine_radius, seed) / reference - 1.0);
    std::printf("%s, seed %d: %.2f MPa (%+.2f %%)\n", size, seed, 1e-6 * reference * (1.0 + errors.back()),
                100 * errors.back());
  }
  const double mean = std::accumulate(errors.begin(), errors.end(), 0.0) / 5.0;
  double spread = 0.0;
  for (const double e : errors) spread += (e - mean) * (e - mean) / 4.0;
  std::printf("%s: mean %+.2f %%, standard deviation %.2f %%\n", size, 100 * mean, 100 * std::sqrt(spread));
  check.result(mean);
  return mean;
}

TEST(Breakdown, OfFiveMeshesOfThreeMillimetres) { EXPECT_LT(std::abs(mean_error("3 mm", "0.12 m")), 0.04); }

TEST(Breakdown, OfFiveMeshesOfHalfThat) { EXPECT_LT(std::abs(mean_error("1.5 mm", "0.08 m")), 0.02); }

}  // namespace
}  // namespace crackle
