// SPDX-License-Identifier: GPL-3.0-or-later
#include "events_csv.hpp"

#include <fmt/format.h>

#include <charconv>
#include <filesystem>
#include <string_view>
#include <vector>

#include "crackle/io/output.hpp"
#include "csv.hpp"
#include "file.hpp"

namespace crackle {

namespace {

/// Every column with the value of an event that it holds.
/// @param visit (name, number or enumeration)
void each_column(auto&& event, const auto& visit) {
  visit("time_s", event.time);
  visit("x_m", event.place.x);
  visit("y_m", event.place.y);
  visit("kind", event.kind);
  visit("mode", event.mode);
  visit("energy_J_m", event.energy);
  visit("magnitude", event.magnitude);
  visit("fracture_energy_J_m", event.fracture_energy);
  visit("friction_energy_J_m", event.friction_energy);
  visit("length_m", event.length);
  visit("opening_m", event.opening);
  visit("slip_m", event.slip);
  visit("stress_drop_Pa", event.stress_drop);
  visit("duration_s", event.duration);
  visit("moment_xx_N_m_m", event.moment.xx);
  visit("moment_yy_N_m_m", event.moment.yy);
  visit("moment_zz_N_m_m", event.moment.zz);
  visit("moment_xy_N_m_m", event.moment.xy);
  visit("moment_magnitude", event.moment_magnitude);
  visit("edges", event.edges);
  visit("edge", event.edge);
}

std::size_t column_count() {
  std::size_t count = 0;
  each_column(SeismicEvent{}, [&](const char*, const auto&) { ++count; });
  return count;
}

std::string cell(double value) { return fmt::format("{}", value); }
std::string cell(Index value) { return fmt::format("{}", value); }
std::string cell(FailureMode mode) { return to_string(mode); }
std::string cell(EventKind kind) { return to_string(kind); }

[[noreturn]] void throw_damaged(const std::string& path, int line, const std::string& what) {
  throw CaseError(path + ":" + std::to_string(line) + ": " + what);
}

/// Reads the cells of one row; errors name the column.
class RowReader {
 public:
  RowReader(const std::string& path, int line, std::string_view text)
      : path_(path), line_(line), cells_(split_cells(text, ',')) {
    if (cells_.size() != column_count()) {
      throw_damaged(
          path_, line_,
          fmt::format("this row has {} columns instead of {}; remove the row (a run that was killed "
                      "may leave its last one unfinished)",
                      cells_.size(), column_count()));
    }
  }

  SeismicEvent event() const {
    SeismicEvent event;
    std::size_t column = 0;
    each_column(event, [&](const char* name, auto& value) { read(name, cells_[column++], value); });
    return event;
  }

 private:
  template <class Number>
  void read(const char* name, std::string_view cell, Number& value) const {
    const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
    if (error != std::errc{} || end != cell.data() + cell.size()) {
      throw_damaged(path_, line_, fmt::format("{} is \"{}\", which is not a number", name, cell));
    }
  }
  void read(const char*, std::string_view cell, FailureMode& value) const {
    for (const FailureMode mode : {FailureMode::tensile, FailureMode::shear, FailureMode::mixed}) {
      if (cell == to_string(mode)) {
        value = mode;
        return;
      }
    }
    throw_damaged(path_, line_, fmt::format("mode is \"{}\"; it has to be tensile, shear or mixed", cell));
  }
  void read(const char*, std::string_view cell, EventKind& value) const {
    for (const EventKind kind : {EventKind::breaking, EventKind::slip}) {
      if (cell == to_string(kind)) {
        value = kind;
        return;
      }
    }
    throw_damaged(path_, line_, fmt::format("kind is \"{}\"; it has to be breaking or slip", cell));
  }

  const std::string& path_;
  int line_;
  std::vector<std::string_view> cells_;
};

}  // namespace

std::string events_header() {
  std::string text;
  each_column(SeismicEvent{},
              [&](const char* name, const auto&) { text += (text.empty() ? "" : ",") + std::string(name); });
  return text + "\n";
}

std::string event_line(const SeismicEvent& event) {
  std::string text;
  each_column(event,
              [&](const char*, const auto& value) { text += (text.empty() ? "" : ",") + cell(value); });
  return text + "\n";
}

std::vector<SeismicEvent> read_events_csv(const std::string& path) {
  namespace fs = std::filesystem;
  std::error_code ignored;
  const std::string file = fs::is_directory(path, ignored) ? (fs::path(path) / "events.csv").string() : path;
  const std::string content = read_whole_file(file);
  std::string_view text = content;

  std::string header = events_header();
  header.pop_back();
  if (take_line(text) != header) {
    throw_damaged(file, 1, "this is not the events.csv of a run; its first line has to be " + header);
  }
  std::vector<SeismicEvent> events;
  for (int line = 2; !text.empty(); ++line) {
    const std::string_view row = take_line(text);
    if (row.empty() && text.empty()) break;
    events.push_back(RowReader(file, line, row).event());
  }
  return events;
}

}  // namespace crackle
