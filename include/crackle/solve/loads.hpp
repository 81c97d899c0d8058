// SPDX-License-Identifier: GPL-3.0-or-later
//
// Loads and supports on parts of the outer boundary of a rectangle: tractions, given velocities and
// displacements, rollers; elsewhere it is free, under the constant traction that it bore in the geostatic
// stage. They act on corners of triangles, so that fractures may part the nodes that they act on.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "crackle/state/state.hpp"

namespace crackle {

/// A component of motion that is given; 0 holds it.
struct GivenMotion {
  double value = 0.0;        ///< velocity [m/s] from the end of the ramp on, or displacement [m] at its end
  bool is_velocity = false;  ///< or a displacement, from the in-situ state
};

/// A load or support on a side of the domain. All of it grows from nothing at time 0 by r = x²(3 − 2x),
/// x = time/ramp, to 1 at the end of its ramp (without a ramp: at once).
struct Load {
  enum class Side : std::uint8_t { left, right, bottom, top };
  Side side = Side::top;
  double from =
      -std::numeric_limits<double>::infinity();  ///< along the side: y of left and right, x else [m]
  double to = std::numeric_limits<double>::infinity();
  Vec2 traction;                                     ///< in x and y [Pa]
  std::array<std::optional<GivenMotion>, 2> motion;  ///< in x and y
  double ramp = 0.0;                                 ///< [s]
  bool one_sided = false;  ///< across the side a given motion pushes the body and never pulls it
};

/// What a load did.
struct LoadRecord {
  Vec2 force;         ///< on the body: mean since the last record [N/m]
  Vec2 displacement;  ///< mean over its corners [m]
};

/// What is kept of a load between records.
struct LoadImpulse {
  Vec2 impulse;       ///< since the last record [N s/m]
  double time = 0.0;  ///< that this took [s]
};

struct LoadsMemory {
  std::vector<Vec2> constant;  ///< geostatic forces on the corners of the outer boundary [N/m]
  std::vector<LoadImpulse> impulses;
};

class Loads {
 public:
  /// @throws MeshError when no edge of the mesh lies on the part of the side that has a traction
  Loads(const Mesh& mesh, std::vector<Load> loads);

  /// Holds the nodes of the outer boundary that no load acts on, if they are not free.
  void hold(State& state, bool others_free) const;
  /// Sets what the boundary bore in the geostatic stage. @param forces on corners, that it held [N/m]
  void bear(const State& state, std::span<const Vec2> forces);
  LoadsMemory memory() const { return {constant_, impulses_}; }
  void restore(LoadsMemory memory);

  /// Before the rock moves: notes the velocities that the step begins with.
  void begin(const State& state);
  /// After the rock has moved without it: gives the nodes their forces and motions; books the work.
  /// @return the part of it [J/m] that belongs to energies taken at the step's beginning, negative
  double apply(State& state, double dt);
  /// Adds the constant forces, and what holds nodes back, to forces per node [N/m].
  void balance(const State& state, std::span<Vec2> node_forces) const;

  /// One a load, since the last call.
  std::vector<LoadRecord> take(const State& state);
  bool empty() const { return loads_.empty(); }

 private:
  struct Place {  // a corner on the outer boundary
    Index corner;
    std::array<Index, 2> motion{-1, -1};  // loads that give it
    Index owner = -1;                     // load that it is reported with
    double length = 0.0;                  // half of the outer edges of its triangle there [m]
  };
  struct Pull {  // traction on a corner
    std::size_t place;
    Index load;
    double length;  // [m]
  };
  struct Node {
    Index node;
    Vec2 constant, velocity_before;
    std::array<Index, 2> motion;
    Index owner;
  };
  void group(const State& state);

  std::vector<Load> loads_;
  std::vector<Place> places_;  // ascending by corner
  std::vector<Pull> pulls_;
  std::vector<Index> unloaded_;  // corners of edges without a load
  std::vector<Vec2> constant_;   // of places_
  std::vector<LoadImpulse> impulses_;
  Index node_count_ = -1;  // of the state when nodes_ were grouped
  std::vector<Node> nodes_;
  std::vector<std::size_t> node_of_place_;  // into nodes_
  std::vector<Vec2> force_;                 // of nodes_, of tractions
};

}  // namespace crackle
