// SPDX-License-Identifier: GPL-3.0-or-later
#include "crackle/io/joints_csv.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string_view>

#include "crackle/core/errors.hpp"
#include "file.hpp"

namespace crackle {
namespace {

constexpr double farthest = 1e12;  // [m]; lengths and areas are finite
constexpr std::array<std::string_view, 4> names{"x1_m", "y1_m", "x2_m", "y2_m"};

std::string_view trimmed(std::string_view text) {
  const auto is_blank = [](char c) { return c == ' ' || c == '\t' || c == '\r' || c == '"'; };
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

std::vector<std::string_view> cells_of(std::string_view line) {
  std::vector<std::string_view> cells;
  for (;;) {
    const std::size_t comma = line.find(',');
    cells.push_back(trimmed(line.substr(0, comma)));
    if (comma == std::string_view::npos) return cells;
    line.remove_prefix(comma + 1);
  }
}

class Reader {
 public:
  explicit Reader(const std::string& path) : path_(path) {}

  std::vector<Joint> read(std::string_view text, Index set) {
    std::vector<Joint> joints;
    if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);  // spreadsheets put it there
    while (!text.empty()) {
      const std::size_t end = text.find('\n');
      const std::string_view line = trimmed(text.substr(0, end));
      text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
      ++line_;
      if (line.empty() || line.starts_with('#')) continue;
      if (width_ == 0) {
        read_header(line);
      } else {
        joints.push_back(read_row(line, set));
      }
    }
    if (width_ == 0)
      fail(fmt::format("the file is empty; the first line names the columns {}", fmt::join(names, ",")));
    return joints;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw CaseError(fmt::format("{}:{}: {}", path_, line_, what));
  }

  void read_header(std::string_view line) {
    const std::vector<std::string_view> cells = cells_of(line);
    width_ = cells.size();
    for (std::size_t i = 0; i < names.size(); ++i) {
      const auto at = std::ranges::find(cells, names[i]);
      if (at == cells.end()) {
        fail(fmt::format("there is no column {}; the first line has to name {} (lengths in metres)", names[i],
                         fmt::join(names, ",")));
      }
      column_[i] = static_cast<std::size_t>(at - cells.begin());
    }
  }

  Joint read_row(std::string_view line, Index set) const {
    const std::vector<std::string_view> cells = cells_of(line);
    if (cells.size() != width_)
      fail(fmt::format("this row has {} columns instead of {}", cells.size(), width_));
    std::array<double, 4> x{};
    for (std::size_t i = 0; i < names.size(); ++i) {
      const std::string_view cell = cells[column_[i]];
      const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), x[i]);
      if (error != std::errc{} || end != cell.data() + cell.size() || !std::isfinite(x[i])) {
        fail(fmt::format("{} is \"{}\", which is not a number", names[i], cell.substr(0, 40)));
      }
      if (std::abs(x[i]) > farthest)
        fail(fmt::format("{} is {:g} m, farther than {:g} m", names[i], x[i], farthest));
    }
    if (x[0] == x[2] && x[1] == x[3]) fail("the joint has no length: remove the row");
    return {{x[0], x[1]}, {x[2], x[3]}, set};
  }

  const std::string& path_;
  int line_ = 0;
  std::size_t width_ = 0;  ///< columns; 0: header not read yet
  std::array<std::size_t, 4> column_{};
};

}  // namespace

std::vector<Joint> read_joints_csv(const std::string& path, Index set) {
  const std::string text = read_whole_file(path, largest_table);
  return Reader(path).read(text, set);
}

}  // namespace crackle
