// SPDX-License-Identifier: GPL-3.0-or-later
//
// Anisotropic damage: cracks smeared over triangles, after ADaM (Nairn, Hammerquist, Aimene 2017). A triangle
// that comes to its strength gets a crack of normal n and direction s, for good. With R, U the rotation and
// stretch of the triangle and C the stiffness of the rock:
//   strain      ε = U − 1 − ε₀,  trial stress C:ε + σ₀, trial traction t = (n·σn, s·σn), A = NᵀCN, N = (n⊗n,
//   n⊗s) crack       a spring in series with the rock, w = (w_n, w_s) its opening and slip per element length
//   ℓ:
//               e_n = (t_n − A_ns w_s)/A_nn, e_s = (t_s − A_ns w_n)/A_ss; w_n = d_n ⟨e_n⟩, w_s = d_s γ_p
//   friction    γ_p = e_s where the crack is open; closed |A_ss (e_s − γ_p)| ≤ μ ⟨−T_n⟩ (Alfano and Sacco
//   2006) softening   T = σ_c f(x) with x the largest w ℓ σ_c/G of each direction; d = x/(x + r f), r = σ_c²
//   ℓ/(G A) stress      σ = σ₀ + C:(ε − N w);  forces f_i = −A₀ P ∇N_i with P Rᵀ the stress that is symmetric
//   in space
// This is σ = (1 − D) C ε of ADaM in isotropic rock, and symmetric on bedded rock too.
//
// Element length: Oliver (1989), ℓ = 1/Σ ∇N_i·n over the nodes ahead of the centroid, with which Σ A/ℓ over a
// band of triangles is the length of the crack through them; or the area over the chord through the centroid.
//
// Presets:
//   faithful     ADaM: d_n and d_s are independent; fails where one is 1 or Σ G_i/G_ic = 1, and drops its
//                tractions then; chord; initiation "box". Locks where a band cannot run straight.
//   recommended  one damage: the larger of d_n and d_s; a failed triangle that is open bears no stress at
//   all;
//                Oliver; initiation "mohr_coulomb".
// What is dropped at failure is booked as fracture energy.
//
// Initiation: "principal" σ_1 > f_t; "shear" (σ_1 − σ_2)/2 > c; "box" the first of these two; "ellipse"
// (⟨σ_n⟩/f_t)² + (τ/c)² > 1 on the worst plane; "mohr_coulomb" σ_1 > f_t or |τ| > c − σ_n tan φ.
// Bedded rock (bedding.hpp) cracks on the plane whose load is the largest share of its own strength: σ_n of
// f_t(n), |τ| of c(n), |τ| + σ_n tan φ of c(n).
//
// | parameter             | unit | range |                                                             |
// |-----------------------|------|-------|-------------------------------------------------------------|
// | tensile_strength      | Pa   | > 0   | f_t                                                         |
// | cohesion              | Pa   | > 0   | c                                                           |
// | tan_friction          | -    | ≥ 0   | internal, of "mohr_coulomb"                                 |
// | tan_residual          | -    | ≥ 0   | μ, of closed cracks                                         |
// | fracture_energy_mode1 | J/m2 | > 0   |                                                             |
// | fracture_energy_mode2 | J/m2 | > 0   |                                                             |
//
// Limits: one crack a triangle; a triangle above the size limit ℓ ≤ η G A/σ_c² gets a lower strength
// (counted); directions of cracks follow the mesh within some 10 degrees; a damaged triangle has no
// viscosity.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "crackle/solid/bulk.hpp"
#include "crackle/solid/softening.hpp"
#include "crackle/state/bedding.hpp"

namespace crackle {

enum class DamagePreset : std::uint8_t { recommended, faithful };
enum class Initiation : std::uint8_t { mohr_coulomb, principal, shear, box, ellipse };
enum class ElementLength : std::uint8_t { oliver, chord };

struct DamageMaterial {
  double tensile_strength = 0.0;
  double cohesion = 0.0;
  double tan_friction = 0.0;
  double tan_residual = 0.0;
  double fracture_energy_mode1 = 0.0;
  double fracture_energy_mode2 = 0.0;
  bool coupled = true;   ///< one damage of both directions
  bool drop_all = true;  ///< an open failed triangle bears no stress
  Initiation initiation = Initiation::mohr_coulomb;
  ElementLength element_length = ElementLength::oliver;
  Bedding bedding = {};  ///< the values above are those across it

  /// Sets the members that a preset says.
  void apply(DamagePreset preset);
};

/// Where a triangle cracks, and how: nothing below its strength.
struct CrackStart {
  bool reached = false;
  bool in_shear = false;
  Vec2 normal;
  double cohesion = 0.0;  ///< shear strength of the crack, less its friction [Pa]
};
CrackStart crack_start(const DamageMaterial& material, Sym2 stress);
/// By its name in a case file; none of that name: nothing.
std::optional<Initiation> find_initiation(const std::string& name);

/// Area of a triangle over the length of a crack of unit normal n that parts the corners marked with 1 from
/// the others [m]: 1/Σ ∇N_i·n over the marked. @param gradients of the shape functions [1/m]
double parting_length(const std::array<Vec2, 3>& gradients, const std::array<bool, 3>& ahead, Vec2 normal);
/// The same for a crack through the centroid (Oliver 1989).
double oliver_length(const std::array<Vec2, 3>& gradients, Vec2 normal);
/// Area over the chord along the crack through the centroid [m].
double chord_length(const std::array<Vec2, 3>& corners, Vec2 normal);

/// Longest element length [m] that softening can follow, across the crack and along it.
std::array<double, 2> size_limits(const DamageMaterial& rock, const SofteningLaw& law,
                                  const PlaneStiffness& stiffness, Vec2 normal);

/// Damaged triangles of a body.
class Damage {
 public:
  /// @param of_triangle which of the materials every triangle is of; empty: all of the first
  Damage(std::shared_ptr<const SofteningLaw> law, std::vector<DamageMaterial> materials,
         std::vector<std::uint16_t> of_triangle = {})
      : law_(std::move(law)), materials_(std::move(materials)), of_triangle_(std::move(of_triangle)) {}

  const SofteningLaw& law() const { return *law_; }
  const DamageMaterial& material(Index triangle) const {
    return materials_[of_triangle_.empty() ? 0 : of_triangle_[static_cast<std::size_t>(triangle)]];
  }
  /// With which bulk finds the triangles that may be at their strength.
  StressScreen screen() const;

  /// Cracks those of the candidates (intact, ascending) that are at their strength.
  /// @return how many
  Index initiate(State& state, const Bulk& bulk, std::span<const Index> candidates);
  /// Gives an intact triangle a crack, at its present strain.
  void crack(State& state, const Bulk& bulk, Index triangle, const CrackStart& start) const;
  /// Cracks a triangle by hand: failed, open, no energy booked.
  void cut(State& state, const Bulk& bulk, Index triangle, Vec2 normal) const;

  /// Moves all damaged triangles to the present displacement: their damage, stress and forces; books what is
  /// dissipated to the state.
  void update(State& state, const Bulk& bulk);

  /// Numbers (into state.damage.triangles) of those that failed since the last update began, ascending.
  std::span<const Index> newly_failed() const { return newly_failed_; }

  /// Recoverable energy of the damaged triangles less what bulk reckons for them as if intact [J/m].
  double stored_energy_correction(const State& state, const Bulk& bulk) const;

 private:
  struct Spent {
    double fracture = 0.0, friction = 0.0;
  };
  Spent evaluate(const State& state, const Bulk& bulk, DamagedTriangle& d) const;
  DamagedTriangle make(const State& state, const Bulk& bulk, Index triangle, Vec2 normal) const;

  std::shared_ptr<const SofteningLaw> law_;
  std::vector<DamageMaterial> materials_;
  std::vector<std::uint16_t> of_triangle_;
  std::vector<Index> newly_failed_;
};

}  // namespace crackle
