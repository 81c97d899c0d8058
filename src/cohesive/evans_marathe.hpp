// SPDX-License-Identifier: GPL-3.0-or-later
//
// Softening of Evans and Marathe (1968), as fitted by Munjiza, Andrews and White (1999):
//   z(D) = [1 − (a+b−1)/(a+b) exp(D (a + c b) / ((a+b)(1−a−b)))] [a (1−D) + b (1−D)^c]
//   a = 0.63, b = 1.8, c = 6;  z(0) = 1, z(1) = 0, z'(0) = 0, ∫₀¹ z dD = 0.38630729474394
#pragma once

namespace crackle {

/// exp(y) for |y| < ½ from its term n on, over that term, to round-off: without a call, so that a loop over
/// points vectorises, and the same in every C library.
template <int n = 1>
[[gnu::always_inline]] inline double exponential_series(double y) {
  if constexpr (n > 13) {
    return 1.0;
  } else {
    return 1.0 + y * (1.0 / n) * exponential_series<n + 1>(y);
  }
}

/// Share z of the strength left at damage D in [0, 1].
[[gnu::always_inline]] inline double evans_marathe_softening(double damage) {
  constexpr double a = 0.63, b = 1.8, c = 6.0, rate = (a + c * b) / ((a + b) * (1.0 - a - b));  // −3.29
  const double left = 1.0 - damage, cube = left * left * left;
  const double eighth = exponential_series(damage * (0.125 * rate));
  const double half = (eighth * eighth) * (eighth * eighth);
  return (1.0 - (a + b - 1.0) / (a + b) * (half * half)) * (a * left + b * cube * cube);
}
/// Its integral over D from 0 to 1.
inline constexpr double evans_marathe_integral = 0.38630729474394;

}  // namespace crackle
