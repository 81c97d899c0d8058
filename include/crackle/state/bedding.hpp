// SPDX-License-Identifier: GPL-3.0-or-later
//
// Strengths and fracture energies of bedded rock, by the plane that breaks. With α the angle of its normal
// from that of the bedding each value is
//   v(α) = v_m + (v_b − v_m) cos^{2m} α
// v_b on planes along the bedding, v_m on those across it. m = 1 is the form linear in the microstructure
// tensor of Pietruszczak and Mroz (2001, Int. J. Numer. Anal. Meth. Geomech. 25, 509, Eqs 7-9, transversely
// isotropic); with a larger m rock is weak only nearer to the bedding.
//
// | parameter             | unit | range |                                   |
// |-----------------------|------|-------|-----------------------------------|
// | tensile_strength      | Pa   | > 0   | v_b of it, and so on              |
// | cohesion              | Pa   | > 0   |                                   |
// | fracture_energy_mode1 | J/m2 | > 0   |                                   |
// | fracture_energy_mode2 | J/m2 | > 0   |                                   |
// | exponent              | -    | > 0   | m; 0: the same in all directions  |
//
// Limits: friction angles are the same on all planes.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "crackle/core/vec2.hpp"

namespace crackle {

/// What the planes along the bedding have instead of the rock's values.
struct Bedding {
  Vec2 normal{0.0, 1.0};  ///< of the bedding, unit
  double exponent = 0.0;
  double tensile_strength = 0.0;
  double cohesion = 0.0;
  double fracture_energy_mode1 = 0.0;
  double fracture_energy_mode2 = 0.0;

  explicit operator bool() const { return exponent > 0.0; }
  /// cos^{2m} α of a plane. @param of_plane its normal, unit
  double share(Vec2 of_plane) const {
    const double cosine = dot(normal, of_plane), square = cosine * cosine;
    return exponent == 1.0 ? square : std::pow(square, exponent);  // pow() differs between C libraries
  }
};

/// A material (one with the members above and a Bedding) as it is on a plane. @param normal of it, unit
template <class Material>
Material on_plane(const Material& rock, Vec2 normal) {
  const Bedding& b = rock.bedding;
  if (!b) return rock;
  Material m = rock;
  const double share = b.share(normal);
  m.tensile_strength += share * (b.tensile_strength - rock.tensile_strength);
  m.cohesion += share * (b.cohesion - rock.cohesion);
  m.fracture_energy_mode1 += share * (b.fracture_energy_mode1 - rock.fracture_energy_mode1);
  m.fracture_energy_mode2 += share * (b.fracture_energy_mode2 - rock.fracture_energy_mode2);
  m.bedding = {};
  return m;
}

/// With the lowest values of all planes.
template <class Material>
Material weakest_plane(const Material& rock) {
  const Bedding& b = rock.bedding;
  if (!b) return rock;
  Material m = rock;
  m.tensile_strength = std::min(m.tensile_strength, b.tensile_strength);
  m.cohesion = std::min(m.cohesion, b.cohesion);
  m.fracture_energy_mode1 = std::min(m.fracture_energy_mode1, b.fracture_energy_mode1);
  m.fracture_energy_mode2 = std::min(m.fracture_energy_mode2, b.fracture_energy_mode2);
  m.bedding = {};
  return m;
}

/// As it is across the bedding and along it: all else lies between. One, where there is none.
template <class Material>
std::vector<Material> extreme_planes(const Material& rock) {
  if (!rock.bedding) return {rock};
  return {on_plane(rock, {-rock.bedding.normal.y, rock.bedding.normal.x}),
          on_plane(rock, rock.bedding.normal)};
}

}  // namespace crackle
