// SPDX-License-Identifier: GPL-3.0-or-later
//
// `crackle list`: what there is to choose from. `crackle describe`: one thing of it.
#include <fmt/format.h>

#include <algorithm>

#include "commands.hpp"
#include "crackle/cohesive/law.hpp"
#include "crackle/core/errors.hpp"
#include "crackle/io/case.hpp"
#include "load.hpp"
#include "names.hpp"

namespace crackle {
namespace {

void print_keys(const std::string& table) {
  std::string last = "none yet";
  for (const CaseKey& key : case_keys()) {
    const bool top = key.table.empty() && table == "case";
    if (!top && table != "case" && key.table != table) continue;
    if (key.table != last) {
      fmt::print("{}{}\n", last == "none yet" ? "" : "\n",
                 key.table.empty() ? "(top of the file)" : "[" + key.table + "]");
      last = key.table;
    }
    const std::string unit = key.unit.empty() ? "-" : key.unit;
    fmt::print("  {:<22} {:<6} {:<32} {}\n", key.key, unit,
               key.default_value.empty() ? "(required)" : key.default_value, key.meaning);
  }
}

struct LawParameter {
  const char* key;
  const char* symbol;
  const char* range;
};
constexpr LawParameter law_parameters[] = {
    {"rock.tensile_strength", "f_t", "> 0"},         {"rock.cohesion", "c", "> 0"},
    {"rock.friction_angle", "phi_i", "0 to 90 deg"}, {"rock.fracture_energy_mode1", "G_I", "> 0"},
    {"rock.fracture_energy_mode2", "G_II", "> 0"},   {"cohesive.penalty", "p_f", "> 0"},
    {"contact.tangential_penalty", "p_t", "> 0"},    {"contact.friction_angle", "phi_f", "0 to 90 deg"}};

void print_formulas(const CohesiveLaw& law) {
  const double c = law.curvature();
  fmt::print(
      "  elastic    sigma = k o in compression; f_t (r (1 + c) - c r^2), r = o/o_p, in tension\n"
      "             k = p_f / L on an edge of length L, o_p = (1 + c) f_t / k, c = {:g}\n",
      c);
  fmt::print("  strength   f_s = cohesion - min(sigma, 0) tan(phi_i)\n");
  fmt::print("  residual   f_r = -min(sigma, 0) tan(phi_f)\n");
  fmt::print("  damage     D^2 = (<o - o_p>/o_t)^2 + (<|s| - s_p>/s_t)^2, never falls\n");
  fmt::print("  softening  sigma = z(D) f_t, tau = z(D) (f_s - f_r) + friction\n");
  fmt::print("             z = ");
  for (int i = 0; i <= 10; i += 2) fmt::print("{:.3f}{}", law.softening(0.1 * i), i < 10 ? ", " : "");
  fmt::print(" at D = 0, 0.2, ... 1; its integral is I = {:.6g}\n", law.softening_integral());
  fmt::print(
      "  lengths    calibration \"y_geo\": o_t = {0:g} G_I/f_t, s_t = {0:g} G_II/f_s\n"
      "             calibration \"exact\": those with which the whole curve dissipates G\n",
      law.y_geo_factor());
}

void print_law(const CohesiveLaw& law) {
  fmt::print("{}: {}\n\n", law.name(), law.description());
  if (law.formulas().empty()) {
    print_formulas(law);
  } else {
    fmt::print("{}", law.formulas());
  }
  fmt::print("\n  {:<28} {:<7} {:<6} {:<12} {}\n", "parameter", "symbol", "unit", "range", "default");
  const std::vector<CaseKey> keys = case_keys();
  for (const LawParameter& p : law_parameters) {
    const auto key = std::find_if(keys.begin(), keys.end(),
                                  [&](const CaseKey& k) { return k.table + "." + k.key == p.key; });
    if (key == keys.end()) continue;
    fmt::print("  {:<28} {:<7} {:<6} {:<12} {}\n", p.key, p.symbol, key->unit, p.range,
               key->default_value.empty() ? "(required)" : key->default_value);
  }
  fmt::print("\nIts curve as a table: crackle law {}\n", law.name());
}

}  // namespace

int list_command() {
  for (const NameGroup& group : name_groups()) {
    fmt::print("{} ({})\n", group.title, group.written);
    for (const NamedThing& thing : group.things) fmt::print("  {:<16} {}\n", thing.name, thing.meaning);
    fmt::print("\n");
  }
  fmt::print("Tables of a case file\n ");
  for (const std::string& table : case_table_names()) fmt::print(" {}", table);
  fmt::print("\n\nMore on any of these names: crackle describe NAME; on all keys: crackle describe case\n");
  return 0;
}

int describe_command(const std::string& name) {
  if (const auto law = find_law(name)) {
    print_law(*law);
    return 0;
  }
  std::vector<std::string> tables = case_table_names();
  tables.push_back("case");
  if (std::find(tables.begin(), tables.end(), name) != tables.end()) {
    print_keys(name);
    return 0;
  }
  std::vector<std::string> known = tables;
  bool found = false;
  for (const CaseKey& key : case_keys()) {
    const std::string full = key.table.empty() ? key.key : key.table + "." + key.key;
    known.push_back(full);
    if (name != full) continue;
    found = true;
    fmt::print("{} [{}]: {}; default {}\n", full, key.unit.empty() ? "-" : key.unit, key.meaning,
               key.default_value.empty() ? "none, it is required" : key.default_value);
  }
  for (const NameGroup& group : name_groups()) {
    for (const NamedThing& thing : group.things) {
      known.push_back(thing.name);
      if (thing.name != name && group.written != name) continue;
      found = true;
      fmt::print("{} ({}): {}\n", thing.name, group.written, thing.meaning);
    }
  }
  if (!found) throw unknown_name("table, key, law or model", name, known);
  return 0;
}

}  // namespace crackle
