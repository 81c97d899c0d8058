// SPDX-License-Identifier: GPL-3.0-or-later
//
// Cohesive laws: traction across and along an edge from its opening and slip. A law holds
// parameters and is const; what changes lives in the CohesivePoint that it is given.
//
// Common to the registered laws (Munjiza, Andrews, White 1999; AbuAisha et al. 2016, Eqs 6.1-6.3):
//   elastic     t = k o,  k = p_f / L;  o < 0 stays elastic (contact of the intact faces)
//               0 ≤ o ≤ o_p:  σ = f_t (r (1 + c) − c r²),  r = o / o_p,  o_p = (1 + c) f_t / k
//   strength    f_s = cohesion − min(σ, 0) tan φ_i            (Eq. 6.1, Mohr-Coulomb)
//   residual    f_r = −min(σ, 0) tan φ_f                      (Eq. 6.2)
//   damage      D² = (⟨o − o_p⟩ / o_t)² + (⟨|s| − s_p⟩ / s_t)²  (Eq. 6.3), never falls
//   softening   σ = z(D) f_t,  τ = z(D) (f_s − f_r) + friction
//   unloading   the elastic branch, stretched to the largest opening (slip) and scaled by z(D)
// c = 1 is the parabola of Y, c = 0 a straight line. Friction is a Coulomb spring in series, so it
// resists in both directions, and goes on unchanged when the edge breaks.
//
// | parameter             | unit | range    |                                                    |
// |-----------------------|------|----------|----------------------------------------------------|
// | tensile_strength      | Pa   | > 0      | f_t                                                |
// | cohesion              | Pa   | > 0      |                                                    |
// | tan_friction          | -    | ≥ 0      | of the internal friction angle φ_i                 |
// | tan_residual          | -    | ≥ 0      | of the residual friction angle φ_f                 |
// | fracture_energy_mode1 | J/m2 | > 0      | G_I                                                |
// | fracture_energy_mode2 | J/m2 | > 0      | G_II                                               |
// | penalty               | Pa   | > 0      | p_f: stiffness times edge length                   |
// | tangential_penalty    | Pa   | > 0      | of the friction spring, times edge length          |
//
// In bedded rock strengths and fracture energies are those of the edge's direction (bedding.hpp).
//
// Work on a closed path: the shear that is borne at a slip follows the normal stress, the normal traction
// does not follow the slip, so that there is no potential. A change of normal stress by dσ at held slip
// changes the shear's energy E_s(s, D, σ) without work: dE_s is given by the law, and counted
// (CohesivePoint::path). So is what the friction spring of an edge that yields holds beyond its share of the
// elastic branch, where tangential_penalty is not k L f_r/f_s.
//
// Calibration: "y_geo" takes the softening lengths of Y-Geo, o_t = 3 G_I / f_t and s_t = 3 G_II / f_s
// (so that evans_marathe dissipates 1.159 G and the elastic part on top); "exact" takes those with
// which the whole curve dissipates G, in mode II above residual friction.
// "benzeggagh_kenane" has a damage of its own (src/cohesive/benzeggagh_kenane.cpp).
//
// Limits: mixed mode dissipates by the ellipse of Eq. 6.3, not by a linear mix; the elastic branch
// makes the rock softer (see artificial_modulus_ratio()).
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "crackle/cohesive/lanes.hpp"
#include "crackle/state/bedding.hpp"
#include "crackle/state/state.hpp"

namespace crackle {

enum class Calibration : std::uint8_t { exact, y_geo };

struct CohesiveMaterial {
  double tensile_strength = 0.0;
  double cohesion = 0.0;
  double tan_friction = 0.0;
  double tan_residual = 0.0;
  double fracture_energy_mode1 = 0.0;
  double fracture_energy_mode2 = 0.0;
  double penalty = 0.0;
  double tangential_penalty = 0.0;
  Calibration calibration = Calibration::exact;
  double mixed_mode_exponent = 4.0;  ///< η of "benzeggagh_kenane" [-]
  Bedding bedding = {};              ///< the values above are those across it
};

/// A traction-separation law.
class CohesiveLaw {
 public:
  virtual ~CohesiveLaw() = default;
  virtual std::string name() const = 0;
  /// One line: form and source.
  virtual std::string description() const = 0;
  /// Formulas for `crackle describe`, in lines; empty: those above.
  virtual std::string formulas() const { return {}; }
  /// c above: 1 parabolic, 0 straight elastic branch.
  virtual double curvature() const = 0;
  /// z(D): share of the strength left at damage D; z(0) = 1, z(1) = 0, falling.
  virtual double softening(double damage) const = 0;
  /// ∫₀¹ z dD.
  virtual double softening_integral() const = 0;
  /// c_y in the softening length c_y G / f of the "y_geo" calibration.
  virtual double y_geo_factor() const = 0;

  /// Whether the work of any closed path is what is dissipated on it, also where the shear strength
  /// follows the normal stress; false for the laws of Y, which give or take work there (CohesivePoint::path).
  virtual bool conserves_energy() const { return false; }
  /// Bound of the slope of the tractions over opening and slip, times edge length [Pa].
  virtual double largest_stiffness(const CohesiveMaterial& material) const;
  /// Penalty [Pa] of the spring by which the faces of what is broken rub.
  virtual double friction_penalty(const CohesiveMaterial& material) const {
    return material.tangential_penalty;
  }

  /// Moves a point to a new opening and slip [m]: its damage, tractions and stored energy.
  /// @param length of the edge in the reference state [m]
  virtual void move(const CohesiveMaterial& material, double length, double opening, double slip,
                    CohesivePoint& point) const;
  /// The same of one point of some elements: the same bits.
  virtual void move(const ElementLanes& elements, PointLanes& points) const;
  /// Of one of those elements.
  void move_lane(const ElementLanes& elements, std::size_t lane, PointLanes& points) const;

  /// Opening [m] at which an intact edge bears the normal traction, and slip at which it bears the
  /// shear traction [Pa]. @param normal, shear within the strength
  double elastic_opening(const CohesiveMaterial& material, double length, double normal) const;
  double elastic_slip(const CohesiveMaterial& material, double length, double normal, double shear) const;

  /// Softening length in mode I, and in mode II at normal traction `normal` [m].
  double softening_opening(const CohesiveMaterial& material, double length) const;
  double softening_slip(const CohesiveMaterial& material, double length, double normal) const;

  /// Longest edge [m] whose elastic branch alone does not already exceed the fracture energy.
  double longest_edge(const CohesiveMaterial& material) const;
};

/// A registered law by name; nullptr if there is none of that name.
std::shared_ptr<const CohesiveLaw> find_law(const std::string& name);
/// All registered laws, by name.
std::vector<std::shared_ptr<const CohesiveLaw>> registered_laws();

/// Registers a law at start: `static const RegisterLaw r{std::make_shared<MyLaw>()};` in its file.
struct RegisterLaw {
  explicit RegisterLaw(std::shared_ptr<const CohesiveLaw> law);
};

/// Mohr-Coulomb shear strength [Pa] at a normal traction (Eq. 6.1), and what friction bears of it when
/// broken (Eq. 6.2).
inline double shear_strength(const CohesiveMaterial& material, double normal) {
  return material.cohesion - (normal < 0.0 ? normal : 0.0) * material.tan_friction;
}
inline double residual_strength(const CohesiveMaterial& material, double normal) {
  return -(normal < 0.0 ? normal : 0.0) * material.tan_residual;
}

/// Tractions of an intact point [Pa]; `beyond` is set where it has left the elastic branch.
struct ElasticTraction {
  double normal = 0.0;
  double shear = 0.0;
  bool beyond = false;
};

/// The elastic branch at a point; elastic_element.hpp has it of whole elements, some at a time.
inline ElasticTraction elastic_traction(double stiffness, double curvature, double tensile_strength,
                                        double cohesion, double tan_friction, double opening, double slip) {
  const double t = stiffness * opening;
  const double pull = t > 0.0 ? t : 0.0;
  const double normal = t - curvature * pull * pull / (4.0 * tensile_strength);
  const double strength = cohesion - (normal < 0.0 ? normal : 0.0) * tan_friction;
  const double s = stiffness * slip;
  const double push = s > 0.0 ? s : -s;
  const double limit = 1.0 + curvature;
  return {normal, s - curvature * s * push / (4.0 * strength),
          t > limit * tensile_strength || push > limit * strength};
}

/// Recoverable energy of an intact point [J/m2]: ∫ (k o − c k² o²/(4 f)) do and the same along.
inline double elastic_energy(double stiffness, double curvature, double tensile_strength, double cohesion,
                             double tan_friction, double opening, double slip) {
  const double t = stiffness * opening;
  const double pull = t > 0.0 ? t : 0.0;
  const double normal = t - curvature * pull * pull / (4.0 * tensile_strength);
  const double strength = cohesion - (normal < 0.0 ? normal : 0.0) * tan_friction;
  const double s = stiffness * slip;
  const double push = s > 0.0 ? s : -s;
  return (0.5 * (t * t + s * s) -
          curvature * (pull * pull * pull / tensile_strength + push * push * push / strength) / 12.0) /
         stiffness;
}

/// Compliance [1/Pa], the same for all components of plane stress, that a penalty on all edges adds to
/// rock: Δε = (Σ L²/(2 A p_f)) σ. @param sum_length2_over_area over interior edges
inline double artificial_compliance(double penalty, double sum_length2_over_area) {
  return sum_length2_over_area / (2.0 * penalty);
}

/// Young's modulus and shear modulus of rock with the penalty's compliance on all edges, over those
/// of the rock: E'_eff/E' = 1/(1 + S E'/(2 p_f)), G_eff/G = 1/(1 + S G/p_f), S = Σ L²/A over
/// interior edges (2√3 for equilateral triangles). Derived for uniform stress; within 1.5 %.
struct ModulusRatio {
  double young = 1.0;
  double shear = 1.0;
};
ModulusRatio artificial_modulus_ratio(double plane_strain_modulus, double shear_modulus, double penalty,
                                      double sum_length2_over_area);

}  // namespace crackle
