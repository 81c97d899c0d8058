// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "crackle/contact/general_contact.hpp"
#include "depth.hpp"
#include "free_sides.hpp"
#include "release.hpp"

namespace crackle {

/// Contacts found for a range of sides.
struct Touches {
  std::vector<ContactPoint> points;
  std::vector<SideForce> forces;
  std::vector<SideSlip> slips;  ///< of sides with friction
  double friction = 0.0;        ///< dissipated by friction, and by contacts lost under load [J/m]
  double taken_over = 0.0;      ///< stored in points that a released pair handed over now [J/m]
};

/// Points in the order in which the state keeps them.
bool comes_first(const ContactPoint& a, const ContactPoint& b);

/// Length of a side as meshed [m].
double side_length(const State& state, Index corner);

/// Recoverable energy of a point on a side of that length [J/m].
double energy(const ContactMaterial& material, double length, const ContactPoint& point);

/// A point that goes on bearing what it bore as part of a pair. Marked by a depth without a place:
/// touch() finds where it lies and sets the offset so that it bears the same.
ContactPoint take_over(const ContactMaterial& material, double length, const BornTraction& born, Index side,
                       Index place, Index target);

/// Finds what the three points of free side `s` touch. @param known its points in contact so far
/// @param first_look sides are new since the last step: what lies behind one now may have done so before
void touch(const State& state, const ContactMaterial& material, const FreeSides& sides,
           const std::vector<PlacedSide>& placed, Index s, std::span<const Index> targets,
           std::span<const ContactPoint> known, bool first_look, Touches& touches);

}  // namespace crackle
