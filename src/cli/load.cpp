// SPDX-License-Identifier: GPL-3.0-or-later
#include "load.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "crackle/cohesive/law.hpp"
#include "crackle/core/nearest.hpp"
#include "crackle/core/units.hpp"
#include "crackle/solid/softening.hpp"
#include "frames.hpp"

namespace crackle {

CaseNames registered_names() {
  CaseNames names;
  for (const auto& law : registered_laws()) names.more["cohesive.law"].push_back(law->name());
  for (const auto& law : registered_softening()) names.more["damage.law"].push_back(law->name());
  return names;
}

Case load_case(const std::string& file, std::vector<std::string> overrides, std::optional<std::string> seed) {
  if (seed) overrides.push_back(fmt::format("mesh.seed={}", *seed));
  Case scene = read_case(file, overrides, registered_names());
  for (const std::string& name : scene.output.fields) {
    if (std::find(field_names().begin(), field_names().end(), name) == field_names().end()) {
      const std::vector<std::string_view> known(field_names().begin(), field_names().end());
      throw CaseError(file, 0, 0,
                      fmt::format("output.fields: there is no field \"{}\"; did you mean \"{}\"? (known: {})",
                                  name, nearest(name, known), fmt::join(known, ", ")));
    }
  }
  return scene;
}

double quantity(const std::string& option, const std::string& text, std::string_view unit) {
  double value = 0.0;
  const char* end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc{} || rest != end) {
    try {
      value = Units().convert(text, unit);
    } catch (const UnitError& reason) {
      throw CaseError(fmt::format("{}: {}", option, reason.what()));
    }
  }
  if (!std::isfinite(value)) throw CaseError(fmt::format("{}: {} is not a finite number", option, text));
  return value;
}

CaseError unknown_name(const std::string& what, const std::string& name,
                       const std::vector<std::string>& known) {
  std::vector<std::string_view> candidates;
  for (const std::string& k : known) {
    if (!name.empty() && k.starts_with(name)) candidates.push_back(k);
  }
  if (candidates.empty()) candidates.assign(known.begin(), known.end());
  return CaseError(
      fmt::format("there is no {} \"{}\"; did you mean \"{}\"?", what, name, nearest(name, candidates)));
}

}  // namespace crackle
