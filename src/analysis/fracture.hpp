// SPDX-License-Identifier: GPL-3.0-or-later
// Stiffness and area of the fracture from what is given. Private to analysis.
#pragma once

#include <optional>
#include <string>

#include "crackle/analysis/picks.hpp"

namespace crackle {

struct FractureInputs {
  std::optional<double> stiffness;  ///< S_f [Pa/m]
  std::string stiffness_from;       ///< "given", "kgd", ...
  std::string why_no_stiffness;
  std::optional<double> area;  ///< A, one face of all wings [m2]
  std::string why_no_area;
};

FractureInputs fracture_of(const DfitInputs& inputs);

}  // namespace crackle
