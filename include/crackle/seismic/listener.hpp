// SPDX-License-Identifier: GPL-3.0-or-later
//
// From broken elements to events. The energy of an event is the largest rise of the kinetic energy
// of the element's four nodes between its first damage and its breaking (Lisjak et al. 2013);
// the magnitude is Gutenberg and Richter's,
//   M = (log10 E − 4.8) / 1.5,  E in J.
// Energies of a 2D model are per metre; `thickness` [m] turns them into joules.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "crackle/seismic/event.hpp"
#include "crackle/state/state.hpp"

namespace crackle {

/// Magnitude of an event that radiates an energy [J]. Energies below 1e-12 J count as that.
double magnitude_of_energy(double energy);

/// Mode of a failure from the share of its dissipation that was done in sliding: below a quarter
/// tensile, above three quarters shear, mixed between.
FailureMode failure_mode(double sliding_share);

/// What turns jumps and energies of the plane into moments and magnitudes.
struct SeismicMedium {
  Lame rock;                                        ///< [Pa]
  double thickness = 1.0;                           ///< out of plane [m]
  std::vector<Lame> layers = {};                    ///< rocks beside it [Pa]
  std::span<const std::uint16_t> of_triangle = {};  ///< 0: rock, 1: the first of layers; empty: rock
  /// Of the rock that a triangle is of.
  const Lame& of(Index triangle) const {
    const std::size_t layer = of_triangle.empty() ? 0 : of_triangle[static_cast<std::size_t>(triangle)];
    return layer == 0 ? rock : layers[layer - 1];
  }
};

/// Events of the elements that broke in this step.
std::vector<SeismicEvent> listen(const State& state, std::span<const Index> broken,
                                 const SeismicMedium& medium);

/// Events of the damaged triangles that failed in this step; each is as long as its area over its element
/// length. @param failed numbers in state.damage
std::vector<SeismicEvent> listen_to_damage(const State& state, std::span<const Index> failed,
                                           const SeismicMedium& medium);

}  // namespace crackle
