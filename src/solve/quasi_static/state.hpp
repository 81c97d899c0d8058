// SPDX-License-Identifier: GPL-3.0-or-later
// What changes during a quasi-static run. A step works on a copy; taking it back is dropping the copy.
#pragma once

#include <array>
#include <limits>
#include <vector>

#include "crackle/core/vec2.hpp"
#include "crackle/fluid/leak_off.hpp"

namespace crackle::quasi_static {

/// An end of a path edge.
struct Point {
  double max_opening = 0.0;  // [m]
  double in_situ = 0.0;      // effective normal traction of the intact rock [Pa]
};

/// A path edge: two points, and a cell for fluid.
struct Cell {
  std::array<Point, 2> points;
  bool wet = false;
  double pressure = 0.0;  // [Pa]
  double mass = 0.0;      // over reference density [m2]
  // Since when it leaks off [s]: half damaged, where an ideal fracture would have its tip.
  double exposed = std::numeric_limits<double>::infinity();
  double leaked = 0.0;  // both faces [m2]
  MatrixDiffusion::Profile matrix;
};

struct Inlet {
  Index cell = -1;
  double rate = 0.0;  // [m2/s]
};

struct Tip {
  Index wing = -1;
  Index cell = -1;  // the last one
};

struct State {
  double time = 0.0;
  std::vector<double> jumps;  // [m]
  std::vector<Cell> cells;
  std::vector<Inlet> inlets;
  std::vector<Tip> tips;
  double well_pressure = 0.0;  // [Pa]
  double well_before = 0.0;    // at the beginning of the step [Pa]
  bool connected = true;       // the well with the fracture
  double breakdown_time = -std::numeric_limits<double>::infinity();
  double injected = 0.0, leaked = 0.0;  // [m2]
};

}  // namespace crackle::quasi_static
