// SPDX-License-Identifier: GPL-3.0-or-later
#include "crackle/core/units.hpp"

#include <fmt/format.h>
#include <locale.h>
#include <udunits2.h>

#include <charconv>
#include <cmath>
#include <cstring>
#include <memory>

namespace crackle {
namespace {

/// No unit that means anything is longer; keeps nonsense away from the parser of UDUNITS.
constexpr std::size_t longest_unit = 64;

struct FreeUnit {
  void operator()(ut_unit* unit) const { ut_free(unit); }
};
using Unit = std::unique_ptr<ut_unit, FreeUnit>;

struct FreeConverter {
  void operator()(cv_converter* converter) const { cv_free(converter); }
};

/// UDUNITS reads numbers by strtod, which follows the locale: this thread reads a decimal point
/// while one of these lives.
class DecimalPoint {
 public:
  DecimalPoint() : plain_(newlocale(LC_NUMERIC_MASK, "C", nullptr)), before_(uselocale(plain_)) {}
  ~DecimalPoint() {
    uselocale(before_);
    if (plain_) freelocale(plain_);
  }
  DecimalPoint(const DecimalPoint&) = delete;
  DecimalPoint& operator=(const DecimalPoint&) = delete;

 private:
  locale_t plain_;
  locale_t before_;
};

std::string_view trim(std::string_view text) {
  const auto first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }
/// A letter of a unit's name, an ASCII one or a part of a UTF-8 one.
bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' ||
         static_cast<unsigned char>(c) >= 0x80;
}

/// UDUNITS reads more than units: "7 mm" after a number multiplies, "mm @ 5" shifts, "m/0" and
/// "Pa m0.5" come out as something. Here a unit is names with whole exponents, perhaps after "1/".
bool looks_like_unit(std::string_view unit) {
  if (unit.size() > longest_unit) return false;
  if (unit.starts_with("1/")) unit.remove_prefix(2);
  for (std::size_t i = 0; i < unit.size(); ++i) {
    const char c = unit[i];
    const auto before = [&](std::size_t n) { return i >= n ? unit[i - n] : ' '; };
    const bool after_power = before(1) == '^' || (before(1) == '*' && before(2) == '*');
    if (is_letter(c) || std::strchr(" */.^()%'\"", c)) {
      if (c == '\0') return false;
    } else if (c == '+' || c == '-') {
      if (!is_letter(before(1)) && !after_power) return false;
    } else if (is_digit(c)) {
      const bool exponent = is_letter(before(1)) || is_digit(before(1)) || after_power ||
                            ((before(1) == '+' || before(1) == '-'));
      if (!exponent) return false;
    } else {
      return false;
    }
  }
  return true;
}

Unit parse(ut_system* system, std::string_view text) {
  return Unit(ut_parse(system, std::string(text).c_str(), UT_UTF8));
}

/// Whether a unit measures an angle; to UDUNITS the radian has no dimension.
bool is_angle(const ut_unit* unit) {
  char text[256];
  const int length = ut_format(unit, text, sizeof text - 1, UT_ASCII);
  if (length < 0) return false;
  return std::string_view(text, static_cast<std::size_t>(length)).find("rad") != std::string_view::npos;
}

/// Whether two units have one dimension. ut_are_convertible() also takes the reciprocal, 1/s for s.
bool same_dimension(const ut_unit* a, const ut_unit* b) {
  const Unit quotient(ut_divide(a, b));
  return quotient && ut_is_dimensionless(quotient.get()) && is_angle(a) == is_angle(b) &&
         ut_are_convertible(a, b);
}

/// UDUNITS multiplies prefixes in binary, a litre is 0.0010000000000000002 m3 there: the decimal
/// number of 15 digits is taken where it lies within two units in the last place.
double decimal(double factor) {
  double rounded = 0.0;
  const std::string text = fmt::format("{:.15g}", factor);
  std::from_chars(text.data(), text.data() + text.size(), rounded);
  return std::abs(rounded - factor) <= 4.5e-16 * std::abs(factor) ? rounded : factor;
}

/// value x factor; for a power of ten by moving the decimal point, so that 1.68 ms is the double 1.68e-3.
double scale(double value, double factor) {
  const double power = std::round(std::log10(factor));
  if (std::abs(power) > 60.0 || factor != decimal(std::pow(10.0, power))) return value * factor;
  char text[64];
  const auto written = std::to_chars(text, text + sizeof text, value, std::chars_format::scientific);
  const std::string_view digits(text, static_cast<std::size_t>(written.ptr - text));
  const std::size_t e = digits.find('e');
  const std::string_view sign_and_exponent = digits.substr(e + 1);
  int exponent = 0;
  std::from_chars(sign_and_exponent.data() + (sign_and_exponent[0] == '+'), digits.data() + digits.size(),
                  exponent);
  const std::string moved = fmt::format("{}e{}", digits.substr(0, e), exponent + static_cast<int>(power));
  double scaled = value * factor;
  std::from_chars(moved.data(), moved.data() + moved.size(), scaled);  // out of range: keeps the product
  return scaled;
}

}  // namespace

struct Units::Database {
  Database();
  struct Free {
    void operator()(ut_system* s) const { ut_free_system(s); }
  };
  std::unique_ptr<ut_system, Free> system;
};

Units::Database::Database() {
  const DecimalPoint decimal_point;
  ut_set_error_message_handler(ut_ignore);
  system.reset(ut_read_xml(nullptr));
  if (!system)
    throw UnitError("the UDUNITS-2 database of units cannot be read; is libudunits2-data installed?");
  const auto add = [&](const char* symbol, const char* meaning) {
    const Unit unit = parse(system.get(), meaning);
    if (!unit || ut_map_symbol_to_unit(symbol, UT_UTF8, unit.get()) != UT_SUCCESS) {
      throw UnitError(fmt::format("the UDUNITS-2 database does not take the unit {}", symbol));
    }
  };
  add("deg", "arc_degree");
  add("D", "9.869233e-13 m2");  // darcy: with a prefix, mD
  add("cP", "1e-3 Pa s");
}

const Units::Database& Units::database() {
  static const Database database;  // read-only; some milliseconds to make
  return database;
}

Units::Units() : database_(database()) {}

double Units::convert(std::string_view text, std::span<const std::string_view> targets) const {
  const DecimalPoint decimal_point;
  const std::string_view trimmed = trim(text);
  const std::string_view number = trimmed.starts_with('+') ? trimmed.substr(1) : trimmed;
  double value = 0.0;
  const auto [end, status] = std::from_chars(number.data(), number.data() + number.size(), value);
  if (status == std::errc::invalid_argument) {
    throw UnitError(fmt::format("\"{}\" does not start with a number", text));
  }
  if (status != std::errc() || !std::isfinite(value)) {
    throw UnitError(fmt::format("\"{}\" is not a finite number", text));
  }
  const std::string_view name = trim(number.substr(static_cast<std::size_t>(end - number.data())));
  const Unit unit =
      looks_like_unit(name) ? parse(database_.system.get(), name.empty() ? "1" : name) : nullptr;
  if (!unit) throw UnitError(fmt::format("\"{}\" has no known unit", text));
  for (const std::string_view target_name : targets) {
    const Unit target = parse(database_.system.get(), target_name);
    if (!target) throw UnitError(fmt::format("unknown unit \"{}\" asked for", target_name));
    if (!same_dimension(unit.get(), target.get())) continue;
    const std::unique_ptr<cv_converter, FreeConverter> converter(ut_get_converter(unit.get(), target.get()));
    const double factor = converter ? cv_convert_double(converter.get(), 1.0) : 0.0;
    const bool linear = converter && factor > 0.0 && cv_convert_double(converter.get(), 0.0) == 0.0 &&
                        std::abs(cv_convert_double(converter.get(), 2.0) / factor - 2.0) < 1e-12;
    if (!linear) throw UnitError(fmt::format("\"{}\" is not on a linear scale from zero", text));
    const double converted = scale(value, decimal(factor));
    if (!std::isfinite(converted)) throw UnitError(fmt::format("\"{}\" is not a finite number", text));
    return converted;
  }
  throw UnitError(fmt::format("\"{}\" is not in units of {}", text, fmt::join(targets, " or ")));
}

}  // namespace crackle
