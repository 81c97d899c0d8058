// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "crackle/cohesive/law.hpp"
#include "crackle/state/state.hpp"

namespace crackle {

/// Opening and slip of the two ends of a cohesive element [m], and its current direction.
struct EndSeparation {
  double opening0 = 0.0, slip0 = 0.0, opening1 = 0.0, slip1 = 0.0;
  Vec2 direction;  ///< unit, from end 0 to end 1
};

/// All cohesive elements of a state under one law: tractions, damage, breaking.
///
/// An element has three integration points (its ends and its middle) with Simpson's weights. It
/// breaks when two of them are fully damaged, as in Y-Geo.
class Cohesive {
 public:
  Cohesive(std::shared_ptr<const CohesiveLaw> law, const CohesiveMaterial& material);

  const CohesiveLaw& law() const { return *law_; }
  const CohesiveMaterial& material() const { return material_; }

  /// Evaluates all elements: writes their end forces, grows damage, books dissipation to the state
  /// and collects the elements that broke (newly_broken()).
  void add_tractions(State& state);

  /// Elements broken by the last add_tractions(), in ascending order.
  std::span<const Index> newly_broken() const { return newly_broken_; }
  /// True if the last add_tractions() gave an element its first damage or broke one.
  bool changed() const { return changed_; }

  /// Breaks an element by hand (a pre-cut crack): no cohesion left, no energy booked.
  void cut(State& state, Index element) const;

  /// Lets every element bear, at zero opening and slip, the traction that balances the corner
  /// forces given (rock's internal forces and loads, per corner [N/m]); fixed corners need no
  /// balance. Elements are then in equilibrium to round-off with no step taken.
  /// @return elements whose traction is beyond the elastic branch (they will slip or break)
  std::vector<Index> balance(State& state, std::span<const Vec2> corner_forces) const;

  /// Recoverable energy of all elements [J/m].
  double stored_energy(const State& state) const;

  EndSeparation separation(const State& state, Index element) const;

  /// Middle of an element in its current place [m].
  static Vec2 place(const State& state, Index element);
  static double length(const State& state, Index element) {
    return norm(state.cohesive.direction[static_cast<std::size_t>(element)]);
  }

  /// Elements with a history are evaluated one by one; tells which share of the work that is.
  Index active_count(const State& state) const { return static_cast<Index>(state.cohesive.histories.size()); }

 private:
  void evaluate_active(State& state, CohesiveHistory& h, Dissipation& sum) const;

  std::shared_ptr<const CohesiveLaw> law_;
  CohesiveMaterial material_;
  std::vector<std::uint8_t> beyond_;  // per element, of the last fast pass
  std::vector<Index> newly_broken_;
  bool changed_ = false;
};

}  // namespace crackle
