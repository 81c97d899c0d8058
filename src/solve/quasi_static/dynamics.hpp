// SPDX-License-Identifier: GPL-3.0-or-later
// Explicit steps of the rock where a fracture snaps: where no equilibrium is near. Mesh, path, laws, fluid
// and well are those of the stage, and so are the equations of a step (newton.hpp), in which inertia stands
// for the condensed rock. Displacements x of the nodes, of a sector each on the path:
//   M (v⁺ − v)/Δt = −K x − C v + loads + Lᵀ g,   x⁺ = x + Δt v⁺,   δ = L x
// Rock, damping and wellbore are those at the beginning of the step (central differences), forces g of faces
// and fluid in them those at its end: with x* where the nodes would come without them, the jumps obey
//   (L M⁻¹ Lᵀ)⁻¹ (δ⁺ − L x*)/Δt² = g(δ⁺, p⁺)
// a small block for every vertex on the path. So only the rock bounds the step, neither stiff bonds nor
// fluid. C: every triangle has the viscosity β of a tenth of its own highest frequency's critical damping, so
// that waves die where the mesh gets too coarse for them; and α M, which grows in the outer half of the
// domain, takes up those that get there.
#pragma once

#include <vector>

#include "newton.hpp"

namespace crackle::quasi_static {

/// Motion of a state at rest.
Motion set_in_motion(const Equations& equations, const State& state);

class Dynamics {
 public:
  /// Jumps at a vertex: their unknowns, and (L M⁻¹ Lᵀ)⁻¹ by rows [kg/m].
  struct Block {
    std::vector<Index> unknowns;
    std::vector<double> inertia;
  };

  Dynamics(const Equations& equations, const State& state);

  /// Longest stable step [s].
  double stable_step() const { return stable_step_; }
  /// Where the nodes come in a step [s] by all but faces and the fluid in them.
  void predict(const State& state, double dt);
  /// Takes what the path has got in the step that is predicted.
  void follow_path(const State& state);
  /// Forces of faces [N/m] at the beginning of the step, from unknown `first` on.
  void set_faces(const std::vector<double>& forces, std::size_t first);
  /// Ends the step with the jumps of `state`.
  void move(const State& state);
  /// Forces and energies at the state, after a step.
  void find_forces(const State& state);

  double dt() const { return dt_; }
  const std::vector<Block>& blocks() const { return blocks_; }
  /// Jumps L x* [m].
  const std::vector<double>& target() const { return target_; }
  /// Force [N/m] on unknown k of a block by inertia, at given jumps.
  static double inertia(const Block& block, std::size_t k, const std::vector<double>& jumps,
                        const std::vector<double>& target, double dt);

  /// Volume of the wellbore [m2] at the end of the step with these jumps, and its derivatives by them [m].
  double bore_volume(const std::vector<double>& jumps) const;
  const std::vector<double>& bore_by_jump() const { return bore_by_jump_; }
  /// Work of a unit of a load on what has moved [J/m].
  double work(std::size_t load) const;
  double strain_energy() const { return strain_; }
  /// At the time of the displacements, after find_forces() [J/m].
  double kinetic_energy() const;
  /// Of all steps so far, by damping and by forces of faces that are those at the end of a step [J/m].
  double damped() const { return damped_; }

  /// Of all vertices, as Condensation::displacement() gives it [m].
  std::vector<Vec2> displacement() const { return {place_.begin(), place_.begin() + vertices_}; }
  /// Puts displacements and velocities into the state's motion.
  void give_back(State& state) const;

 private:
  struct Element {
    std::array<Vec2, 3> gradient;
    PlaneStiffness stiffness;  // times area
    double beta = 0.0;         // [s]
  };
  struct Pair {  // of nodes: an unknown is the difference of their displacements
    Index plus = -1, minus = -1;
  };
  void take_path();
  void split(Index vertex);
  void set_pairs(Index vertex);
  void set_block(Block& block) const;
  void set_bore();
  void tie_faces();
  void set_absorption();
  Index node_at(Index triangle, Index vertex) const;
  void bound_step();

  const Equations& e_;
  std::ptrdiff_t vertices_;
  std::vector<Element> elements_;
  std::vector<Index> node_of_corner_;
  std::vector<Vec2> place_, velocity_, before_;    // of nodes: displacement, velocity, that of before
  std::vector<Vec2> force_, damping_, predicted_;  // [N/m]; velocity without faces
  std::vector<double> mass_, rows_;                // [kg/m], stiffness by Gershgorin [N/m2]
  std::vector<double> absorption_;                 // α [1/s]
  std::vector<std::uint8_t> held_;
  std::vector<Pair> pairs_;  // per unknown
  std::vector<Block> blocks_;
  std::vector<double> target_, faces_, bore_by_jump_;
  std::size_t edges_ = 0;  // of the path, known
  double strain_ = 0.0, damped_ = 0.0, bore_target_ = 0.0;
  double stable_step_ = 0.0, dt_ = 0.0;
};

}  // namespace crackle::quasi_static
