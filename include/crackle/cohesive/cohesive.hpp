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

/// Force on a corner [N/m].
using CornerForce = std::function<Vec2(Index corner)>;

/// All cohesive elements of a state under one law: tractions, damage, breaking.
///
/// An element has three integration points (its ends and its middle) with Simpson's weights. It
/// breaks when two of them are fully damaged, as in Y-Geo.
class Cohesive {
 public:
  /// @param materials by number (CohesiveElements::material); 0 is the rock's
  Cohesive(std::shared_ptr<const CohesiveLaw> law, std::vector<CohesiveMaterial> materials);
  Cohesive(std::shared_ptr<const CohesiveLaw> law, const CohesiveMaterial& material)
      : Cohesive(std::move(law), std::vector<CohesiveMaterial>{material}) {}

  const CohesiveLaw& law() const { return *law_; }
  const std::vector<CohesiveMaterial>& materials() const { return materials_; }
  /// Material of an element: of its direction in bedded rock, with the penalty it was inserted with.
  CohesiveMaterial material(const State& state, Index element) const;

  /// Evaluates all elements: writes their end forces, grows damage, books dissipation to the state
  /// and collects the elements that broke (newly_broken()).
  void add_tractions(State& state);
  /// The same for those that are not intact alone: Tiles finds the forces of the intact ones.
  void advance_histories(State& state);

  /// Makes intact elements that are near their strength active: from now on they are evaluated point by
  /// point, first from where they were some time [s] before, when that was seen, so that what they have done
  /// since is booked. @param elements in ascending order
  void start_histories(State& state, std::span<const Index> elements, double before);

  /// Elements broken by the last add_tractions() or advance_histories(), in ascending order.
  std::span<const Index> newly_broken() const { return newly_broken_; }

  /// Breaks an element by hand (a pre-cut crack): no cohesion left, no energy booked.
  void cut(State& state, Index element) const;

  /// Breaks an element by hand that stays closed (a joint): it goes on to bear the compression that it bears
  /// now, and of the shear what friction holds. @return whether it gives: it slides or opens
  bool unbond(State& state, Index element) const;

  /// Lets every element bear, at zero opening and slip, the traction that balances the corner
  /// forces given (rock's internal forces and loads, per corner [N/m]); fixed corners need no
  /// balance. Elements are then in equilibrium to round-off with no step taken.
  /// @return elements whose traction is beyond the elastic branch (they will slip or break)
  std::vector<Index> balance(State& state, std::span<const Vec2> corner_forces) const;

  /// Inserts elements on tied edges. Where nodes part the elements between them bear, at once, the force
  /// with which every part goes on at the acceleration that the node had: nothing jumps. An end that
  /// is tied still bears the mean stress of its two triangles, until it is parted in turn.
  /// @param edges in ascending order @param penalty of each, at most the material's [Pa] @param number of
  /// the material of each
  /// @param rock internal force of the rock on a corner @param load of fluid and boundary on it
  /// @return elements whose traction is beyond the elastic branch (their forces jump)
  std::vector<Index> insert(State& state, std::span<const Index> edges, std::span<const double> penalty,
                            std::span<const std::uint16_t> number, const CornerForce& rock,
                            const CornerForce& load) const;

  /// How near an edge of a material is to its strength under a stress, 1 at the strength:
  /// √((⟨σ_n⟩/f_t)² + (τ/f_s)²). @param rock its material, not that of the plane @param along the edge, unit
  static double utilisation(const CohesiveMaterial& rock, Sym2 stress, Vec2 along);
  /// The same of the most loaded point of an element; 1 or more once it is damaged.
  double utilisation(const State& state, Index element) const;

  /// Recoverable energy of all elements [J/m].
  double stored_energy(const State& state) const;

  EndSeparation separation(const State& state, Index element) const;

  /// Middle of an element in its current place [m].
  static Vec2 place(const State& state, Index element);
  static double length(const State& state, Index element) {
    return norm(state.cohesive.direction[static_cast<std::size_t>(element)]);
  }

 private:
  static void begin_history(State& state, Index element);
  static void activate(State& state, Index element);
  void place_points(State& state, Index element) const;
  bool bear(State& state, Index element, const EndForces& target) const;
  void load_springs(State& state, Index element) const;

  std::shared_ptr<const CohesiveLaw> law_;
  std::vector<CohesiveMaterial> materials_;
  std::vector<Index> newly_broken_;
};

}  // namespace crackle
