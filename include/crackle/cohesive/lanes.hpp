// SPDX-License-Identifier: GPL-3.0-or-later
//
// Some elements at a time, one a lane: what a law needs of them in rows, so that its loop over the lanes
// vectorises.
#pragma once

#include <array>

#include "crackle/state/state.hpp"

namespace crackle {

struct CohesiveMaterial;

inline constexpr std::size_t element_lanes = 8;

/// A number of each element.
struct alignas(64) LaneRow : std::array<double, element_lanes> {};

/// Elements and their materials. Lanes from `used` on hold none.
struct ElementLanes {
  std::size_t used = 0;
  std::array<const CohesiveMaterial*, element_lanes> material{};
  LaneRow length;                                        ///< in the reference state [m]
  LaneRow penalty, tangential_penalty;                   ///< [Pa]
  LaneRow tensile_strength, cohesion;                    ///< [Pa]
  LaneRow tan_friction, tan_residual;                    ///< [-]
  LaneRow fracture_energy_mode1, fracture_energy_mode2;  ///< [J/m2]
};

/// One integration point of each, rows as in CohesivePoint.
struct PointLanes {
  std::array<CohesivePoint*, element_lanes> point{};  ///< what is in no row is there
  LaneRow opening, slip;                              ///< to which it moves [m]
  LaneRow given;                                      ///< on top of both fracture energies [J/m2]
  LaneRow damage, plastic_slip, normal, shear, friction, stored, path;

  /// Calls visit(row, member of CohesivePoint) for what a law changes.
  template <class Visit>
  void for_each_row(const Visit& visit) {
    visit(damage, &CohesivePoint::damage);
    visit(plastic_slip, &CohesivePoint::plastic_slip);
    visit(normal, &CohesivePoint::normal);
    visit(shear, &CohesivePoint::shear);
    visit(friction, &CohesivePoint::friction);
    visit(stored, &CohesivePoint::stored);
    visit(path, &CohesivePoint::path);
  }
};

}  // namespace crackle
