// SPDX-License-Identifier: GPL-3.0-or-later
//
// A point of a fracture's path in the quasi-static stage: effective traction t (tension positive) on
// its faces from its opening w, with the largest opening w_m it has had.
//   intact    w_m ≤ w_e   t = t₀ + k₀ w,  k₀ = (f − t₀)/w_e      (t₀: effective stress on it at w = 0)
//   loading   w = w_m     t = f z(D),  D = (w − w_e)/w_s           (z: softening of the cohesive law)
//   unloading w < w_m     t = (w/w_m) f z(D_m) + closure of mated faces (closure.hpp)
//   broken    D = 1       closure only
// The intact bond carries at w = 0 what the rock bore, so nothing jumps when a point joins the path.
// Where faces also slip (by s, on general paths), rock still fails by opening alone, and a bond that it holds
// resists slip as it does opening, β² times stiffer:
//   intact     τ = τ₀ (1 − w/w_e) + β² f/w_e s
//   cohesion   τ = β² (t/w) s
//   closed     τ = k_t (s − s_p), within Coulomb's μ times the traction of the asperities, k_t = σ_ref/(9 w₀)
// w_e is 0.002 of 2G/f; w_s is chosen so that ½ f w_e + f w_s ∫z dD = G.
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>

#include "crackle/cohesive/closure.hpp"
#include "crackle/cohesive/law.hpp"

namespace crackle {

/// What slip needs beside: β and μ.
struct ShearLaw {
  double ratio = 2.0;     ///< root of the shear over the normal stiffness of bonds [-]
  double friction = 0.6;  ///< of closed faces [-]
};

/// Tractions [Pa] of a point that opens and slips, their derivatives by opening and slip [Pa/m], and the
/// slip that friction has not given back [m].
struct MixedTraction {
  double normal = 0.0, shear = 0.0;
  double nn = 0.0, sn = 0.0, ss = 0.0;  ///< of normal by opening; of shear by opening, by slip
  double friction = 0.0;                ///< part of the shear traction [Pa]
  double plastic_slip = 0.0;
};

class InterfaceLaw {
 public:
  /// @param strength f [Pa], as resolved by the mesh @param fracture_energy G [J/m2]
  InterfaceLaw(std::shared_ptr<const CohesiveLaw> law, double strength, double fracture_energy,
               Closure closure, ShearLaw shear = {});

  double strength() const { return strength_; }
  double elastic_opening() const { return elastic_; }              ///< w_e [m]
  double broken_opening() const { return elastic_ + softening_; }  ///< opening without cohesion [m]
  const Closure& closure() const { return closure_; }

  /// D of a point that has been open by `max_opening` [m].
  double damage(double max_opening) const {
    return std::clamp((max_opening - elastic_) / softening_, 0.0, 1.0);
  }
  /// Traction at an opening [m]. @param max_opening before this step [m] @param in_situ t₀ [Pa]
  TractionSlope traction(double opening, double max_opening, double in_situ) const;

  /// The same where faces slip too. @param max_opening before this step [m]
  /// @param in_situ_shear traction along the face before all [Pa]
  MixedTraction traction(double opening, double slip, double max_opening, double plastic_slip, double in_situ,
                         double in_situ_shear) const;
  /// Energy per area that an opening holds [J/m2]: d(stored + dissipated) = t dw, on any way.
  double stored(double opening, double max_opening, double in_situ) const;
  /// Energy dissipated per area by a point that has been open by `max_opening` [J/m2].
  double dissipated(double max_opening) const;
  /// Traction of the bond at the largest opening [Pa]; 0 before it softens and after it has broken.
  double cohesion(double max_opening) const;
  /// Shear traction over slip of what holds a point together [Pa/m].
  double shear_stiffness(double max_opening) const;
  /// Energy per area that slip holds beside it [J/m2]: in the bond, and between closed faces.
  /// @param friction part of the shear traction [Pa]
  double stored_by_slip(double opening, double slip, double max_opening, double friction,
                        double in_situ_shear) const;

 private:
  double friction_stiffness() const { return closure_.closure_stress / (9.0 * closure_.residual_aperture); }
  double least_opening(double largest) const;
  double bond_stiffness(double opening, double in_situ) const;

  std::shared_ptr<const CohesiveLaw> law_;
  double strength_, fracture_energy_;
  Closure closure_;
  ShearLaw shear_;
  double elastic_ = 0.0, softening_ = 0.0;
};

}  // namespace crackle
