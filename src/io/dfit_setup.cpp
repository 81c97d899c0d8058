// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "crackle/core/nearest.hpp"
#include "crackle/core/units.hpp"
#include "crackle/io/dfit.hpp"
#include "file.hpp"
#include "toml_tree.hpp"

namespace crackle {
namespace {

constexpr double inf = std::numeric_limits<double>::infinity();

struct DfitKey {
  std::string_view name;
  std::string_view unit;  ///< SI; empty: a word
  double low, high;       ///< the value lies strictly between
  std::string_view example;
  std::string_view meaning;
  /// Puts the number, or the word of a key of words; false on a word it does not know.
  void (*put)(DfitSetup&, double) = nullptr;
  bool (*put_word)(DfitSetup&, const std::string&) = nullptr;
};

bool put_pump_time(DfitSetup& s, const std::string& word) {
  if (word != "volume" && word != "breakdown") return false;
  s.settings.pump_time.reset();
  s.settings.since_breakdown = word == "breakdown";
  return true;
}

bool put_geometry(DfitSetup& s, const std::string& word) {
  if (word != "kgd" && word != "pkn" && word != "radial") return false;
  s.inputs.geometry = word == "kgd" ? Geometry::kgd : word == "pkn" ? Geometry::pkn : Geometry::radial;
  return true;
}

const std::vector<DfitKey>& dfit_keys() {
  using S = DfitSetup;
  // clang-format off
  static const std::vector<DfitKey> keys{
      {"shut_in", "s", -inf, inf, "\"310 s\"", "time of shut-in (default: where the rate falls to rest)",
       [](S& s, double v) { s.settings.shut_in = v; }},
      {"pump_time", "s", 0.0, inf, "\"5 min\"", "t_p; or \"volume\" (volume / last rate, the default) or \"breakdown\" (since the largest pressure)",
       [](S& s, double v) { s.settings.pump_time = v; }, put_pump_time},
      {"alpha", "1", 0.5 - 1e-12, 1.0 + 1e-12, "1", "of the G-function: 1 (little leak-off, the default) to 0.5 (much)",
       [](S& s, double v) { s.settings.alpha = v; }},
      {"window", "1", 0.0, 2.0, "0.2", "of the derivatives, in decades of time (default: by the noise)",
       [](S& s, double v) { s.settings.window = v; }},
      {"young_modulus", "Pa", 0.0, inf, "\"42.5 GPa\"", "of the rock",
       [](S& s, double v) { s.inputs.young_modulus = v; }},
      {"poisson_ratio", "1", -1.0, 0.5, "0.17", "of the rock",
       [](S& s, double v) { s.inputs.poisson_ratio = v; }},
      {"geometry", "", 0.0, 0.0, "\"kgd\"", "of the fracture: \"kgd\" (default), \"pkn\" or \"radial\"", nullptr, put_geometry},
      {"height", "m", 0.0, inf, "\"50 m\"", "of the fracture",
       [](S& s, double v) { s.inputs.height = v; }},
      {"half_length", "m", 0.0, inf, "\"40 m\"", "of one wing at shut-in; radius of a radial fracture",
       [](S& s, double v) { s.inputs.half_length = v; }},
      {"fracture_stiffness", "Pa/m", 0.0, inf, "\"0.35 GPa/m\"", "net pressure by mean opening, in place of modulus and size",
       [](S& s, double v) { s.inputs.fracture_stiffness = v; }},
      {"well_storage", "m3/Pa", 0.0, inf, "\"1.35e-8 m3/Pa\"", "volume of the well times its compressibility",
       [](S& s, double v) { s.inputs.well_storage = v; }},
      {"porosity", "1", 0.0, 1.0, "0.05", "of the rock",
       [](S& s, double v) { s.inputs.porosity = v; }},
      {"total_compressibility", "1/Pa", 0.0, inf, "\"1.5e-8 1/Pa\"", "of pores and their fluid",
       [](S& s, double v) { s.inputs.total_compressibility = v; }},
      {"viscosity", "Pa s", 0.0, inf, "\"0.02 cP\"", "of the fluid in the rock",
       [](S& s, double v) { s.inputs.viscosity = v; }},
      {"reservoir_pressure", "Pa", 0.0, inf, "\"34.8 MPa\"", "for the permeability where the record does not reach it",
       [](S& s, double v) { s.inputs.reservoir_pressure = v; }},
  };
  // clang-format on
  return keys;
}

const DfitKey& find_key(const std::string& name, const Place& place) {
  std::vector<std::string_view> names;
  for (const DfitKey& key : dfit_keys()) {
    if (key.name == name) return key;
    names.push_back(key.name);
  }
  fail(place, fmt::format("unknown key {}: the nearest is \"{}\"", shown(name), nearest(name, names)));
}

void read_key(const TomlNode& value, const DfitKey& key, const Units& units, DfitSetup& setup) {
  using Kind = TomlNode::Kind;
  const auto expected = [&](const std::string& what) {
    fail(value.place, fmt::format("{} {}: write for example {} = {} ({})", key.name, what, key.name,
                                  key.example, key.meaning));
  };
  double number = value.number;
  if (value.kind == Kind::text) {
    if (key.put_word && key.put_word(setup, value.text)) return;
    if (!key.put) expected("= " + shown(value.text) + " is unknown");
    try {
      number = units.convert(value.text, key.unit);
    } catch (const UnitError& error) {
      expected(std::string("is wrong: ") + error.what());
    }
  } else if ((value.kind != Kind::integer && value.kind != Kind::number) || !key.put) {
    expected("cannot be " + std::string(kind_name(value.kind)));
  }
  if (!std::isfinite(number) || number <= key.low || number >= key.high) {
    expected(fmt::format("= {:g} is out of range", number));
  }
  key.put(setup, number);
  if (key.name == "pump_time") setup.settings.since_breakdown = false;
}

}  // namespace

DfitSetup read_dfit_setup(const std::string& file, const std::vector<std::string>& overrides,
                          const DfitSetup& given) {
  const Units units;
  DfitSetup setup = given;
  if (!file.empty()) {
    const TomlNode root = parse_toml(read_whole_file(file), file);
    for (const TomlNode& node : root.children)
      read_key(node, find_key(node.key, node.key_place), units, setup);
  }
  for (const std::string& text : overrides) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos) {
      throw CaseError(
          fmt::format("--set {}: write key=value, for example --set young_modulus=\"42.5 GPa\"", text));
    }
    const std::string name = text.substr(0, equals);
    const Place place{"--set " + name};
    read_key(parse_toml_value(text.substr(equals + 1), place), find_key(name, place), units, setup);
  }
  return setup;
}

std::string dfit_keys_text() {
  std::string text;
  for (const DfitKey& key : dfit_keys()) {
    text += fmt::format("  {:<22} {:<16} {}\n", key.name, key.example, key.meaning);
  }
  return text;
}

}  // namespace crackle
