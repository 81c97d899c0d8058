// SPDX-License-Identifier: GPL-3.0-or-later
//
// Guards of a run. An explicit run that has become unstable seldom ends in infinities: it shatters the
// mesh while its ledger still closes. It shows before, in
//   made energy       cohesive elements gave back more than they had taken: a warning from 2 % of
//                     what broke and rubbed, a stop from 20 %
//   given energy      elements inserted under load that broke before paying that back, and laws without
//                     potential, gave more than 5 % of what broke and rubbed (a warning)
//   grid oscillation  ½ Σ m v(n−½)·v(n+½) below −10 % of the largest energy: velocities change sign from step
//                     to step, as at the highest frequency of the mesh and above
//   stray break       an element breaks that touches no fracture, cohesive zone or free face, in rock that
//   bears
//                     less than half its strength (mean over the triangles round it); five, and 2 % of the
//                     broken
//   large motion      a node moves by more than 2 % of an edge of its triangle in one step
//   crushed triangle  one with less than a fifth of its area left
//   energy residual   of the ledger: a warning from 1e-3, a stop from 1e-2
//   shaking           more than half of the pump's work in motion before anything has broken (a warning)
// src/cli/run.cpp asks after every step and stops the run, or with --allow-unstable says so and goes on.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "crackle/solve/simulation.hpp"

namespace crackle {

enum class Alarm : std::uint8_t {
  made_energy,
  grid_oscillation,
  stray_breaks,
  large_motion,
  crushed_triangle,
  energy_residual,
  shaking,
  given_energy,
};

struct Finding {
  Alarm alarm = Alarm::made_energy;
  bool stops = true;  ///< else a warning
  std::string text;   ///< one line: what, which element, where, step, time, likely cause, what to do
};

/// What the guards keep of a run; goes into a checkpoint.
struct GuardMemory {
  std::int64_t alarms = 0;      ///< found so far, of those that stop a run
  std::int64_t raised = 0;      ///< bit per Alarm, + 16 for the warnings: said already
  std::int64_t broken = 0;      ///< elements, since the dynamics began
  std::int64_t stray = 0;       ///< of them, away from any fracture in rock that bore little
  double largest_energy = 0.0;  ///< so far [J/m]
};

/// Looks at a simulation; changes nothing. Per step it costs what broke in it, and every 32 steps a pass over
/// the velocities.
class Guards {
 public:
  explicit Guards(const Simulation& simulation, const GuardMemory& memory = {});

  /// After Simulation::step(): what is found for the first time.
  std::vector<Finding> after_step(const Simulation& simulation);
  /// After Simulation::step_and_account(), with its energies.
  std::vector<Finding> after_step(const Simulation& simulation, const Energies& energies);

  const GuardMemory& memory() const { return memory_; }

 private:
  void look_at_breaks(const Simulation& simulation, std::vector<Finding>& found);
  void look_at_motion(const Simulation& simulation, std::vector<Finding>& found);
  void raise(std::vector<Finding>& found, Alarm alarm, bool stops, const std::string& text);

  GuardMemory memory_;
  double shortest_ = 0.0;      // edge [m]
  double least_energy_ = 0.0;  // of strains of 3e-7 everywhere [J/m]
};

}  // namespace crackle
