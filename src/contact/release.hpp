// SPDX-License-Identifier: GPL-3.0-or-later
//
// When a broken element's faces are no longer a pair: its middle has slipped by more than half its
// length or opened by more than its length, or the faces have turned against one another by more
// than 10 degrees (methods.md 1.4).
#pragma once

#include <array>

#include "crackle/state/state.hpp"

namespace crackle {

/// What one point of a face bore as part of a pair.
struct BornTraction {
  double pressure = 0.0;  ///< across [Pa], compression positive
  double friction = 0.0;  ///< along [Pa]
};

/// True if the faces of a broken element have parted.
bool has_parted(const State& state, Index element);

/// What the three points (start, end, middle) of a face of a broken element bear.
std::array<BornTraction, 3> born_by_face(const State& state, Index element, bool face_b);

/// Makes a broken element a released one: its force and its recoverable energy are no longer its own.
/// @return that energy [J/m]
double release(State& state, Index element);

}  // namespace crackle
