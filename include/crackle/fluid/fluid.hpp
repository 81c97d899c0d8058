// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "crackle/fluid/compressible.hpp"
#include "crackle/fluid/pump.hpp"
#include "crackle/fluid/viscous_flow.hpp"
#include "crackle/state/state.hpp"

namespace crackle {

/// Fluid in the wellbore and in the broken elements connected to it, at one pressure per cavity
/// (no flow resistance): AbuAisha et al. (2016), section 6.2.2.
///
/// The wetted boundary is a set of closed loops of corners. Between two wetted sides that meet at a
/// vertex the loop goes straight from corner to corner, so that it is closed exactly; its area by
/// Green's theorem (Eq. 6.5) is the cavity's volume and the gradient of that area, times the
/// pressure, the force on the nodes: work and energy match to round-off.
///
/// Where the rock breaks by smeared damage the fluid is in triangles that failed, or in damaged ones: by how
/// much their area has grown is its volume there, and its pressure acts all round inside them, beside what
/// stress they bear.
class Fluid {
 public:
  Fluid(const State& state, const CompressibleFluid& fluid, Pump pump);

  const CompressibleFluid& properties() const { return fluid_; }
  const Pump& pump() const { return pump_; }

  /// From now on pressure falls along the fractures by the fluid's viscosity. What the cavities hold is
  /// spread at their pressures; a state that has cells goes on with them.
  void flow(State& state, FlowChoice choice);
  /// Pressure in a wet edge [Pa].
  double pressure(const State& state, Index edge) const;

  /// Makes a cavity of mesh edges (boundary edges, or elements cut beforehand), filled with fluid at
  /// the given pressure [Pa]. @return its number
  Index fill(State& state, std::span<const Index> edges, double pressure);

  /// From now on every cavity keeps this pressure [Pa], whatever its volume is (the geostatic stage); none:
  /// it follows from mass and volume.
  void hold(std::optional<double> pressure) { held_ = pressure; }

  /// Sets every cavity to the mass that fills its present volume at a pressure [Pa].
  void refill(State& state, double pressure);

  /// Lets the fluid into newly broken elements that touch a cavity, and on from there into broken
  /// elements it had not reached. Cavities that come together become one; mass is conserved. The
  /// energy that free expansion into them costs is booked as viscous dissipation.
  /// @param broken elements that broke in this step
  void connect(State& state, std::span<const Index> broken);

  /// The same for damaged triangles: the fluid enters those that share a vertex with a cavity.
  /// From elements it goes on into triangles, and from triangles into elements.
  /// @param damaged numbers of triangles in state.damage
  void connect_triangles(State& state, std::span<const Index> damaged);

  /// From now on an edge of a joint of the mesh is entered only once its faces are apart; else a fracture
  /// that reaches a joint without cohesion wets the whole of it, and those that cross it, at once.
  void enter_joints_as_they_open() { joints_as_they_open_ = true; }
  /// Dry elements of joints that have opened next to a cavity: to connect().
  std::vector<Index> opened_joints(const State& state) const;

  /// Dry elements next to a cavity that have begun to open, broken or not: to connect(), where the fluid
  /// does not wait until they break.
  std::vector<Index> damaged_ahead(const State& state) const;
  /// The same for damaged triangles, as numbers in state.damage: to connect_triangles().
  std::vector<Index> damaged_triangles_ahead(const State& state) const;

  /// One step, after the rock has moved without the fluid (v*, x*): pumps, finds the pressure that
  /// fits the volume with it, and moves the wetted nodes on:
  ///   V(x*) + Δt² s p = (m/ρ₀) exp(−(p − p₀)/K_f),  s = Σ |∂V/∂x_i|² / m_i
  ///   v = v* + Δt p ∂V/∂x / m,  x = x* + Δt² p ∂V/∂x / m
  /// Stable at the dry step for any K_f. A soft cavity, (ω_f Δt)² = Δt² s K_f/V below 0.1, is pushed by
  /// the pressure at the step's beginning, which conserves energy; from 0.3 on by that at its end. @throws
  /// NumericalError on a cavity without volume.
  void advance(State& state, double dt);

  /// Rebuilds what is derived from the state (after a resume).
  void rebuild(const State& state);

  double energy(const State& state) const;  ///< [J/m]
  /// Viscous dissipation of the last step that comes after its beginning, when energies are taken stock of
  /// [J/m].
  double lost_ahead() const { return flow_ ? flow_->lost_ahead() : 0.0; }
  /// Volume of a cavity when last measured, after rebuild() or advance() [m2].
  double volume(Index cavity) const { return volume_[static_cast<std::size_t>(cavity)]; }
  double wetted_length(const State& state) const;  ///< of wetted fractures, one side [m]
  /// Wall force on a corner [N/m].
  struct CornerLoad {
    Index corner;
    Vec2 force;
  };
  /// Wall forces of the present pressures, in order of corner; a corner on two loops has two.
  std::vector<CornerLoad> corner_loads(const State& state) const;
  /// The same, added to `forces` per corner (for the static stage).
  void add_corner_forces(const State& state, std::span<Vec2> forces) const;

  /// Closed loops of one cavity, as corners in order round the fluid.
  struct Loop {
    Index cavity = -1;
    std::vector<Index> corners;
  };
  const std::vector<Loop>& loops() const { return loops_; }
  /// A fracture has come to the outer boundary: the fluid would leave the model there.
  bool leaks() const { return leaks_; }

 private:
  struct Wet {  // a node on a loop with the gradient of its cavity's volume
    Index node;
    Index cavity;
    Vec2 gradient;
  };
  bool waits(const State& state, Index edge) const;
  struct Reached {  // to be wetted, in order found
    std::vector<Index> edges;
    std::vector<Index> triangles;  // numbers in state.damage
  };
  void wet(State& state, Reached reached);
  Index reach(State& state, std::span<const Index> vertices, Reached& reached) const;
  void enter(State& state, Index cavity, Index other) const;
  struct Spread {  // what the fluid held and did before it spread
    double energy, power;
  };
  Spread before_spread(const State& state);
  void spread(State& state, const Spread& before);
  void measure(const State& state);
  double measured_energy(const State& state) const;  // at the volumes last measured
  double measured_power(const State& state) const;   // on the rock, at present velocities [W/m]

  CompressibleFluid fluid_;
  Pump pump_;
  std::vector<Index> edges_of_vertex_first_, edges_of_vertex_;  // vertex -> edges
  std::vector<Loop> loops_;
  std::vector<std::vector<Index>> slots_;  // per loop: slot of each corner's node in wet_
  std::vector<Wet> wet_;
  std::vector<double> rock_;                        // per cavity: area of wet triangles at rest [m2]
  std::vector<double> volume_, compliance_, push_;  // per cavity: V(x), s, pressure that pushes
  std::optional<ViscousFlow> flow_;
  std::optional<double> held_;
  bool leaks_ = false;
  bool joints_as_they_open_ = false;
};

}  // namespace crackle
