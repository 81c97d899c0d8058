// SPDX-License-Identifier: GPL-3.0-or-later
//
// The elastic ramp: until the first edge nears its strength the rock is linear and, pumped slowly
// against the transit of waves past the wellbore, in equilibrium at every instant. Its displacement is
// u₀ + (p − p₀) u₁, so two static solves give the pressure, the volume and the time at which the
// dynamics have something to do.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "crackle/cohesive/cohesive.hpp"
#include "crackle/fluid/fluid.hpp"
#include "crackle/solid/bulk.hpp"
#include "crackle/solve/equilibrium.hpp"

namespace crackle {

/// Motion and fluid of one cavity, the wellbore, along the ramp.
class Ramp {
 public:
  struct Point {
    double pressure = 0.0;           ///< [Pa]
    double volume = 0.0;             ///< of the cavity [m2]
    std::vector<Vec2> displacement;  ///< of every vertex [m]
  };

  /// @param first at rest, before pumping @param last where the dynamics take over
  Ramp(Point first, Point last, const CompressibleFluid& fluid);

  /// Pressure [Pa] once a volume [m2, at reference density] has been injected.
  double pressure(double injected) const;
  /// Volume that has to be injected to come to the ramp's end [m2].
  double capacity() const;
  /// Rate of pressure under an injection rate [m2/s], at a pressure: [Pa/s].
  double pressure_rate(double pressure, double injection_rate) const;
  double volume(double pressure) const;  ///< of the cavity [m2]
  Vec2 displacement(Index vertex, double pressure) const;
  /// ∂u/∂p of a vertex [m/Pa].
  Vec2 compliance(Index vertex) const;
  double first_pressure() const { return first_.pressure; }
  double last_pressure() const { return last_.pressure; }

 private:
  double mass(double pressure) const { return fluid_.mass(volume(pressure), pressure); }

  Point first_, last_;
  CompressibleFluid fluid_;
};

/// Lowest pressure [Pa] above the first at which a tied interior edge comes to a share of its strength,
/// when stresses go on as from the first point to the second; nothing if one is there already.
/// @param material of an edge
std::optional<double> onset_pressure(const State& at_rest, const Bulk& bulk,
                                     const std::function<const CohesiveMaterial&(Index edge)>& material,
                                     double share, const Ramp::Point& first, const Ramp::Point& second);

}  // namespace crackle
