// SPDX-License-Identifier: GPL-3.0-or-later
//
// Leak-off from a fracture into the rock, per area of one face.
//   Carter (1957)     v = C_L / √(t − t₀), so V = 2 C_L √(t − t₀)       (t₀: exposure)
//                     as v = 2 C_L²/V (what has leaked resists), times clamp((p − p_res)/p_cut, 0, 1): a
//                     starved cell leaks nothing now, and more when it is filled
//   diffusion         φ c_t ∂p/∂t = (k/μ) ∂²p/∂x², normal to the face, p = p_res at first
//                     (V = 2 Δp √(k φ c_t t/(π μ)) at constant pressure: C_L = Δp √(k φ c_t/(π μ)))
// Limits: one-dimensional, so short against the length of the fracture; no stress from the pressure
// in the rock (poroelastic back-stress).
#pragma once

#include <array>
#include <span>
#include <vector>

namespace crackle {

struct CarterLeakOff {
  double coefficient = 0.0;         ///< C_L [m/√s]
  double reservoir_pressure = 0.0;  ///< p_res [Pa]
  double cut_off = 2e6;             ///< p_cut [Pa]

  /// Volume per area of one face [m] that leaks in a time dt [s] where `before` [m] has leaked, at a pressure
  /// [Pa]; `slope` by the pressure. @param bare share of the face that fluid has reached [-]
  struct Volume {
    double value = 0.0, slope = 0.0;
  };
  Volume volume(double before, double dt, double pressure, double bare = 1.0) const;
};

struct MatrixRock {
  double permeability = 0.0;        ///< k [m2]
  double porosity = 0.0;            ///< φ [-]
  double compressibility = 0.0;     ///< c_t of pores and their fluid [1/Pa]
  double viscosity = 0.0;           ///< μ of the fluid in the pores [Pa s]
  double reservoir_pressure = 0.0;  ///< p_res [Pa]
  int cells = 40;                   ///< of the grid normal to a face; 40 reach 3 m, three more twice as far
};

/// Cells of a grid that what leaks off does not feel the end of until `time` [s]: it reaches 6 √(D t), 40 at
/// least.
int diffusion_cells(const MatrixRock& rock, double time);

/// Implicit diffusion normal to a face on a graded line of cells: first 0.1 mm, each next one longer
/// by a quarter. One grid for all faces; a face's profile is kept by the caller.
class MatrixDiffusion {
 public:
  explicit MatrixDiffusion(const MatrixRock& rock);

  /// A profile: pressure of every cell [Pa].
  std::size_t cells() const { return width_.size(); }
  double reach() const;  ///< depth of the last cell [m]

  /// A backward Euler step of length dt [s]: volume per area [m] that enters the rock through a face at
  /// pressure p is slope p + constant.
  struct Response {
    double slope = 0.0, constant = 0.0;
  };
  Response response(std::span<const double> profile, double dt) const;
  /// Ends the step with the face at `pressure`.
  void advance(std::span<double> profile, double dt, double pressure) const;
  /// Volume per area that the rock holds above its initial state [m].
  double stored(std::span<const double> profile) const;

 private:
  // p_i = a_i p_{i−1} + b_i from the deep end: a_i depends on dt alone.
  void eliminate(double dt, std::span<const double> profile, std::vector<double>& a,
                 std::vector<double>& b) const;

  MatrixRock rock_;
  std::vector<double> width_, transmissibility_;  // [m], [m/(Pa s)]; to the previous cell or the face
};

}  // namespace crackle
