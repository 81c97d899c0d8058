// SPDX-License-Identifier: GPL-3.0-or-later
// What the pickers share. Private to analysis.
#pragma once

#include <span>
#include <string>
#include <utility>

#include "crackle/analysis/picks.hpp"
#include "line.hpp"

namespace crackle {

/// A pick without a value, and why.
Pick none(const std::string& name, const std::string& unit, const std::string& why);

/// First and one past the last point with low <= x <= high; x rises.
std::pair<std::size_t, std::size_t> points_between(std::span<const double> x, double low, double high);

/// The index of the last point at or before an elapsed time [s].
std::size_t point_at(const FallOff& f, double elapsed);

/// A part of the fall-off that is read as a straight line of p over G.
struct EarlyLine {
  Line line;
  double from = 0.0, to = 0.0;                          ///< G
  double intercept = 0.0, intercept_uncertainty = 0.0;  ///< at G = 0 [Pa]
  double slope_uncertainty = 0.0;                       ///< of -dp/dG [Pa]
};

/// The window of pick_isip(). The uncertainties are two standard errors, and half of what the two
/// halves of the window differ by.
std::optional<EarlyLine> early_line(const FallOff& f, const Pick& contact);

/// "the derivative's window of 0.15 decades" for methods.
std::string window_text(const FallOff& f);

}  // namespace crackle
