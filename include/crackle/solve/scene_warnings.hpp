// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "crackle/solve/estimates.hpp"
#include "crackle/solve/simulation.hpp"

namespace crackle {

/// What a scene asks for that the model does not give, and what is odd about it: a line each, that
/// says what, how much and what to do. "warning: " where results are off, "note: " where they are as
/// they should be but perhaps not as expected. `crackle run` and `crackle check` print them.
/// @param stable of the scene's mesh
std::vector<std::string> scene_warnings(const Scene& scene, double end_time, const StableStep& stable);

/// Why the scene cannot be run: an edge so long that its cohesive element would release more than
/// the fracture energy before softening. Empty if it can.
std::string scene_error(const Scene& scene);

/// What theory says of the wellbore under the pump: when its wall breaks.
struct Onset {
  bool expected = false;       ///< there is a wellbore, fluid and a pump
  double wall_pressure = 0.0;  ///< at which the wall breaks (Hubbert-Willis) [Pa]
  double end_pressure = 0.0;   ///< an elastic wellbore would reach by the end [Pa]
  double time = 0.0;           ///< the wall pressure is reached [s]; infinity: not by the end
};
Onset expected_onset(const Scene& scene, double end_time);

}  // namespace crackle
