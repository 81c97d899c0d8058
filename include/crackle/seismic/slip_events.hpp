// SPDX-License-Identifier: GPL-3.0-or-later
//
// From joints and faces in general contact that slide to events. An edge takes part in an event from the step
// at which its slip rate reaches start_rate. Edges that share a vertex, or touch, are one event; two events
// that grow together become one. An event ends when none of its edges has slid faster than stop_rate for a
// time `quiet`.
//
//   slip D = Σ L d / Σ L, d from the start of each edge to the end of the event
//   stress drop = Σ L (τ_start − τ_end) sgn d / Σ L
//   dissipated = work of friction;   radiated = max over time of Σ (E_k − E_k at the start of each edge)
//
// The radiated energy is the kinetic-energy window of Lisjak et al. (2013) over all edges that slide, so that
// magnitudes of slips and of breaking compare.
//
// In general contact both faces slide, each for half of what happens: a side's length is half its own, as
// projected on its way, and its slip the mean over it, nothing where it bears nothing. So Σ L d and the
// moment are those of what bears, and Σ L is the area that was swept. Limits: kinetic energy that has left
// the edges' nodes before the maximum is not counted.
//
// | parameter  | unit | meaning                                       |
// |------------|------|-----------------------------------------------|
// | start_rate | m/s  | slip rate that starts an edge                 |
// | stop_rate  | m/s  | slip rate below which it stands; <= start_rate |
// | quiet      | s    | without sliding, after which an event is over |
#pragma once

#include <span>
#include <vector>

#include "crackle/seismic/event.hpp"
#include "crackle/seismic/listener.hpp"
#include "crackle/state/slip_memory.hpp"
#include "crackle/state/state.hpp"

namespace crackle {

struct SlipRule {
  double start_rate = 1e-2;  ///< [m/s]
  double stop_rate = 5e-3;   ///< [m/s]
  double quiet = 0.0;        ///< [s]
};

/// An edge of a joint in one step, or a side in general contact.
struct SlidingEdge {
  Index edge = -1;              ///< number as in SlipEdge
  std::array<Index, 2> vertex;  ///< its ends in the mesh
  Vec2 place, direction;        ///< current; along the edge with face a to its left [m]
  double length = 0.0;          ///< [m]
  double slip_rate = 0.0;       ///< of face b against a, along the direction [m/s]
  double slip = 0.0;            ///< at the end of the step [m]
  double opening = 0.0;         ///< at the end of the step [m]
  double traction = 0.0;        ///< shear, that drives positive slip [Pa]
  double friction_work = 0.0;   ///< dissipated in this step [J/m]
  double kinetic = 0.0;         ///< of its nodes [J/m]
  Index partner = -1;           ///< number, like edge, of what it touches; -1: nothing else
};

/// The clock of a step.
struct StepTime {
  double time = 0.0;  ///< at its end [s]
  double step = 0.0;  ///< its length [s]
};

/// Follows the slip events through one step.
/// @param edges every edge that slides or takes part in an event under way, ascending by edge; others may be
/// among them
/// @return events that ended with this step
/// @throws std::invalid_argument when the edges are not in ascending order
std::vector<SeismicEvent> track_slip(SlipMemory& memory, std::span<const SlidingEdge> edges, StepTime clock,
                                     const SlipRule& rule, const SeismicMedium& medium);

/// What track_slip() has to know of the last step: the edges of joints whose faces slid, and those that take
/// part in an event under way. Faces that have moved past one another are sides in general contact:
std::vector<SlidingEdge> sliding_edges(const State& state);
/// the same of those, each over half its length, for the other half is what it touches. @param slips
/// ascending
std::vector<SlidingEdge> sliding_sides(const State& state, std::span<const SideSlip> slips);

/// Ends every event under way, as a run does.
std::vector<SeismicEvent> finish_slip(SlipMemory& memory, const SeismicMedium& medium);

}  // namespace crackle
