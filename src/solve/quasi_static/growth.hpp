// SPDX-License-Identifier: GPL-3.0-or-later
// Where a fracture goes that no path is laid down for.
#pragma once

#include "newton.hpp"

namespace crackle::quasi_static {

struct NextEdge {
  Index edge = -1;  ///< of the mesh
  Vec2 along;       ///< piece of the smooth fracture that it stands for [m]
};

/// The mesh edge that a free wing takes next. The fracture is a smooth one: it goes on across the largest
/// principal stress, the mean of the triangles ahead of the tip that are at most two edges off (by area;
/// Wells and Sluys 2001 take such a mean). Of the edges at the tip the one that leads nearest to that line
/// stands for it, with its direction and the length it covers of it: a zigzag of mesh edges costs no more
/// energy, and under a deviatoric stress pinches no more, than the fracture meant.
/// The edge of a joint that holds is the fracture's own way only where it leads along that line: else it is a
/// way of its own beside it. The rock has to have followed the path.
/// @throws NumericalError at the boundary of the domain
NextEdge choose_edge(const Equations& equations, const State& state, const Tip& tip);

/// The edge in which a wing that is in a joint that holds goes on; none at the joint's end.
NextEdge next_in_joint(const Equations& equations, const Tip& tip);

/// Edges of joints that hold at a vertex that the fracture has come to, which it has not taken yet.
std::vector<Index> joints_met(const Equations& equations, Index vertex);

/// Lets the points whose jumps have joined the path, from number `first` on, bear what holds the rock
/// together there now, at the pressure that has come to act on them: nothing moves. Beyond their strength
/// they bear that. The rock has to have followed the path.
void take_over(const Equations& equations, State& state, std::size_t first);

}  // namespace crackle::quasi_static
