// SPDX-License-Identifier: GPL-3.0-or-later
//
// Kirsch (1898): a circular hole of radius R in rock under a far-field stress, pressure p inside. With
// a = R/r, S and D mean and half difference of the far-field stresses, θ from x:
//   σ_rr = S(1−a²) + D(1−4a²+3a⁴) cos 2θ − p a²,  σ_θθ = S(1+a²) − D(1+3a⁴) cos 2θ + p a²
//   σ_rθ = −D(1+2a²−3a⁴) sin 2θ
//   u_r = R²/(2Gr) [S + p + D(4(1−ν) − a²) cos 2θ],  u_θ = −R²/(2Gr) D(2(1−2ν) + a²) sin 2θ
// with u the displacement by excavation and pressure (validation.md A2; consistent: see the test).
#pragma once

#include <cmath>

#include "crackle/core/vec2.hpp"

namespace crackle {

struct Kirsch {
  double radius = 0.0;         // [m]
  double shear_modulus = 0.0;  // [Pa]
  double poisson_ratio = 0.0;
  Sym2 far;               // xx and yy [Pa]
  double pressure = 0.0;  // [Pa]

  double mean() const { return 0.5 * (far.xx + far.yy); }
  double half_difference() const { return 0.5 * (far.xx - far.yy); }

  /// Stress in polar components: xx is rr, yy is θθ, xy is rθ [Pa].
  Sym2 polar_stress(Vec2 x) const {
    const double a2 = radius * radius / dot(x, x), a4 = a2 * a2, two = 2.0 * std::atan2(x.y, x.x);
    const double s = mean(), d = half_difference();
    return {s * (1 - a2) + d * (1 - 4 * a2 + 3 * a4) * std::cos(two) - pressure * a2,
            s * (1 + a2) - d * (1 + 3 * a4) * std::cos(two) + pressure * a2,
            -d * (1 + 2 * a2 - 3 * a4) * std::sin(two)};
  }
  Sym2 stress(Vec2 x) const {
    const Sym2 q = polar_stress(x);
    const double r = norm(x), c = x.x / r, s = x.y / r;
    return {c * c * q.xx + s * s * q.yy - 2 * c * s * q.xy, s * s * q.xx + c * c * q.yy + 2 * c * s * q.xy,
            c * s * (q.xx - q.yy) + (c * c - s * s) * q.xy};
  }
  Vec2 displacement(Vec2 x) const {
    const double r = norm(x), a2 = radius * radius / (r * r), two = 2.0 * std::atan2(x.y, x.x);
    const double scale = radius * radius / (2.0 * shear_modulus * r), d = half_difference();
    const double ur = scale * (mean() + pressure + d * (4 * (1 - poisson_ratio) - a2) * std::cos(two));
    const double ut = -scale * d * (2 * (1 - 2 * poisson_ratio) + a2) * std::sin(two);
    return {(ur * x.x - ut * x.y) / r, (ur * x.y + ut * x.x) / r};
  }
};

}  // namespace crackle
