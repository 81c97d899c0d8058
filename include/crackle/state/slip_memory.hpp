// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <vector>

#include "crackle/core/vec2.hpp"

namespace crackle {

/// What a free side in general contact slid in a step, as far as it touches something.
struct SideSlip {
  Index side = -1;        ///< 3 t + i
  Index target = -1;      ///< a side that it touches
  double slid = 0.0;      ///< of the target against it, along the side, past sticking: mean over the side [m]
  double traction = 0.0;  ///< friction, mean over the side [Pa]
  double work = 0.0;      ///< dissipated by friction [J/m]
  double cosine =
      0.0;  ///< between the side and the way it slides: nearly 0 where only an upright's end touches
};

/// An edge of a joint, or a side in general contact, that takes part in a slip event under way.
struct SlipEdge {
  Index edge = -1;                              ///< of the mesh; of a side: edges of the mesh + (3 t + i)
  Index event = -1;                             ///< that it takes part in: the event's first edge names it
  std::array<Index, 2> vertex{-1, -1};          ///< its ends in the mesh
  Index partner = -1;                           ///< number, like edge, of what it touches; -1: nothing else
  Vec2 place, direction;                        ///< middle and direction when it started, current [m]
  double length = 0.0;                          ///< [m]
  double start = 0.0, last = 0.0;               ///< first and last time at which it slid [s]
  double slip_start = 0.0, slip = 0.0;          ///< before it started, and now [m]
  double opening_start = 0.0, opening = 0.0;    ///< [m]
  double traction_start = 0.0, traction = 0.0;  ///< shear, along the direction [Pa]
  double friction_energy = 0.0;                 ///< since it started [J/m]
  double kinetic_start = 0.0;                   ///< of its nodes when it started [J/m]
};

/// Slip events under way.
struct SlipMemory {
  struct Event {
    Index name = -1;            ///< its first edge
    double kinetic_rise = 0.0;  ///< largest rise of its nodes' kinetic energy [J/m]
  };
  std::vector<SlipEdge> edges;  ///< ascending by edge
  std::vector<Event> events;    ///< ascending by name
};

}  // namespace crackle
