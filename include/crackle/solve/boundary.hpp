// SPDX-License-Identifier: GPL-3.0-or-later
//
// Absorbing outer boundary (Lysmer and Kuhlemeyer 1969): traction −ρ c_p v_n normal to it and
// −ρ c_s v_s along it, half to each end of an edge, on top of the constant traction that the
// boundary bore in the geostatic stage. The dashpots act on the mean velocity of the step
// (trapezoidal rule): they cannot limit the step.
// Limits: exact for waves that come in straight, less good at slant; no stiffness, so the static
// pressurisation drifts slowly outward.
#pragma once

#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "crackle/solid/bulk.hpp"
#include "crackle/state/state.hpp"

namespace crackle {

/// A node of the absorbing boundary.
struct BoundaryNode {
  Index node = -1;
  Vec2 load;             ///< constant [N/m]
  Sym2 dashpot;          ///< of all its edges together [kg/(s m)]
  Vec2 velocity_before;  ///< that the step began with [m/s]
};

class AbsorbingBoundary {
 public:
  /// As it was (after a resume).
  explicit AbsorbingBoundary(std::vector<BoundaryNode> nodes) : nodes_(std::move(nodes)) {}
  /// @param rock stiffness and density of a triangle
  /// @param loads constant force on every corner of the outer boundary [N/m] (others are zero)
  AbsorbingBoundary(const State& state, const std::function<BulkMaterial(Index triangle)>& rock,
                    std::span<const Vec2> loads);

  /// Before the rock moves: notes the velocities that the step begins with.
  void begin(const State& state);
  /// After the rock has moved without it: moves the boundary nodes on by their constant load and
  /// dashpots; books what is radiated.
  /// @return the part of it [J/m] that belongs to energies taken at the step's beginning
  double apply(State& state, double dt) const;

  /// Adds the constant loads to forces per node [N/m].
  void add_loads(std::span<Vec2> node_forces) const;

  const std::vector<BoundaryNode>& nodes() const { return nodes_; }

 private:
  std::vector<BoundaryNode> nodes_;
};

}  // namespace crackle
