// SPDX-License-Identifier: GPL-3.0-or-later
//
// The constant-strain triangle of bulk.hpp, formula by formula, over a number type V: a double, or a vector
// of doubles (a GCC vector, one triangle a lane). The same operations in the same order: the same bits.
#pragma once

#include <algorithm>
#include <cmath>

#include "crackle/solid/stiffness.hpp"

namespace crackle {

/// A stress limit with which triangles near their strength are found on the way: stressed where the
/// largest principal stress passes `tension`, or where |τ| + σ_n tan φ does `shear` on some plane.
struct StressScreen {
  double tension = 0.0;  ///< [Pa]
  double shear = 0.0;    ///< [Pa]
  double tan_friction = 0.0;
};

/// One that all pass who pass one of the two.
inline StressScreen either(const StressScreen& a, const StressScreen& b) {
  StressScreen both{std::min(a.tension, b.tension), std::min(a.shear, b.shear), a.tan_friction};
  if (a.tan_friction != b.tan_friction) {
    // Without friction a triangle passes earlier, as long as it is pressed.
    const auto frictionless = [](const StressScreen& s) {
      return s.shear / std::sqrt(1.0 + s.tan_friction * s.tan_friction);
    };
    both.shear = std::min(frictionless(a), frictionless(b));
    both.tan_friction = 0.0;
  }
  return both;
}

namespace triangle {

template <class V>
struct Shape {  ///< ∇N_1 = (x1, y1), ∇N_2 = (x2, y2) [1/m]
  V x1, y1, x2, y2;
};

template <class V>
struct Gradient {  ///< g_ij = ∂a_i/∂X_j of a vector field
  V xx, xy, yx, yy;
};

template <class V>
struct Tensor {  ///< symmetric
  V xx, yy, xy;
};

template <class V>
struct Forces {  ///< on corners 1 and 2 [N/m]; corner 0 gets what is left
  V x1, y1, x2, y2;
};

/// Of a field with differences d1 and d2 from corner 0 to corners 1 and 2.
template <class V>
[[gnu::always_inline]] inline Gradient<V> gradient(const Shape<V>& n, V d1x, V d1y, V d2x, V d2y) {
  return {d1x * n.x1 + d2x * n.x2, d1x * n.y1 + d2x * n.y2, d1y * n.x1 + d2y * n.x2, d1y * n.y1 + d2y * n.y2};
}

template <class V>
[[gnu::always_inline]] inline Tensor<V> green_strain(const Gradient<V>& h) {
  return {h.xx + 0.5 * (h.xx * h.xx + h.yx * h.yx), h.yy + 0.5 * (h.xy * h.xy + h.yy * h.yy),
          0.5 * (h.xy + h.yx + h.xx * h.xy + h.yx * h.yy)};
}

/// Ė = sym(Fᵀ ∂v/∂X), h = F − I.
template <class V>
[[gnu::always_inline]] inline Tensor<V> strain_rate(const Gradient<V>& h, const Gradient<V>& g) {
  const V fxx = 1.0 + h.xx, fyy = 1.0 + h.yy;
  return {fxx * g.xx + h.yx * g.yx, h.xy * g.xy + fyy * g.yy,
          0.5 * (fxx * g.xy + h.yx * g.yy + h.xy * g.xx + fyy * g.yx)};
}

template <class V>
[[gnu::always_inline]] inline Tensor<V> stress(const PlaneStiffness& c, const Tensor<V>& e) {
  const V shear = 2.0 * e.xy;
  return {c.c11 * e.xx + c.c12 * e.yy + c.c16 * shear, c.c12 * e.xx + c.c22 * e.yy + c.c26 * shear,
          c.c16 * e.xx + c.c26 * e.yy + c.c66 * shear};
}

/// Viscous power of a triangle [W/m] from the last two strain rates.
template <class V>
[[gnu::always_inline]] inline V viscous_power(V area, V viscosity, const Tensor<V>& rate,
                                              const Tensor<V>& before) {
  return area * viscosity *
         (rate.xx * (0.5 * (rate.xx + before.xx)) + rate.yy * (0.5 * (rate.yy + before.yy)) +
          2.0 * rate.xy * (0.5 * (rate.xy + before.xy)));
}

/// Whether a stress passes the screen, by Mohr's circle without its root; at these strains the second
/// Piola-Kirchhoff stress is the stress. A bool, or a mask of lanes.
template <class V>
[[gnu::always_inline]] inline auto passes(const StressScreen& screen, const Tensor<V>& s) {
  const V mean = 0.5 * (s.xx + s.yy), half = 0.5 * (s.xx - s.yy);
  const V radius2 = half * half + s.xy * s.xy;
  const V tension = screen.tension - mean, shear = screen.shear - mean * screen.tan_friction;
  const double secant2 = 1.0 + screen.tan_friction * screen.tan_friction;
  return (tension < 0.0) | (radius2 > tension * tension) | (shear < 0.0) |
         (radius2 * secant2 > shear * shear);
}

/// P = F S, f_i = −A P ∇N_i.
template <class V>
[[gnu::always_inline]] inline Forces<V> forces(const Gradient<V>& h, const Tensor<V>& s, const Shape<V>& n,
                                               V area) {
  const V fxx = 1.0 + h.xx, fyy = 1.0 + h.yy;
  const V pxx = fxx * s.xx + h.xy * s.xy, pxy = fxx * s.xy + h.xy * s.yy;
  const V pyx = h.yx * s.xx + fyy * s.xy, pyy = h.yx * s.xy + fyy * s.yy;
  return {-area * (pxx * n.x1 + pxy * n.y1), -area * (pyx * n.x1 + pyy * n.y1),
          -area * (pxx * n.x2 + pxy * n.y2), -area * (pyx * n.x2 + pyy * n.y2)};
}

}  // namespace triangle
}  // namespace crackle
