// SPDX-License-Identifier: GPL-3.0-or-later
// One implicit step on a given path: Newton on jumps, pressures of wet cells, rates of inlets, and the
// pressure of the well. The fluid's unknowns are eliminated first (sparse), the jumps solved for (dense);
// in motion, where the rock does not couple the jumps of different vertices, all at once (sparse).
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "crackle/cohesive/interface.hpp"
#include "crackle/solve/condensation.hpp"
#include "crackle/solve/quasi_static.hpp"
#include "crackle/solve/quasi_static_state.hpp"

namespace crackle::quasi_static {

class Dynamics;

/// All that the equations need beside the state.
struct Equations {
  const QuasiStaticScene& scene;
  const Bulk& bulk;
  const FracturePath& path;
  const Condensation& rock;
  const std::vector<InterfaceLaw>& laws;  // one per path edge
  const std::optional<MatrixDiffusion>& matrix;
  double bore = 0.0;           // volume of the wellbore in the mesh as it is drilled [m2]; 0: none
  Dynamics* moving = nullptr;  // while the rock is in motion: stands for the condensed rock
};

/// Opening [m] at the two ends of a path edge, and slip.
std::array<double, 2> openings(const PathEdge& edge, const std::vector<double>& jumps);
std::array<double, 2> slips(const PathEdge& edge, const std::vector<double>& jumps);

/// Tractions of bonds and asperities at an end of a path edge [Pa]; without slip those of a straight path.
MixedTraction traction_at(const Equations& equations, const State& state, std::size_t cell, std::size_t end);

/// Pressure on the faces of a path edge [Pa]: of its own cell, or as the wetting rule says.
/// @return the cell that gives it, -1: the pore pressure
Index pressure_source(const Equations& equations, const State& state, Index cell);

/// Pressures in the rock beside a cell [Pa]; empty without diffusion.
std::span<const double> profile(const Equations& equations, const State& state, Index cell);

/// Volume [m2] that leaks from a cell in a step, and its derivative by the pressure [m2/Pa].
ValueSlope leak(const Equations& equations, const State& state, Index cell, double pressure, double dt);

struct NewtonResult {
  bool converged = false;
  int iterations = 0;
};

/// Moves jumps, pressures and rates of `state` (whose histories and masses are those at the beginning
/// of the step) to the end of a step of length dt [s] with a mean pump rate [m2/s].
/// dt = 0: equilibrium at the given pressures.
NewtonResult solve(const Equations& equations, State& state, double dt, double rate);

/// Forces [N/m] of faces and the fluid in them on every unknown.
std::vector<double> face_forces(const Equations& equations, const State& state);

}  // namespace crackle::quasi_static
