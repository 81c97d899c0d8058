// SPDX-License-Identifier: GPL-3.0-or-later
#include "events_csv.hpp"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <filesystem>
#include <string_view>
#include <vector>

#include "crackle/io/output.hpp"
#include "csv.hpp"
#include "file.hpp"

namespace crackle {

namespace {

constexpr std::size_t columns = 11;

[[noreturn]] void throw_damaged(const std::string& path, int line, const std::string& what) {
  throw CaseError(path + ":" + std::to_string(line) + ": " + what);
}

/// Reads the cells of one row; errors name the column.
class RowReader {
 public:
  RowReader(const std::string& path, int line, std::string_view text)
      : path_(path), line_(line), cells_(split_cells(text, ',')) {
    if (cells_.size() != columns) {
      throw_damaged(
          path_, line_,
          fmt::format("this row has {} columns instead of {}; remove the row (a run that was killed "
                      "may leave its last one unfinished)",
                      cells_.size(), columns));
    }
  }

  template <class Number>
  Number number(std::size_t column, const char* name) const {
    const std::string_view cell = cells_[column];
    Number value{};
    const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
    if (error != std::errc{} || end != cell.data() + cell.size()) {
      throw_damaged(path_, line_, fmt::format("{} is \"{}\", which is not a number", name, cell));
    }
    return value;
  }

  FailureMode mode(std::size_t column) const {
    for (const FailureMode mode : {FailureMode::tensile, FailureMode::shear, FailureMode::mixed}) {
      if (cells_[column] == to_string(mode)) return mode;
    }
    throw_damaged(path_, line_,
                  fmt::format("mode is \"{}\"; it has to be tensile, shear or mixed", cells_[column]));
  }

 private:
  const std::string& path_;
  int line_;
  std::vector<std::string_view> cells_;
};

}  // namespace

std::string events_header() {
  return "time_s,x_m,y_m,mode,energy_J_m,magnitude,fracture_energy_J_m,length_m,opening_m,slip_m,edge\n";
}

std::string event_line(const SeismicEvent& event) {
  return fmt::format("{},{},{},{},{},{},{},{},{},{},{}\n", event.time, event.place.x, event.place.y,
                     to_string(event.mode), event.energy, event.magnitude, event.fracture_energy,
                     event.length, event.opening, event.slip, event.edge);
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
    const RowReader reader(file, line, row);
    SeismicEvent event;
    event.time = reader.number<double>(0, "time_s");
    event.place = {reader.number<double>(1, "x_m"), reader.number<double>(2, "y_m")};
    event.mode = reader.mode(3);
    event.energy = reader.number<double>(4, "energy_J_m");
    event.magnitude = reader.number<double>(5, "magnitude");
    event.fracture_energy = reader.number<double>(6, "fracture_energy_J_m");
    event.length = reader.number<double>(7, "length_m");
    event.opening = reader.number<double>(8, "opening_m");
    event.slip = reader.number<double>(9, "slip_m");
    event.edge = reader.number<Index>(10, "edge");
    events.push_back(event);
  }
  return events;
}

}  // namespace crackle
