// SPDX-License-Identifier: GPL-3.0-or-later
//
// A million steps of rock that rings and never breaks, with cohesive elements on all edges and no damping:
// its energy, its memory, and the time a step takes, at the end against the beginning.
#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

#include "process.hpp"

namespace crackle_test {
namespace {

// What a run holds and has used when it has written a thousandth of its rows, two, ...
struct Sample {
  int rows = 0;
  double memory = 0.0, processor_time = 0.0;
};

int lines_of(const std::string& file) {
  const std::string text = read_text(file);
  return static_cast<int>(std::count(text.begin(), text.end(), '\n'));
}

// Columns of history.csv by name.
std::map<std::string, std::vector<double>> table(const std::string& file) {
  std::ifstream stream(file);
  std::string line, cell;
  std::vector<std::string> names;
  std::getline(stream, line);
  for (std::istringstream cells(line); std::getline(cells, cell, ',');) names.push_back(cell);
  std::map<std::string, std::vector<double>> columns;
  while (std::getline(stream, line)) {
    std::istringstream cells(line);
    for (const std::string& name : names) {
      std::getline(cells, cell, ',');
      columns[name].push_back(std::stod(cell));
    }
  }
  return columns;
}

double mean(const std::vector<double>& values, std::size_t first, std::size_t last) {
  double sum = 0.0;
  for (std::size_t i = first; i < last; ++i) sum += values[i];
  return sum / static_cast<double>(last - first);
}

using LongRun = CliTest;

TEST_F(LongRun, AMillionStepsOfElasticRock) {
  write("case.toml", good_case);
  std::vector<std::string> arguments{"run", path("case.toml"), "-q", "-j", "1", "-o", path("out")};
  for (const char* setting :
       {"mesh.size_fine=30 mm", "mesh.size_coarse=0.2 m", "rock.tensile_strength=1e12", "rock.cohesion=1e12",
        "damping.ratio=0", "run.time_step=0.5 us", "run.end_time=0.5 s", "fluid.pump.0.to=0.5 ms",
        "output.checkpoint_every=0.5 s"})
    arguments.insert(arguments.end(), {"--set", setting});
  Process process(arguments, path("process"));
  std::vector<Sample> samples;
  while (!process.has_ended()) {
    usleep(20000);
    const Sample now{lines_of(path("out/history.csv")) - 1, process.resident_bytes(),
                     process.processor_time()};
    if (now.rows > (samples.empty() ? 0 : samples.back().rows) && now.memory > 0.0) samples.push_back(now);
  }
  const Outcome outcome = process.wait();
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(read_text(path("out/summary.json")).find("\"steps\": 1000000,"), std::string::npos);
  ASSERT_GT(samples.size(), 20u);

  const auto at = [&](int rows) {
    return *std::find_if(samples.begin(), samples.end() - 1, [&](const Sample& s) { return s.rows >= rows; });
  };
  const auto time_of_row = [&](int from, int to) {
    const Sample a = at(from), b = at(to);
    return (b.processor_time - a.processor_time) / (b.rows - a.rows);
  };
  const double first = time_of_row(50, 300), last = time_of_row(740, 990);
  const double memory = at(100).memory, grown = samples.back().memory - memory;

  auto history = table(path("out/history.csv"));
  const auto& kinetic = history["energy_kinetic_J_m"];
  std::vector<double> energy = kinetic;
  for (const char* name : {"energy_strain_J_m", "energy_cohesive_J_m", "energy_fluid_J_m"}) {
    for (std::size_t i = 0; i < energy.size(); ++i) energy[i] += history[name][i];
  }
  const std::size_t rows = energy.size(), tenth = rows / 10;
  const double before = mean(energy, tenth, 2 * tenth), after = mean(energy, rows - tenth, rows);
  const double ringing = 2.0 * mean(kinetic, tenth, rows);
  const auto [least, most] =
      std::minmax_element(energy.begin() + static_cast<std::ptrdiff_t>(tenth), energy.end());
  std::printf(
      "10^6 steps: energy %.2e of that of the waves more at the end (spread of rows %.1e), %.1e of all;\n"
      "memory %.1f MB, %.2f MB more at the end; time per step at the end over that at the beginning %.3f\n",
      (after - before) / ringing, (*most - *least) / ringing, (after - before) / before, 1e-6 * memory,
      1e-6 * grown, last / first);
  EXPECT_GT(ringing, 0.0);
  EXPECT_LT(std::abs(after - before) / ringing, 1e-2);
  EXPECT_LT(grown, 1e6);
  EXPECT_LT(last / first, 1.2);
}

}  // namespace
}  // namespace crackle_test
