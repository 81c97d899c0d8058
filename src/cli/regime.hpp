// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a run takes where its case leaves it open: no more than the scene needs, by numbers that it prints.
//   dynamic or quasi-static   end_time c_s / L;  v / c_R with v = E'Q/(3 √π K √a), the speed at which a notch
//   a
//                             grows at the toughness vertex (validation D5);  √(C_w E'/(6π)) / a: above 1 the
//                             fluid stored in the well makes the first growth snap
//   uniform or viscous flow   K_m = K'/(12 μ E'³ Q)^¼; uniform from 4.8 on (Dontsov 2017), printed
//   leak-off                  share of the injected volume that would leak: 8 C_L a √t / V; none below 1 %,
//                             Carter while pumping, diffusion where a fall-off follows
#pragma once

#include <string>
#include <vector>

#include "crackle/io/case.hpp"

namespace crackle {

struct RegimeChoice {
  bool quasi_static = false;
  std::vector<std::string> reasons;  ///< with the numbers, a line each
  Case scene;                        ///< nothing left open
};

/// @throws CaseError when the quasi-static regime is asked for and cannot be
RegimeChoice choose_regime(const Case& scene);

/// Of a case that choose_regime() has gone through.
inline bool in_field_time(const Case& scene) { return scene.run.regime == "quasi_static"; }

/// A path along x; else one that is free.
bool is_straight(const Case& scene);

/// A wellbore in the mesh, whose wall bears the pressure of the well.
inline bool is_bored(const Case& scene) { return scene.wellbore.diameter > 0.0; }

/// A straight path without a wellbore: half of the domain on a grid. Else all of it, with the mesh of the
/// dynamic regime.
inline bool on_half_grid(const Case& scene) { return is_straight(scene) && !is_bored(scene); }

/// Where the fracture ends at first, from the origin [m].
double first_half_length(const Case& scene);

/// Effective far-field compression that a fracture opens against: across it, or the least [Pa].
double confinement(const Case& scene);

/// Throws CaseError where something does not hold that the quasi-static regime needs.
void require_quasi_static(bool holds, const Case& scene, const std::string& what);

}  // namespace crackle
