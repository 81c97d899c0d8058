// SPDX-License-Identifier: GPL-3.0-or-later
//
// `crackle catalog`: the events of a finished run in a format of seismology, or in short.
#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include "catalog_figures.hpp"
#include "catalog_summary.hpp"
#include "commands.hpp"
#include "crackle/core/errors.hpp"
#include "crackle/io/output.hpp"
#include "load.hpp"

namespace crackle {
namespace {

/// Events reach as far as four edges, and as long as a shear wave takes for that.
ClusterRule cluster_rule(const CatalogOptions& options, const std::vector<SeismicEvent>& events,
                         const Case& scene) {
  ClusterRule rule;
  if (!options.radius.empty()) {
    rule.radius = quantity("--radius", options.radius, "m");
  } else if (!events.empty()) {
    std::vector<double> lengths;
    lengths.reserve(events.size());
    for (const SeismicEvent& e : events) lengths.push_back(e.length / e.edges);
    const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
    std::nth_element(lengths.begin(), middle, lengths.end());
    rule.radius = 4.0 * *middle;
  }
  const double shear_modulus = 0.5 * scene.rock.young_modulus / (1.0 + scene.rock.poisson_ratio);
  rule.window = options.window.empty() ? rule.radius / std::sqrt(shear_modulus / scene.rock.density)
                                       : quantity("--window", options.window, "s");
  for (const auto& [name, value] : {std::pair{"--radius", rule.radius}, {"--window", rule.window}}) {
    if (!(value >= 0.0)) throw CaseError(fmt::format("{}: has to be zero or positive", name));
  }
  return rule;
}

std::vector<SeismicEvent> clustered(const std::vector<SeismicEvent>& events, const ClusterRule& rule,
                                    double thickness) {
  std::vector<SeismicEvent> wholes;
  for (const Cluster& c : cluster_events(events, rule, thickness)) wholes.push_back(as_event(c, events));
  return wholes;
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
  std::vector<SeismicEvent> events = read_events_csv((folder / "events.csv").string());
  const Case scene = load_case((folder / "resolved.toml").string(), {}, {});
  const ClusterRule rule = cluster_rule(options, events, scene);
  if (options.clustered) events = clustered(events, rule, scene.seismic.thickness);
  if (options.format.empty()) {
    fmt::print("{}", catalog_summary(options.folder, events, scene, rule));
    if (options.figures) fmt::print("{}", draw_catalog(options.folder, b_value_of(events)));
    fmt::print("As a file: crackle catalog {} --to csv|quakeml|zmap -o FILE\n", options.folder);
    return 0;
  }
  const std::string text = catalog_text(events, scene, options.format);
  if (options.output.empty()) {
    std::fwrite(text.data(), 1, text.size(), stdout);
  } else {
    write_text(options.output, text);
    fmt::print("{}: {} event{}\n", options.output, events.size(), events.size() == 1 ? "" : "s");
  }
  return 0;
}

}  // namespace crackle
