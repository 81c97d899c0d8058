// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "crackle/core/errors.hpp"

namespace crackle {

/// A text such as "35 GPa" cannot be read, or has another dimension than asked for. The message
/// knows no file; who reads a file adds the place.
class UnitError : public Error {
 public:
  explicit UnitError(const std::string& message) : Error(ExitCode::bad_case, message) {}
};

/// The units that a quantity in a text may have: those of UDUNITS-2, and `deg`, darcy (`D`, `mD`)
/// and centipoise (`cP`). The first one of a process reads the UDUNITS database (some milliseconds).
/// UDUNITS has one parser for the whole process: use one Units at a time.
class Units {
 public:
  /// @throws UnitError when the UDUNITS database cannot be read.
  Units();

  /// The number that `text` ("3 mm", "1 m3/min", "5 J m-2") is in the first of `targets` that has
  /// its dimension; a target is a unit such as "m" or "m3/s". An angle is not a plain number: "0.66"
  /// is no "rad", "38 deg" is no "1". Independent of the locale.
  /// @throws UnitError with one line that quotes the text.
  double convert(std::string_view text, std::span<const std::string_view> targets) const;
  double convert(std::string_view text, std::string_view target) const {
    return convert(text, std::span(&target, 1));
  }

 private:
  struct Database;
  static const Database& database();
  const Database& database_;
};

}  // namespace crackle
