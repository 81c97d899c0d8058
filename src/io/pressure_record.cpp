// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <optional>

#include "crackle/core/units.hpp"
#include "crackle/io/dfit.hpp"
#include "csv.hpp"
#include "file.hpp"

namespace crackle {
namespace {

[[noreturn]] void refuse(const std::string& path, int line, const std::string& what) {
  throw CaseError(fmt::format("{}:{}: {}", path, line, what));
}

std::string_view bare(std::string_view cell) {
  const auto is_edge = [](char c) { return c == ' ' || c == '\t' || c == '"'; };
  while (!cell.empty() && is_edge(cell.front())) cell.remove_prefix(1);
  while (!cell.empty() && is_edge(cell.back())) cell.remove_suffix(1);
  return cell;
}

std::string lower(std::string_view text) {
  std::string small(text);
  for (char& c : small) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return small;
}

std::optional<double> number_in(std::string_view cell) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (error != std::errc{} || end != cell.data() + cell.size()) return {};
  return value;
}

/// What a column of the record is called and measured in.
struct Wanted {
  std::string what;                     ///< "time", for messages and as the option's name
  std::vector<std::string_view> names;  ///< in headers, lower case
  std::vector<std::string_view> units;  ///< SI
  std::string example;                  ///< of a unit
};

const std::array<Wanted, 3>& wanted_columns() {
  static const std::array<Wanted, 3> wanted{{
      {"time", {"time", "t"}, {"s"}, "s"},
      {"pressure", {"pressure", "p"}, {"Pa"}, "psi"},
      {"rate", {"rate", "injection_rate", "q"}, {"m3/s", "m2/s"}, "bbl/min"},
  }};
  return wanted;
}

/// A column that was found.
struct Column {
  std::size_t index = 0;
  std::string unit;  ///< as written; empty: not said
};

struct HeaderCell {
  std::string name;
  std::string unit;
};

/// "Pressure [psi]" and "rate (bbl/min)" by their brackets.
HeaderCell split_brackets(std::string_view cell) {
  for (const auto& [open, close] : {std::pair{'[', ']'}, std::pair{'(', ')'}}) {
    const std::size_t at = cell.find(open);
    if (at == std::string_view::npos || cell.back() != close) continue;
    return {std::string(bare(cell.substr(0, at))),
            std::string(bare(cell.substr(at + 1, cell.size() - at - 2)))};
  }
  return {std::string(cell), ""};
}

/// Factor to SI, and which of the column's SI units that is; none where the dimension is another.
struct Scale {
  double factor = 1.0;
  std::size_t unit = 0;
};

std::optional<Scale> scale_of(const Units& units, const std::string& unit, const Wanted& wanted) {
  const std::string text = "1 " + (lower(unit) == "bpm" ? "bbl/min" : unit);
  for (std::size_t k = 0; k < wanted.units.size(); ++k) {
    try {
      return Scale{units.convert(text, wanted.units[k]), k};
    } catch (const UnitError&) {  // perhaps the next one
    }
  }
  return {};
}

/// Reads one table.
class RecordReader {
 public:
  RecordReader(std::string path, const RecordColumns& columns)
      : path_(std::move(path)),
        text_(read_whole_file(path_, largest_table)),
        chosen_{columns.time, columns.pressure, columns.rate} {}

  PressureRecord read() {
    std::string_view rest = text_;
    if (rest.starts_with("\xEF\xBB\xBF")) rest.remove_prefix(3);  // mark of UTF-8
    while (!rest.empty()) {
      ++line_;
      const std::string_view line = take_line(rest);
      if (bare(line).empty() || line.front() == '#') continue;
      if (header_.empty()) {
        read_header(line);
        if (!headless_) continue;
      }
      read_row(line);
    }
    if (header_.empty()) throw CaseError(path_ + ": the file holds no record: it is empty");
    if (record_.time.empty()) refuse(path_, line_, "there are no samples below the header");
    record_.source = path_;
    return std::move(record_);
  }

 private:
  void read_header(std::string_view line) {
    separator_ = line.find('\t') != std::string_view::npos  ? '\t'
                 : line.find(';') != std::string_view::npos ? ';'
                                                            : ',';
    for (const std::string_view cell : split_cells(line, separator_)) header_.emplace_back(bare(cell));
    headless_ =
        std::ranges::all_of(header_, [](const std::string& cell) { return number_in(cell).has_value(); });
    for (std::size_t k = 0; k < 3; ++k) {
      const Wanted& wanted = wanted_columns()[k];
      columns_[k] = chosen_[k].empty() ? find_column(wanted) : choose_column(wanted, chosen_[k]);
    }
    if (headless_) return set_scales();
    for (const char* name : {"closure_stress_Pa", "contact_fraction", "half_length_m"}) {
      const auto at = std::ranges::find(header_, name);
      if (at != header_.end()) truth_.emplace_back(name, static_cast<std::size_t>(at - header_.begin()));
    }
  }

  /// The one column whose header says that it is this.
  Column find_column(const Wanted& wanted) const {
    std::vector<Column> found;
    for (std::size_t i = 0; i < header_.size() && !headless_; ++i) {
      const HeaderCell cell = split_brackets(header_[i]);
      const std::string name = lower(cell.name);
      for (const std::string_view known : wanted.names) {
        if (name == known) {
          found.push_back({i, cell.unit});
        } else if (cell.unit.empty() && name.starts_with(known) && name[known.size()] == '_') {
          std::string unit = cell.name.substr(known.size() + 1);  // m3_s for m3/s
          if (const auto per = unit.find('_'); per != std::string::npos) unit[per] = '/';
          if (scale_of(units_, unit, wanted)) found.push_back({i, unit});
        }
      }
    }
    if (found.size() == 1) return found[0];
    const std::string advice =
        fmt::format("; name it by --{} COLUMN:UNIT, for example --{} \"{}:{}\"", wanted.what, wanted.what,
                    headless_ ? "2" : header_.front(), wanted.example);
    if (headless_) refuse(path_, line_, "the first row holds no names of columns" + advice);
    refuse(
        path_, line_,
        fmt::format("{} of the columns ({}) {} {}{}", found.empty() ? "none" : "more than one",
                    fmt::join(header_, ", "), found.empty() ? "is the" : "may be the", wanted.what, advice));
  }

  Column choose_column(const Wanted& wanted, const std::string& choice) const {
    std::string name = choice, unit;
    std::optional<std::size_t> index = index_of(name);
    if (const std::size_t colon = choice.rfind(':'); !index && colon != std::string::npos) {
      name = choice.substr(0, colon);
      unit = choice.substr(colon + 1);
      index = index_of(name);
    }
    if (!index) {
      throw CaseError(fmt::format("--{}: {} has no column \"{}\" (it has {})", wanted.what, path_, name,
                                  headless_ ? fmt::format("{} without names", header_.size())
                                            : fmt::format("{}", fmt::join(header_, ", "))));
    }
    if (unit.empty()) unit = unit_in_header(*index, wanted);
    return {*index, unit};
  }

  std::string unit_in_header(std::size_t index, const Wanted& wanted) const {
    const HeaderCell cell = split_brackets(header_[index]);
    if (!cell.unit.empty()) return cell.unit;
    for (std::size_t at = cell.name.find('_'); at != std::string::npos; at = cell.name.find('_', at + 1)) {
      std::string unit = cell.name.substr(at + 1);
      if (const auto per = unit.find('_'); per != std::string::npos) unit[per] = '/';
      if (scale_of(units_, unit, wanted)) return unit;
    }
    return {};
  }

  std::optional<std::size_t> index_of(const std::string& name) const {
    for (std::size_t i = 0; i < header_.size() && !headless_; ++i) {
      if (lower(header_[i]) == lower(name) || lower(split_brackets(header_[i]).name) == lower(name)) return i;
    }
    const auto number = number_in(name);
    if (!number || *number < 1.0 || *number > static_cast<double>(header_.size())) return {};
    return static_cast<std::size_t>(*number) - 1;
  }

  void set_scales() {
    for (std::size_t k = 0; k < 3; ++k) {
      const Wanted& wanted = wanted_columns()[k];
      const Column& column = columns_[k];
      if (column.unit.empty()) {
        refuse(path_, line_,
               fmt::format(
                   "the unit of the {} (column \"{}\") is not said; say it by --{} \"{}:UNIT\", for example "
                   "{}",
                   wanted.what, header_[column.index], wanted.what,
                   headless_ ? std::to_string(column.index + 1) : header_[column.index], wanted.example));
      }
      const auto scale = scale_of(units_, column.unit, wanted);
      if (!scale) {
        refuse(
            path_, line_,
            fmt::format("\"{}\" is not a unit of {}, such as {}", column.unit, wanted.what, wanted.example));
      }
      factors_[k] = scale->factor;
      if (k == 2) record_.per_metre = scale->unit == 1;
    }
    scaled_ = true;
  }

  /// A row of units below the header, where the header says none. @return whether it was one
  bool read_units(const std::vector<std::string_view>& cells) {
    if (number_in(bare(cells[columns_[0].index]))) return false;
    for (Column& column : columns_) {
      if (column.unit.empty()) column.unit = std::string(bare(cells[column.index]));
    }
    return true;
  }

  void read_row(std::string_view line) {
    const std::vector<std::string_view> cells = split_cells(line, separator_);
    if (cells.size() != header_.size()) {
      refuse(path_, line_,
             fmt::format("this row has {} columns instead of {}", cells.size(), header_.size()));
    }
    if (!scaled_) {
      const bool units = read_units(cells);
      set_scales();
      if (units) return;
    }
    const std::array<std::vector<double>*, 3> values{&record_.time, &record_.pressure, &record_.rate};
    for (std::size_t k = 0; k < 3; ++k)
      values[k]->push_back(cell_value(cells, columns_[k].index) * factors_[k]);
    for (const auto& [name, index] : truth_) record_.truth[name].push_back(cell_value(cells, index));
    record_.lines.push_back(line_);
  }

  double cell_value(const std::vector<std::string_view>& cells, std::size_t index) const {
    const std::string_view cell = bare(cells[index]);
    const auto value = number_in(cell);
    if (value && std::isfinite(*value)) return *value;
    const std::string name = headless_ ? fmt::format("column {}", index + 1) : header_[index];
    refuse(path_, line_,
           cell.empty()
               ? name + " is empty; fill it in or remove the row"
               : fmt::format("{} is \"{}\", which is not a finite number", name, cell.substr(0, 40)));
  }

  std::string path_, text_;
  Units units_;
  std::array<std::string, 3> chosen_;
  int line_ = 0;
  char separator_ = ',';
  std::vector<std::string> header_;
  bool headless_ = false, scaled_ = false;
  std::array<Column, 3> columns_;
  std::array<double, 3> factors_{};
  std::vector<std::pair<std::string, std::size_t>> truth_;
  PressureRecord record_;
};

}  // namespace

PressureRecord read_pressure_record(const std::string& path, const RecordColumns& columns) {
  namespace fs = std::filesystem;
  std::error_code ignored;
  std::string file = path;
  if (fs::is_directory(path, ignored)) {
    file = (fs::path(path) / "history.csv").string();
    if (!fs::exists(file, ignored)) throw CaseError(path + ": no run is here (history.csv is missing)");
  }
  return RecordReader(file, columns).read();
}

}  // namespace crackle
