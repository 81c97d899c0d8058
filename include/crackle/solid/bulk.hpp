// SPDX-License-Identifier: GPL-3.0-or-later
//
// Constant-strain triangles in the reference configuration, with finite rotation:
//   F = I + ∂u/∂X,  E = ½(FᵀF − I),  S = C:E + S₀ + μᵥ Ė,  Ė = sym(Fᵀ ∂v/∂X),
//   force on corner i:  f_i = −A₀ F S ∇N_i                          (total Lagrangian, per metre)
// S₀ is the in-situ stress: a body in equilibrium with it needs no steps to settle. Where it grows with
// depth, S₀ = S(origin) − y ∂S, the rock has the weight that bears it, ∂S_yy per volume (buoyant, as stresses
// are effective), a third of each triangle's on each corner. In equilibrium exactly: ∫ S₀ ∇N = S₀(centroid) A
// ∇N.
//
// | parameter | unit | meaning                                                         |
// |-----------|------|-----------------------------------------------------------------|
// | viscosity | Pa s | stress per strain rate, per triangle; 0: none                   |
#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "crackle/solid/stiffness.hpp"
#include "crackle/solid/triangle.hpp"
#include "crackle/state/state.hpp"

namespace crackle {

/// Effective stress of the rock before anything is done to it [Pa], tension positive.
struct InSituStress {  // NOLINTNEXTLINE(google-explicit-constructor): a stress without gradient is one
  InSituStress(Sym2 at_origin = {}, Sym2 per_depth = {}) : origin(at_origin), gradient(per_depth) {}
  Sym2 origin;
  Sym2 gradient;  ///< change per metre of depth, which is −y [Pa/m]; its xy is 0
};

/// What triangles are made of, and the stress that they bear before anything is done to them.
struct BulkMaterial {
  PlaneStiffness stiffness;
  double density = 0.0;  ///< [kg/m3]
  InSituStress in_situ;
};

struct TriangleRun;

/// Rock between the fractures: reference geometry and material of every triangle.
class Bulk {
 public:
  /// @param viscosity [Pa s], a constant for every triangle, and
  /// @param damping_ratio of the critical viscosity 2 h √(E ρ) of each triangle; they add
  struct Damping {
    double viscosity = 0.0;
    double ratio = 0.0;
  };

  Bulk(const Mesh& mesh, const PlaneStiffness& stiffness, double density, const InSituStress& in_situ_stress,
       const Damping& damping)
      : Bulk(mesh, {{stiffness, density, in_situ_stress}}, {}, damping) {}
  /// @param of_triangle which of the materials every triangle is of; empty: all of the first
  Bulk(const Mesh& mesh, std::vector<BulkMaterial> materials, std::vector<std::uint16_t> of_triangle,
       const Damping& damping);

  bool viscous() const { return viscous_; }
  /// Number of a triangle's material.
  std::uint16_t number(Index triangle) const {
    return of_triangle_.empty() ? std::uint16_t{0} : of_triangle_[static_cast<std::size_t>(triangle)];
  }
  bool layered() const { return !of_triangle_.empty(); }
  const std::vector<BulkMaterial>& materials() const { return materials_; }
  const PlaneStiffness& stiffness(Index triangle) const { return materials_[number(triangle)].stiffness; }
  double density(Index triangle) const { return materials_[number(triangle)].density; }
  double area(Index triangle) const { return area_[static_cast<std::size_t>(triangle)]; }
  double viscosity(Index triangle) const {
    return viscous_ ? viscosity_[static_cast<std::size_t>(triangle)] : 0.0;
  }
  /// Weight of the rock [N/m3], along y; 0: it is in the in-situ stress already.
  double weight(Index triangle) const { return materials_[number(triangle)].in_situ.gradient.yy; }

  /// Forces [N/m] on the three corners of triangles [begin, end), in corner order, written (not
  /// added) to forces[3 (t − begin) + i], weight included. Writes state.strain_rate when viscous.
  /// @return viscous dissipation of the last step times 1/time_step [W/m]
  double corner_forces(State& state, Index begin, Index end, Vec2* forces) const;

  /// The forces on one triangle's corners [N/m], nothing written.
  std::array<Vec2, 3> triangle_forces(const State& state, Index triangle) const;
  /// For each corner of a triangle the sum of the norms of its stiffness [N/m2], or viscosity [N s/m2],
  /// against all three corners: the rows of Gershgorin's bound, by blocks.
  std::array<double, 3> stiffness_rows(Index triangle) const { return rows(triangle, stiffness(triangle)); }
  std::array<double, 3> viscosity_rows(Index triangle) const {
    const double mu = viscosity(triangle);
    return rows(triangle, {mu, 0.0, mu, 0.0, 0.0, 0.5 * mu});
  }

  /// Recoverable energy of all triangles [J/m], from the in-situ state: Σ A₀ (½ E:C:E + S₀:E − weight · u).
  double strain_energy(const State& state) const;
  /// The same of one triangle, without its weight.
  double strain_energy(const State& state, Index triangle) const;
  /// In-situ stress of a triangle [Pa].
  Sym2 in_situ(Index triangle) const { return in_situ_[static_cast<std::size_t>(triangle)]; }
  /// Where it is another one than the rock's, as in rocks that have come to equilibrium with one another.
  void set_in_situ(Index triangle, const Sym2& stress) {
    in_situ_[static_cast<std::size_t>(triangle)] = stress;
  }
  /// Share of a triangle's weight that each of its corners bears, along y [N/m].
  double corner_weight(Index triangle) const {
    return weight(triangle) * area_[static_cast<std::size_t>(triangle)] / 3.0;
  }
  /// From now on a triangle is not damped.
  void drop_viscosity(Index triangle) {
    if (viscous_) viscosity_[static_cast<std::size_t>(triangle)] = 0.0;
  }

  /// Cauchy stress in a triangle [Pa], without its viscous part.
  Sym2 stress(const State& state, Index triangle) const;

  /// Stress [Pa] with small displacements of its corners [m]: linear, without rotation.
  Sym2 small_stress(Index triangle, const std::array<Vec2, 3>& corners) const;

  /// Area of a triangle now over its reference area; at or below zero it is turned inside out.
  double area_ratio(const State& state, Index triangle) const;

  /// ∇N_i of the three corners in the reference state [1/m].
  std::array<Vec2, 3> shape_gradients(Index triangle) const;

 private:
  std::array<double, 3> rows(Index triangle, const PlaneStiffness& c) const;
  /// Calls work(from, to) for every run of one material.
  template <class Work>
  void for_each_material(Index begin, Index end, const Work& work) const;
  TriangleRun run_of(const State& state, Index begin, Index end) const;
  void add_weight(Index begin, Index end, Vec2* forces) const;

  std::vector<BulkMaterial> materials_;
  std::vector<std::uint16_t> of_triangle_;
  bool viscous_ = false;
  std::vector<std::array<double, 4>> inverse_shape_;  // rows ∇N_1, ∇N_2
  std::vector<double> area_;
  std::vector<Sym2> in_situ_;
  std::vector<double> viscosity_;
};

}  // namespace crackle
