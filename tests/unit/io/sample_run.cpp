// SPDX-License-Identifier: GPL-3.0-or-later
#include "sample_run.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <numbers>
#include <sstream>

namespace crackle::test {

namespace {

constexpr double radius = 0.05;       // of the wellbore [m]
constexpr double outer = 1.0;         // of the mesh [m]
constexpr double breakdown = 1.0e-3;  // [s]
constexpr double crack_speed = 600;   // [m/s]

/// A polar grid, twisted a little so that radial edges wander; rings grow geometrically.
Vec2 grid_point(int ring, int sector, SampleSize size) {
  const double share = static_cast<double>(ring) / size.rings;
  const double r = radius * std::pow(outer / radius, share);
  const double angle = 2.0 * std::numbers::pi * sector / size.segments + 0.15 * std::sin(7.0 * share);
  return {r * std::cos(angle), r * std::sin(angle)};
}

/// A wave from the wellbore, once it has broken [m].
Vec2 displacement(Vec2 place, double time) {
  const double r = norm(place);
  const double front = 4000.0 * std::max(time - breakdown, 0.0) + 0.02 * time / breakdown;
  const double amplitude = 4e-6 * std::exp(-std::abs(r - radius - front) / 0.15) * std::sin(r * 60.0);
  return (amplitude / r + 1e-6 * time / breakdown * radius / (r * r)) * place;
}

struct Crack {
  Vec2 from, to;
  double broken_at;  // [s]
  FailureMode mode;
};

/// Radial edges of three sectors, breaking one after the other.
std::vector<Crack> cracks(SampleSize size) {
  std::vector<Crack> found;
  for (const int sector : {0, size.segments / 2, size.segments / 5}) {
    for (int ring = 0; ring < size.rings; ++ring) {
      const Vec2 from = grid_point(ring, sector, size);
      const Vec2 to = grid_point(ring + 1, sector, size);
      const double slowness = sector == size.segments / 5 ? 3.0 : 1.0;
      const int kind = (ring * 7 + sector) % 9;
      found.push_back({from, to, breakdown + slowness * (norm(to) - radius) / crack_speed,
                       kind == 4   ? FailureMode::shear
                       : kind == 7 ? FailureMode::mixed
                                   : FailureMode::tensile});
    }
  }
  return found;
}

}  // namespace

ScratchFolder::ScratchFolder() {
  const auto* test = testing::UnitTest::GetInstance()->current_test_info();
  path_ = std::filesystem::temp_directory_path() / ("crackle_" + std::string(test->test_suite_name()) + "_" +
                                                    test->name() + "_" + std::to_string(getpid()));
  std::filesystem::remove_all(path_);
  std::filesystem::create_directories(path_);
}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

std::string content(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

Case sample_case() {
  Case scene;
  scene.title = "A sample <with> \"awkward\" characters & an umlaut: ü";
  scene.file = "sample.toml";
  scene.domain = {2.0, 2.0};
  scene.wellbore.diameter = 2.0 * radius;
  scene.mesh.size_fine = 0.003;
  scene.mesh.fine_radius = 0.3;
  scene.mesh.size_coarse = 0.05;
  scene.rock = {2500.0, 35e9, 0.25, 3e6, 10e6, 0.66, 5.0, 80.0};
  scene.cohesive.penalty = 120e9;
  scene.stress = {-7.05e6, -4.9e6, 0.0};
  scene.fluid.pump = {{0.0, 2e-3, 0.065}};
  scene.run.end_time = 2e-3;
  scene.seismic = {7.5, 51.25, 1500.0, "out_of_plane", "2016-02-29T23:59:59.9990Z", 2.0};
  return scene;
}

FieldFrame sample_fields(double time, SampleSize size) {
  FieldFrame frame;
  frame.time = time;
  Field displacements{"displacement_m", 2, {}};
  Field velocities{"velocity_m_s", 2, {}};
  Field stress{"stress_Pa", 3, {}};
  Field region{"region", 1, {}};
  const auto add_triangle = [&](const std::array<Vec2, 3>& corners) {
    const auto first = static_cast<Index>(frame.points.size());
    frame.triangles.push_back({first, first + 1, first + 2});
    for (const Vec2 corner : corners) {
      const Vec2 u = displacement(corner, time);
      const double step = 1e-7;
      const Vec2 v = (1.0 / step) * (displacement(corner, time + step) - u);
      frame.points.push_back(corner + u);
      for (const double value : {u.x, u.y}) displacements.add(value);
      for (const double value : {v.x, v.y}) velocities.add(value);
    }
    const double r = norm(corners[0]);
    for (const double value : {-5e6 * radius / r, -4e6 * radius / r, 1e5 * corners[0].x}) stress.add(value);
    region.add(0.0);
  };
  for (int ring = 0; ring < size.rings; ++ring) {
    for (int sector = 0; sector < size.segments; ++sector) {
      const Vec2 a = grid_point(ring, sector, size);
      const Vec2 b = grid_point(ring + 1, sector, size);
      const Vec2 c = grid_point(ring + 1, sector + 1, size);
      const Vec2 d = grid_point(ring, sector + 1, size);
      add_triangle({a, b, c});
      add_triangle({a, c, d});
    }
  }
  frame.point_fields = {std::move(displacements), std::move(velocities)};
  frame.cell_fields = {std::move(stress), std::move(region)};
  return frame;
}

FractureFrame sample_fractures(double time, SampleSize size) {
  FractureFrame frame;
  frame.time = time;
  Field opening{"opening_m", 1, {}};
  Field slip{"slip_m", 1, {}};
  Field damage{"damage", 1, {}};
  Field mode{"mode", 1, {}};
  Field pressure{"pressure_Pa", 1, {}};
  Field broken{"broken", 1, {}};
  for (const Crack& crack : cracks(size)) {
    const double since = time - crack.broken_at;
    if (since < -2e-5) continue;
    const bool is_broken = since >= 0.0;
    const auto first = static_cast<Index>(frame.points.size());
    frame.points.push_back(crack.from);
    frame.points.push_back(crack.to);
    frame.lines.push_back({first, first + 1});
    opening.add(is_broken ? 1e-5 + since * 0.05 : 2e-6);
    slip.add(crack.mode == FailureMode::tensile ? 0.0 : 1e-5);
    damage.add(is_broken ? 1.0 : 0.5);
    mode.add(is_broken ? static_cast<double>(crack.mode) : 0.0);
    pressure.add(is_broken ? sample_history(time).pressure : 0.0);
    broken.add(is_broken ? 1.0 : 0.0);
  }
  frame.cell_fields = {std::move(opening), std::move(slip),     std::move(damage),
                       std::move(mode),    std::move(pressure), std::move(broken)};
  return frame;
}

std::vector<SeismicEvent> sample_events(double time, SampleSize size) {
  std::vector<SeismicEvent> events;
  Index edge = 100;
  for (const Crack& crack : cracks(size)) {
    ++edge;
    if (crack.broken_at > time) continue;
    SeismicEvent event;
    event.time = crack.broken_at;
    event.place = 0.5 * (crack.from + crack.to);
    event.mode = crack.mode;
    event.length = norm(crack.to - crack.from);
    event.fracture_energy = 5.0 * event.length;
    event.energy = event.fracture_energy * (0.2 + 0.7 * std::abs(std::sin(17.0 * edge)));
    event.magnitude = (std::log10(event.energy) - 4.8) / 1.5;
    event.opening = 5.15e-6;
    event.slip = crack.mode == FailureMode::tensile ? -1e-7 : 1e-5;
    event.edge = edge;
    event.duration = 2e-6;
    event.moment =
        moment_of_jump({16.2e9, 13.8e9}, crack.to - crack.from, event.length, event.opening, event.slip);
    event.moment_magnitude = moment_magnitude(2.0 * scalar_moment(event.moment));
    events.push_back(event);
  }
  std::sort(events.begin(), events.end(), [](const auto& a, const auto& b) { return a.time < b.time; });
  return events;
}

HistoryRow sample_history(double time) {
  HistoryRow row;
  row.time = time;
  row.time_step = 1.1e-8;
  const double since = std::max(time - breakdown, 0.0);
  row.pressure = 11.5e6 * std::min(time / breakdown, 1.0) - 6e6 * (1.0 - std::exp(-since / 1.5e-4)) +
                 2e5 * std::sin(time * 4e4) * (since > 0.0 ? 1.0 : 0.05);
  row.injection_rate = 0.065;
  row.injected = 0.065 * time;
  row.cavity_volume = std::numbers::pi * radius * radius + 0.5 * row.injected;
  row.wetted_length = 600.0 * since;
  for (const SeismicEvent& event : sample_events(time)) {
    ++(event.mode == FailureMode::tensile ? row.broken_tensile
       : event.mode == FailureMode::shear ? row.broken_shear
                                          : row.broken_mixed);
  }
  row.energy_strain = 1.0 / 3.0;
  row.energy_residual = -1e-5;
  return row;
}

void write_sample_run(const std::string& folder, int frames, double end_time, bool finished,
                      SampleSize size) {
  const Case scene = sample_case();
  RunFolder run(folder);
  run.log("a run that never was");
  run.write_resolved(scene);
  constexpr int rows = 400;
  for (int i = 0; i <= rows; ++i) run.append_history(sample_history(end_time * i / rows));
  for (int i = 0; i < frames; ++i) {
    const double time = frames > 1 ? end_time * i / (frames - 1) : 0.0;
    run.write_frame(sample_fields(time, size), sample_fractures(time, size));
  }
  const std::vector<SeismicEvent> events = sample_events(end_time, size);
  for (const SeismicEvent& event : events) run.append_event(event);
  if (!finished) return;
  run.write_quakeml(events, scene);
  RunSummary summary;
  summary.breakdown_pressure = 11.47e6;
  summary.breakdown_time = breakdown;
  summary.propagation_pressure = 5.5e6;
  summary.events = static_cast<std::int64_t>(events.size());
  summary.magnitude_min = std::numeric_limits<double>::quiet_NaN();
  summary.magnitude_max = std::numeric_limits<double>::quiet_NaN();
  for (const SeismicEvent& event : events) {
    summary.magnitude_min = std::fmin(summary.magnitude_min, event.magnitude);
    summary.magnitude_max = std::fmax(summary.magnitude_max, event.magnitude);
  }
  run.write_summary(summary);
}

}  // namespace crackle::test
