// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>

#include "crackle/core/vec2.hpp"

namespace crackle {

/// How an edge failed: by the share of the sliding work in all the work it dissipated.
enum class FailureMode : std::int8_t { tensile = 1, shear = 2, mixed = 3 };

std::string to_string(FailureMode mode);

/// A microseismic event: one broken cohesive element.
struct SeismicEvent {
  double time = 0.0;  ///< of breaking [s]
  Vec2 place;         ///< middle of the edge, current [m]
  FailureMode mode = FailureMode::tensile;
  double energy = 0.0;           ///< kinetic-energy window, per metre of thickness [J/m]
  double magnitude = 0.0;        ///< (log10(energy x thickness / 1 J) - 4.8) / 1.5
  double fracture_energy = 0.0;  ///< dissipated by the edge until it broke [J/m]
  double length = 0.0;           ///< of the edge [m]
  double opening = 0.0;          ///< at the middle when it broke [m]
  double slip = 0.0;             ///< at the middle when it broke [m]
  Index edge = -1;               ///< of the mesh
};

}  // namespace crackle
