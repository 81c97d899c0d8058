// SPDX-License-Identifier: GPL-3.0-or-later
// What [[layers]] need, and what they take from [rock] and [stress].
#include <cmath>
#include <numbers>

#include "case_row.hpp"
#include "case_schema.hpp"

namespace crackle {
namespace {

void copy_value(const Slot& from, const Slot& to, Case& scene, std::size_t row) {
  std::visit(
      [&](auto source) {
        if constexpr (!std::is_same_v<decltype(source), std::monostate>)
          std::get<decltype(source)>(to)(scene, row) = source(scene, 0);
      },
      from);
}

/// Whether two layers have an interface in common.
bool meet(const Case::Layer& a, const Case::Layer& b) {
  if (std::abs(std::remainder(a.dip - b.dip, std::numbers::pi)) > 1e-9) return false;
  const double sign = std::cos(a.dip - b.dip) > 0.0 ? 1.0 : -1.0;
  for (const auto& one : {a.bottom, a.top}) {
    for (const auto& other : {b.bottom, b.top}) {
      if (one && other && std::abs(*one - sign * *other) < 1e-9 * (std::abs(*one) + 1e-3)) return true;
    }
  }
  return false;
}

void finish_interface(Case::Layer& layer, const Row& row, const Case& scene) {
  if (layer.interface.law == "perfect") {
    row.refuse({"residual_friction_angle", "normal_penalty", "tangential_penalty", "tensile_strength",
                "cohesion", "friction_angle", "fracture_energy_mode1", "fracture_energy_mode2"},
               "the interface is perfect; write interface = \"bonded\" or \"frictional\"");
    return;
  }
  finish_properties(layer.interface, row, scene);
}

}  // namespace

void inherit_rock(ReadCase& read) {
  Case& scene = read.scene;
  const TableSpec& table = *find_table("layers");
  for (std::size_t i = 0; i < scene.layers.size(); ++i) {
    const Row row(read.given, "layers", i);
    for (const KeySpec& key : table.keys) {
      if (row.has(key.key)) continue;
      const bool stress = key.key.starts_with("stress_");
      const KeySpec* same = stress ? find_key(*find_table("stress"), key.key.substr(7))
                                   : find_key(*find_table("rock"), key.key);
      if (same != nullptr) copy_value(same->slot, key.slot, scene, i);
    }
  }
}

void finish_layers(ReadCase& read) {
  Case& scene = read.scene;
  for (std::size_t i = 0; i < scene.layers.size(); ++i) {
    const Row row(read.given, "layers", i);
    Case::Layer& layer = scene.layers[i];
    if (!layer.bottom && !layer.top) {
      fail(row.place("bottom"),
           fmt::format("layers.{} has neither bottom nor top: it would be all there is, which is [rock]", i));
    }
    if (layer.bottom && layer.top && *layer.bottom >= *layer.top) {
      fail(row.place("top"),
           fmt::format("layers.{}: bottom = {} m is not below top = {} m", i, *layer.bottom, *layer.top));
    }
    finish_interface(layer, Row(read.given, "layers", i, "interface_"), scene);
    for (std::size_t k = 0; k < i; ++k) {
      const Case::Layer& other = scene.layers[k];
      if (layer.interface.law == "perfect" || other.interface.law == "perfect" || !meet(layer, other))
        continue;
      fail(row.place("interface"),
           fmt::format(
               "layers.{} and layers.{} both say how the interface between them bears: leave it to one", k,
               i));
    }
  }
}

}  // namespace crackle
