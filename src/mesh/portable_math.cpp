// SPDX-License-Identifier: GPL-3.0-or-later
#include "portable_math.hpp"

#include <cmath>
#include <numbers>

namespace crackle::meshing {

Vec2 direction_in_first_octant(double angle) {
  const double square = angle * angle;
  double cosine = 0.0, sine = 0.0;
  for (int n = 20; n >= 0; n -= 2) {  // Horner: 1 - x^2/(1*2) (1 - x^2/(3*4) (...))
    cosine = 1.0 - square / ((n + 1.0) * (n + 2.0)) * cosine;
    sine = 1.0 - square / ((n + 2.0) * (n + 3.0)) * sine;
  }
  return {cosine, angle * sine};
}

Vec2 portable_direction(double angle) {
  constexpr double quarter = 0.5 * std::numbers::pi;
  const double turns = std::floor(angle / quarter + 0.5);
  const double rest = angle - turns * quarter;
  Vec2 d = direction_in_first_octant(std::abs(rest));
  if (rest < 0.0) d.y = -d.y;
  const int quarters = static_cast<int>(turns - 4.0 * std::floor(0.25 * turns));
  for (int k = 0; k < quarters; ++k) d = {-d.y, d.x};
  return d;
}

double portable_log(double x) {
  int exponent = 0;
  double m = std::frexp(x, &exponent);  // x = m 2^exponent, exactly
  if (m < 0.5 * std::numbers::sqrt2) {
    m *= 2.0;
    --exponent;
  }
  const double z = (m - 1.0) / (m + 1.0), square = z * z;
  double sum = 0.0;  // ln m = 2 (z + z^3/3 + z^5/5 + ...), |z| < 0.172
  for (int n = 27; n >= 1; n -= 2) sum = sum * square + 1.0 / n;
  return 2.0 * z * sum + exponent * std::numbers::ln2;
}

double portable_exp(double x) {
  if (x < -700.0) return 0.0;
  const double twos = std::floor(x / std::numbers::ln2 + 0.5);
  const double rest = x - twos * std::numbers::ln2;
  double sum = 1.0;
  for (int n = 20; n >= 1; --n) sum = 1.0 + rest / n * sum;
  return std::ldexp(sum, static_cast<int>(twos));
}

}  // namespace crackle::meshing
