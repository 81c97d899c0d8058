// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <vector>

#include "crackle/state/state.hpp"

namespace crackle {

/// A side of a triangle that is not tied to another: on a boundary, or a face of a broken element.
struct FreeSide {
  Index corner = -1;                  ///< 3 t + i
  std::array<Index, 2> node{-1, -1};  ///< at its start and end
  Index element = -1;                 ///< cohesive element it is a face of; -1: on a boundary
  bool face_b = false;
  bool matched = false;     ///< a face that still lies opposite its partner
  bool taken_over = false;  ///< a face of an element released just now
  Index previous = -1;      ///< free sides before and after it along the surface of its body
  Index next = -1;
  double angle_at_end = 0.0;   ///< of the rock between this side and the next, as meshed [rad]
  double radius_at_end = 0.0;  ///< of the convex corner there [m]; 0: sharp or flat
  double length = 0.0;         ///< as meshed [m]
  double reach = 0.0;          ///< depth up to which a point behind it is seen [m]
};

/// A free side's ends in their current places [m].
struct PlacedSide {
  Vec2 start, end;
};

/// All free sides of a state, in order of their corner. Follows from the state's mesh and from which
/// of its elements are broken or released.
class FreeSides {
 public:
  explicit FreeSides(const Mesh& mesh);

  /// Looks up all free sides anew.
  void build(const State& state);

  bool separate_bodies() const { return separate_bodies_; }
  Index count() const { return static_cast<Index>(sides_.size()); }
  const FreeSide& operator[](Index side) const { return sides_[static_cast<std::size_t>(side)]; }
  /// Index of the free side at a corner; -1 if that side is tied.
  Index find(Index corner) const;
  /// Whether `b` is `a` or among the next or previous `steps` sides of its surface.
  bool near(Index a, Index b, int steps) const;

  /// Marks the faces of these elements (ascending) as just taken over, and no others.
  void mark_taken_over(const std::vector<Index>& elements);

  void place(const State& state, std::vector<PlacedSide>& placed) const;

 private:
  void connect(const State& state, FreeSide& side) const;

  std::vector<Index> boundary_;  // corners
  std::vector<FreeSide> sides_;
  bool separate_bodies_ = false;
};

}  // namespace crackle
