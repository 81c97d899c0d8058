// SPDX-License-Identifier: GPL-3.0-or-later
#include "crackle/solid/stiffness.hpp"

#include <algorithm>
#include <cmath>

namespace crackle {

double PlaneStiffness::largest() const {
  // Gershgorin on the matrix over (E_xx, E_yy, sqrt(2) E_xy), whose eigenvalues are those of the tensor.
  const double r2 = std::sqrt(2.0);
  return std::max({std::abs(c11) + std::abs(c12) + r2 * std::abs(c16),
                   std::abs(c22) + std::abs(c12) + r2 * std::abs(c26),
                   2.0 * std::abs(c66) + r2 * (std::abs(c16) + std::abs(c26))});
}

PlaneStiffness isotropic_plane_strain(double young_modulus, double poisson_ratio) {
  const double mu = young_modulus / (2.0 * (1.0 + poisson_ratio));
  const double lambda = young_modulus * poisson_ratio / ((1.0 + poisson_ratio) * (1.0 - 2.0 * poisson_ratio));
  return {
      .c11 = lambda + 2.0 * mu, .c12 = lambda, .c22 = lambda + 2.0 * mu, .c16 = 0.0, .c26 = 0.0, .c66 = mu};
}

WaveSpeeds wave_speeds(const PlaneStiffness& stiffness, double density) {
  return {std::sqrt(std::max(stiffness.c11, stiffness.c22) / density), std::sqrt(stiffness.c66 / density)};
}

}  // namespace crackle
