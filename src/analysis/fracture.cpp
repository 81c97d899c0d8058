// SPDX-License-Identifier: GPL-3.0-or-later
#include "fracture.hpp"

#include <initializer_list>
#include <numbers>
#include <utility>

namespace crackle {
namespace {

constexpr double pi = std::numbers::pi;

using Named = std::pair<const char*, const std::optional<double>*>;

/// "it needs young_modulus and half_length"; empty if nothing is missing.
std::string missing(std::initializer_list<Named> wanted) {
  std::string names;
  for (const auto& [name, value] : wanted) {
    if (!*value) names += (names.empty() ? "" : ", ") + std::string(name);
  }
  return names.empty() ? "" : "it needs " + names;
}

double stiffness_of(const DfitInputs& in) {
  const double plane_strain = *in.young_modulus / (1.0 - *in.poisson_ratio * *in.poisson_ratio);
  switch (in.geometry) {
    case Geometry::kgd:
      return plane_strain / (pi * *in.half_length);
    case Geometry::pkn:
      return 2.0 * plane_strain / (pi * *in.height);
    case Geometry::radial:
      return 3.0 * pi * plane_strain / (16.0 * *in.half_length);
  }
  return 0.0;
}

}  // namespace

FractureInputs fracture_of(const DfitInputs& in) {
  FractureInputs fracture;
  const bool radial = in.geometry == Geometry::radial, pkn = in.geometry == Geometry::pkn;
  const Named size = pkn ? Named{"height", &in.height} : Named{"half_length", &in.half_length};
  if (in.fracture_stiffness) {
    fracture.stiffness = in.fracture_stiffness;
    fracture.stiffness_from = "given";
  } else {
    fracture.why_no_stiffness =
        missing({{"young_modulus", &in.young_modulus}, {"poisson_ratio", &in.poisson_ratio}, size});
    if (!fracture.why_no_stiffness.empty()) {
      fracture.why_no_stiffness += " (or fracture_stiffness)";
    } else {
      fracture.stiffness = stiffness_of(in);
      fracture.stiffness_from = radial ? "radial" : pkn ? "pkn" : "kgd";
    }
  }
  fracture.why_no_area = radial ? missing({{"half_length", &in.half_length}})
                                : missing({{"half_length", &in.half_length}, {"height", &in.height}});
  if (fracture.why_no_area.empty())
    fracture.area = radial ? pi * *in.half_length * *in.half_length : 2.0 * *in.half_length * *in.height;
  return fracture;
}

}  // namespace crackle
