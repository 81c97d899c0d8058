// SPDX-License-Identifier: GPL-3.0-or-later
//
// A well in field time: one pressure, with storage, and what is lost between it and the fracture.
//   C_w dp_w/dt = Q − Σ q
//   p_w − p = Z q + k_perf q |q| + k_tort q/√|q|
// Z = ρ c / A is the acoustic impedance of the casing: it bounds the rate right after breakdown, when
// the well empties faster than waves run along it. It acts for `impedance_time` (2 L/c) after breakdown.
// Storage is that of what the mesh does not have: the fluid in a wellbore of the mesh comes on top.
// All per metre of thickness: divide the storage of a well, and multiply Z, by the fracture's height.
//
// | parameter         | unit        | range | meaning                                        |
// |-------------------|-------------|-------|------------------------------------------------|
// | storage           | m2/Pa       | ≥ 0   | C_w = V c over the height                      |
// | impedance         | Pa s/m2     | ≥ 0   | Z                                              |
// | impedance_time    | s           | ≥ 0   |                                                |
// | perforation       | Pa s2/m4    | ≥ 0   | k_perf, quadratic                              |
// | tortuosity        | Pa (s/m2)^½ | ≥ 0   | k_tort                                         |
// | breakdown_pressure| Pa          | any   | below it the notch is shut off from the well   |
#pragma once

#include <cmath>
#include <optional>

#include "crackle/fluid/fracture_flow.hpp"

namespace crackle {

struct Well {
  double storage = 0.0;
  double impedance = 0.0;
  double impedance_time = 0.0;
  double perforation = 0.0;
  double tortuosity = 0.0;
  std::optional<double> breakdown_pressure;

  /// Pressure lost [Pa] at a rate [m2/s] into one wing. @param since breakdown [s]
  ValueSlope loss(double rate, double since) const {
    ValueSlope lost{perforation * rate * std::abs(rate), 2.0 * perforation * std::abs(rate)};
    if (since < impedance_time) {
      lost.value += impedance * rate;
      lost.slope += impedance;
    }
    if (tortuosity > 0.0) {  // smooth where the rate turns round
      constexpr double least = 1e-9;
      const double r2 = rate * rate + least * least;
      lost.value += tortuosity * rate / std::pow(r2, 0.25);
      lost.slope += tortuosity * (std::pow(r2, -0.25) - 0.5 * rate * rate * std::pow(r2, -1.25));
    }
    return lost;
  }
};

}  // namespace crackle
