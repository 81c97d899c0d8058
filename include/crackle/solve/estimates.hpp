// SPDX-License-Identifier: GPL-3.0-or-later
//
// What theory expects of a scene before anything runs: formulas for the warnings of scene_warnings.hpp
// and for `crackle check`.
//   cohesive zone   l_cz = (9π/32) E' G / f²                      (Rice 1968)
//   wall of a hole  σ_θθ = 2S − 4D cos 2θ + p                      (Kirsch 1898), S, D: mean, half difference
//   breakdown       p = f_t − (2S + 4D) = 3 S_h − S_H + f_t        (Hubbert and Willis 1957)
//   hole volume     V = V₀ (1 + (S + p)/G), mass = ρ₀ V exp((p − p₀)/K_f)
//   toughness       ℓ = 0.9324 (E' V / K')^⅔,  K' = 4 √(2/π) K_Ic,  K_Ic = √(E' G_I)
//   regime          K_m = K' / (E'³ μ' Q)^¼,  μ' = 12 μ             (viscosity below 0.70, toughness
//   above 4.8)
// Tension positive; pressures positive. All assume elastic, isotropic rock in plane strain.
#pragma once

#include "crackle/fluid/compressible.hpp"
#include "crackle/fluid/pump.hpp"
#include "crackle/mesh/mesh.hpp"
#include "crackle/solid/stiffness.hpp"

namespace crackle {

/// What the warnings need to know of an excavated mesh.
struct MeshMeasure {
  double edge = 0.0;          ///< median interior edge within three radii of the wellbore, or of all [m]
  double longest_edge = 0.0;  ///< longest interior edge [m]
  Vec2 longest_place;         ///< its middle [m]
  double sum_length2_over_area = 0.0;  ///< Σ L²/A over interior edges [-]
  int wellbore_edges = 0;
  double wellbore_area = 0.0;  ///< [m2]
  double half_width = 0.0;     ///< from the origin to the nearest point of the outer boundary [m]
};
MeshMeasure measure_mesh(const Mesh& mesh);

/// E' = E/(1 − ν²) of an isotropic plane-strain stiffness [Pa].
double plane_strain_modulus(const PlaneStiffness& stiffness);

/// Here and below `modulus` is E' [Pa].
/// Length of the cohesive zone [m] of a mode with a fracture energy [J/m2] and a strength [Pa].
double cohesive_zone(double modulus, double fracture_energy, double strength);

/// Fracture toughness K_Ic [Pa √m].
double toughness(double modulus, double fracture_energy_mode1);

/// Mean, half difference and principal values of a plane stress state [Pa].
struct PrincipalStress {
  double largest = 0.0;   ///< most tensile
  double smallest = 0.0;  ///< most compressive
  double mean() const { return 0.5 * (largest + smallest); }
  double half_difference() const { return 0.5 * (largest - smallest); }
};
PrincipalStress principal_stress(Sym2 stress);

/// Hoop stress round the wall of a circular hole under a far-field stress and a pressure [Pa].
PrincipalStress wall_hoop_stress(Sym2 stress, double pressure);

/// Pressure [Pa] at which the wall of a hole breaks in tension.
double hubbert_willis_pressure(Sym2 stress, double tensile_strength);

/// A hole in elastic rock, filled with fluid at `initial_pressure`.
struct FilledHole {
  double area = 0.0;           ///< before the excavation relaxes [m2]
  double shear_modulus = 0.0;  ///< [Pa]
  double mean_stress = 0.0;    ///< far-field [Pa]
  CompressibleFluid fluid;
  double initial_pressure = 0.0;  ///< [Pa]

  /// Volume [m2] at reference density to pump in for a pressure [Pa].
  double injected(double pressure) const;
  /// Pressure [Pa] after pumping in a volume [m2]; the inverse of injected().
  double pressure(double volume) const;
};

/// First time [s] by which the pump has delivered a volume [m2]; infinity if not by `end_time`.
double time_of_volume(const Pump& pump, double volume, double end_time);

/// Half-length [m] of a straight fracture that holds a volume [m2] of fluid without viscosity.
double toughness_half_length(double modulus, double toughness, double volume);

/// K_m: below 0.70 viscosity rules the fracture, above 4.80 toughness does and pressure is uniform.
/// @param viscosity [Pa s] @param rate of the pump, both wings together [m2/s]
double dimensionless_toughness(double modulus, double toughness, double viscosity, double rate);

}  // namespace crackle
