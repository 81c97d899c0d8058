// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>

#include "crackle/core/vec2.hpp"
#include "crackle/seismic/moment_tensor.hpp"

namespace crackle {

/// How an edge failed: by the share of the sliding work in all the work it dissipated.
enum class FailureMode : std::int8_t { tensile = 1, shear = 2, mixed = 3 };

std::string to_string(FailureMode mode);

/// What made an event: a cohesive element that broke, or connected edges of joints, or faces in general
/// contact, that slid. In field time a whole snap is one that broke.
enum class EventKind : std::int8_t { breaking = 1, slip = 2 };

std::string to_string(EventKind kind);

/// A microseismic event. Extensive quantities are per metre of thickness.
struct SeismicEvent {
  double time = 0.0;      ///< of breaking, or when the slip started [s]
  double duration = 0.0;  ///< from first damage to breaking, or of the slip [s]
  Vec2 place;             ///< middle of the edge, current; weighted by slip of several edges [m]
  EventKind kind = EventKind::breaking;
  FailureMode mode = FailureMode::tensile;  ///< shear for a slip
  double energy = 0.0;                      ///< kinetic-energy window, radiated [J/m]
  double magnitude = 0.0;                   ///< (log10(energy x thickness / 1 J) - 4.8) / 1.5
  double fracture_energy = 0.0;             ///< dissipated by the edge until it broke [J/m]
  double friction_energy = 0.0;             ///< dissipated by friction during the event [J/m]
  double length = 0.0;                      ///< of all its edges: area per metre of thickness [m]
  double opening = 0.0;           ///< at the middle when it broke; mean over the edges of a slip [m]
  double slip = 0.0;              ///< the same along the edge [m]
  double stress_drop = 0.0;       ///< shear traction at the start less that at the end, mean [Pa]
  MomentTensor moment;            ///< sum over its edges [N m/m]
  double moment_magnitude = 0.0;  ///< Mw of moment x thickness
  Index edge = -1;                ///< of the mesh; the first of a slip
  Index edges = 1;                ///< that took part

  friend bool operator==(const SeismicEvent&, const SeismicEvent&) = default;
};

}  // namespace crackle
