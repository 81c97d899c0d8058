// SPDX-License-Identifier: GPL-3.0-or-later
//
// `crackle catalog`: the events of a finished run in a format of seismology, or in short.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include "commands.hpp"
#include "crackle/core/errors.hpp"
#include "crackle/io/output.hpp"
#include "load.hpp"

namespace crackle {
namespace {

void print_summary(const std::string& folder, const std::vector<SeismicEvent>& events, const Case& scene) {
  fmt::print("{}: {} event{}\n", folder, events.size(), events.size() == 1 ? "" : "s");
  if (events.empty()) return;
  std::array<int, 4> by_mode{};
  double low = events.front().magnitude, high = low, length = 0.0;
  for (const SeismicEvent& e : events) {
    ++by_mode[static_cast<std::size_t>(e.mode)];
    low = std::min(low, e.magnitude);
    high = std::max(high, e.magnitude);
    length += e.length;
  }
  fmt::print("  {} tensile, {} shear, {} mixed; {:.4g} m broken\n", by_mode[1], by_mode[2], by_mode[3],
             length);
  fmt::print("  magnitudes {:.2f} to {:.2f} (for {:g} m of thickness)\n", low, high, scene.seismic.thickness);
  const auto [first, last] = std::minmax_element(
      events.begin(), events.end(), [](const auto& a, const auto& b) { return a.time < b.time; });
  fmt::print("  from {:.6g} to {:.6g} ms\n", 1e3 * first->time, 1e3 * last->time);
  fmt::print("As a file: crackle catalog {} --to csv|quakeml|zmap -o FILE\n", folder);
}

void write_text(const std::string& path, const std::string& text) {
  std::FILE* file = std::fopen(path.c_str(), "wb");
  const bool opened = file != nullptr;
  bool good = opened && std::fwrite(text.data(), 1, text.size(), file) == text.size();
  if (opened && std::fclose(file) != 0) good = false;
  if (!good) throw CaseError(fmt::format("{}: cannot write: {}", path, std::strerror(errno)));
}

}  // namespace

int catalog_command(const CatalogOptions& options) {
  namespace fs = std::filesystem;
  const fs::path folder(options.folder);
  for (const char* name : {"events.csv", "resolved.toml"}) {
    if (fs::exists(folder / name)) continue;
    throw CaseError(fmt::format("{}: no run is here ({} is missing)", options.folder, name));
  }
  if (options.format.empty() && !options.output.empty()) {
    throw CaseError("-o: say the format of the file as well: --to csv, quakeml or zmap");
  }
  const std::vector<SeismicEvent> events = read_events_csv((folder / "events.csv").string());
  const Case scene = load_case((folder / "resolved.toml").string(), {}, {});
  if (options.format.empty()) {
    print_summary(options.folder, events, scene);
    return 0;
  }
  const std::string text = catalog_text(events, scene, options.format);
  if (options.output.empty()) {
    std::fwrite(text.data(), 1, text.size(), stdout);
  } else {
    write_text(options.output, text);
    fmt::print("{}: {} events\n", options.output, events.size());
  }
  return 0;
}

}  // namespace crackle
