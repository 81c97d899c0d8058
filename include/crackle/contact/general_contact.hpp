// SPDX-License-Identifier: GPL-3.0-or-later
//
// General contact: faces that have moved on past their partner, and separate bodies.
//
// Every free side carries three points (its ends and its middle, Simpson's weights w, as a cohesive
// element does). A point that lies behind a free side of other rock has a depth d, its distance to
// the nearest side there, and
//   E = Σ ½ w L ½ k_n ⟨d − d₀⟩²,   k_n = p_n / L                                        [J/m]
// with L the length of the side that carries the point; the sum runs over the points of both faces,
// hence the ½. The force is −∂E/∂x: on the point along the side's normal, and by projection on the
// ends of the side. Convex corners are rounded a little for this (src/contact/depth.hpp). It is zero at first
// touch, conserves momentum, and since d is a distance to the whole surface it does not know how the surface
// is cut into sides. Two faces that lie on one another meet p_n / L per area, as a matched broken element
// does.
//
// d₀ is the offset: a point that lies behind a side when it is first looked at bears nothing there,
// and a pair that is handed over from a broken element goes on bearing what it bore.
//
// Friction: τ = k_t (s − sₚ), |τ| ≤ tan φ k_n ⟨d − d₀⟩, k_t = p_t / L (coulomb_traction()), slip s
// in metres along the target, kept as the point goes on from one side to the next.
//
// | parameter          | unit | range |                                               |
// |--------------------|------|-------|-----------------------------------------------|
// | normal_penalty     | Pa   | > 0   | p_n: stiffness per area times length          |
// | tangential_penalty | Pa   | ≥ 0   | p_t                                           |
// | tan_friction       | -    | ≥ 0   | tan φ                                         |
//
// Source: penalty contact by distance (Munjiza, The Combined Finite-Discrete Element Method, 2004,
// ch. 2, for the penalty and its scale); points at the ends, as a corner must not go in unseen.
// Limits: a depth beyond half the shorter of the target side and its triangle's height is not seen
// any more. Walls that nothing has been released from do not look at one another while the mesh is
// one body.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "crackle/state/state.hpp"

namespace crackle {

struct ContactMaterial {
  double normal_penalty = 0.0;
  double tangential_penalty = 0.0;
  double tan_friction = 0.0;
};

/// A force on a side, and how the nodes at its ends share it.
struct SideForce {
  Vec2 force;  ///< [N/m]
  std::array<Index, 2> node{};
  std::array<double, 2> share{};
};

/// Contact between all free sides of a state; costs nothing until there can be any.
class GeneralContact {
 public:
  GeneralContact(const State& state, const ContactMaterial& material);
  ~GeneralContact();
  GeneralContact(GeneralContact&&) noexcept;
  GeneralContact& operator=(GeneralContact&&) noexcept;

  /// Releases matched pairs that have parted (slip or opening beyond their length, or turned by more
  /// than 10 degrees), then finds all contacts at the displacements of now, moves their friction and
  /// books what is dissipated. Comes after the cohesive elements' tractions: takes over theirs.
  void update(State& state);

  /// After the rock has moved without it: moves the nodes on by the forces of the last update() (not
  /// before, or viscosity would see half a step's velocity). @param dt [s]
  void apply(State& state, double dt) const;

  /// Rebuilds what is derived from the state (after a resume).
  void rebuild(const State& state);

  /// Recoverable energy at the last update() [J/m].
  double stored_energy(const State& state) const;

  /// Upper bound of the largest frequency squared that contact can give to a node [1/s²]: adds to
  /// that of the rock. 0 while there can be no contact.
  double largest_frequency_squared(const State& state) const;

  /// Points that bear something.
  Index count(const State& state) const;
  /// Cohesive elements released by the last update(), ascending.
  const std::vector<Index>& released() const { return released_; }
  /// What the sides that touch something slid in the last step, ascending by side.
  const std::vector<SideSlip>& slips() const { return slips_; }
  const ContactMaterial& material() const { return material_; }

 private:
  struct Search;

  void evaluate(State& state, bool first_look, double& taken_over);

  ContactMaterial material_;
  std::unique_ptr<Search> search_;  // free sides and which of them may meet; follows from the state
  std::vector<Index> released_;
  std::vector<SideForce> forces_;
  std::vector<SideSlip> slips_;
};

}  // namespace crackle
