// SPDX-License-Identifier: GPL-3.0-or-later
//
// What changes during a quasi-static run: all that a checkpoint saves. A step works on a copy; taking it
// back is dropping the copy.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "crackle/core/vec2.hpp"

namespace crackle::quasi_static {

/// An end of a path edge.
struct Point {
  double max_opening = 0.0;    ///< [m]
  double in_situ = 0.0;        ///< effective normal traction of the intact rock [Pa]
  double in_situ_shear = 0.0;  ///< and along the edge [Pa]
  double bond = 0.0;           ///< traction of the bond without opening [Pa]: of the rock when it joined
  double bond_shear = 0.0;     ///< [Pa]
  double plastic_slip = 0.0;   ///< [m]
};

/// An edge of the path: two points, and a cell for fluid.
struct Cell {
  Index edge = -1;    ///< of the mesh
  Index inner = -1;   ///< vertex that it was reached at
  Index parent = -1;  ///< cell that it was reached from; -1: the well, -2: of a joint
  Vec2 along;         ///< piece of a smooth fracture that it stands for [m]; zero: the edge itself
  std::array<Point, 2> points;
  std::uint8_t wet = 0;
  double pressure = 0.0;  ///< [Pa]
  double mass = 0.0;      ///< over reference density [m2]; of a dry cell: that its source has pushed in
  /// Since when it leaks off [s]: when an elastic crack's tip would have passed its inner end.
  double exposed = std::numeric_limits<double>::infinity();
  double sweep = 0.0;   ///< how long that tip takes to its outer end [s]
  double leaked = 0.0;  ///< both faces [m2]
};

struct Inlet {
  Index cell = -1;
  double rate = 0.0;  ///< [m2/s]
};

struct Tip {
  Index wing = -1;
  Index cell = -1;  ///< the last one
  Vec2 place;       ///< outer end of the smooth fracture [m]
  /// When it took its last edge [s].
  double since = -std::numeric_limits<double>::infinity();
};

/// Energies since the start [J/m], fluid's relative to pore pressure (ledger.hpp in src).
struct Energies {
  double pumped = 0.0;       ///< work of the pump
  double well = 0.0;         ///< kept by the compressed well
  double entry = 0.0;        ///< lost between well and fracture
  double viscous = 0.0;      ///< lost by flow in the fracture
  double leaked = 0.0;       ///< taken along by what leaked off
  double fluid = 0.0;        ///< kept by the compressed fluid in the fracture
  double strain = 0.0;       ///< kept by the rock, beyond the in-situ state
  double confinement = 0.0;  ///< work against the in-situ stress
  double faces = 0.0;        ///< kept by bonds and asperities
  double fracture = 0.0;     ///< dissipated by fracture
  double friction = 0.0;     ///< dissipated by friction of closed faces
  double radiated = 0.0;     ///< of motion where the fracture snapped: kinetic, and damped
  double residual = 0.0;     ///< what does not add up, over the work of the pump [-]
};

/// What the faces of a path edge have done.
struct Faces {
  double opening = 0.0;  ///< at the middle [m]
  double slip = 0.0;     ///< [m]
  double damaged = 0.0;  ///< length [m]
};

/// Of the rock where the fracture snaps (dynamics.hpp in src); at rest, what is known of the last one.
struct Motion {
  std::vector<Vec2> place;     ///< displacement of every corner of every triangle [m]; empty: at rest
  std::vector<Vec2> velocity;  ///< half a step before the time [m/s]
  double begin = 0.0;          ///< [s]
  double tried = 0.0;          ///< step for which there was no equilibrium [s]
  double length = 0.0;         ///< damaged before [m]
  double radiated = 0.0;       ///< before [J/m]
  double fracture = 0.0;       ///< before [J/m]
  double friction = 0.0;       ///< before [J/m]
  std::vector<Faces> faces;    ///< of the cells before
  double damped = 0.0;         ///< since the beginning [J/m]
  double kinetic = 0.0;        ///< now [J/m]
  std::int64_t steps = 0;      ///< since the beginning
  bool moves() const { return !place.empty(); }
};

struct State {
  double time = 0.0;           ///< [s]
  double step = 0.0;           ///< longest next [s]
  double event = 0.0;          ///< when the schedule last changed [s]
  std::vector<double> jumps;   ///< [m]
  std::vector<Cell> cells;     ///< in the order in which they joined
  std::vector<double> matrix;  ///< pressures in the rock beside the cells, one profile after the other [Pa]
  std::vector<Inlet> inlets;
  std::vector<Tip> tips;
  double well_pressure = 0.0;  ///< [Pa]
  double well_before = 0.0;    ///< at the beginning of the step [Pa]
  double bore = 0.0;           ///< fluid in the wellbore, where it is in the mesh [m2]
  std::uint8_t connected = 1;  ///< the well with the fracture
  double breakdown_time = -std::numeric_limits<double>::infinity();
  double injected = 0.0, leaked = 0.0;                ///< [m2]
  double initial_fracture = 0.0, initial_well = 0.0;  ///< fluid [m2], pressure [Pa]
  double initial_bore = 0.0;                          ///< fluid [m2]
  Energies energies;
  Energies initial;                           ///< what the initial state keeps
  std::int64_t rejected = 0, iterations = 0;  ///< steps taken back; of Newton
  Motion motion;
};

}  // namespace crackle::quasi_static
