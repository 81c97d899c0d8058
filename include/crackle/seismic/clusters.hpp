// SPDX-License-Identifier: GPL-3.0-or-later
//
// Larger events from small ones: events belong together when one is within a radius and a window of
// time of another (single linkage), as by Hazzard & Young (2000, 2004) for particle models. Moment
// tensors and energies are summed, so that clustering conserves them.
//
// | parameter | unit | meaning                                                                      |
// |-----------|------|------------------------------------------------------------------------------|
// | radius    | m    | between the places of two events; 3 to 5 edges                               |
// | window    | s    | from the end of one to the start of the other; radius over the rupture speed |
#pragma once

#include <vector>

#include "crackle/seismic/event.hpp"

namespace crackle {

struct ClusterRule {
  double radius = 0.0;  ///< [m]
  double window = 0.0;  ///< [s]
};

/// Events that belong together. Extensive quantities are per metre of thickness.
struct Cluster {
  std::vector<Index> events;      ///< indices into the catalog, ascending
  double time = 0.0;              ///< start of the first [s]
  double duration = 0.0;          ///< to the end of the last [s]
  Vec2 place;                     ///< weighted by scalar moment [m]
  double length = 0.0;            ///< of all edges [m]
  double opened = 0.0;            ///< Σ length x opening [m2]
  double slid = 0.0;              ///< Σ length x |slip| [m2]
  double energy = 0.0;            ///< radiated [J/m]
  double dissipated = 0.0;        ///< by breaking and friction [J/m]
  MomentTensor moment;            ///< Σ of the tensors [N m/m]
  double magnitude = 0.0;         ///< of the energy, as for one event
  double moment_magnitude = 0.0;  ///< Mw of the summed tensor
};

/// Clusters in order of their first event in the catalog; every event is in exactly one.
/// @param thickness out of plane [m]
/// @throws std::invalid_argument when the radius or the window is negative or not a number
std::vector<Cluster> cluster_events(const std::vector<SeismicEvent>& events, const ClusterRule& rule,
                                    double thickness);

/// A cluster as one event of a catalog: opening and slip are means over its length, the mode that of its
/// motion, the kind slip if all of it is.
SeismicEvent as_event(const Cluster& cluster, const std::vector<SeismicEvent>& events);

}  // namespace crackle
