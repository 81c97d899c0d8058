// SPDX-License-Identifier: GPL-3.0-or-later
#include "crackle/solid/stiffness.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "crackle/core/errors.hpp"

namespace crackle {

Sym2 PlaneStiffness::strain(Sym2 s) const {
  // Cofactors of the matrix over (E_xx, E_yy, 2 E_xy).
  const double xx = c22 * c66 - c26 * c26, xy = c16 * c26 - c12 * c66, xs = c12 * c26 - c22 * c16;
  const double yy = c11 * c66 - c16 * c16, ys = c12 * c16 - c11 * c26, ss = c11 * c22 - c12 * c12;
  const double q = 1.0 / (c11 * xx + c12 * xy + c16 * xs);
  return {q * (xx * s.xx + xy * s.yy + xs * s.xy), q * (xy * s.xx + yy * s.yy + ys * s.xy),
          0.5 * q * (xs * s.xx + ys * s.yy + ss * s.xy)};
}

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

PlaneStiffness transversely_isotropic_plane_strain(const TransverseIsotropy& rock) {
  const double n = rock.young_modulus / rock.young_modulus_normal;
  const double nu = rock.poisson_ratio_normal;
  const double delta = 1.0 - rock.poisson_ratio - 2.0 * n * nu * nu;
  if (!(delta > 0.0)) {
    throw CaseError(fmt::format(
        "bedded rock with Poisson's ratios {:g} and {:g} and moduli {:g} and {:g} Pa would release "
        "energy when strained: 1 - nu_h - 2 nu_vh^2 E_h/E_v = {:g} has to be above 0",
        rock.poisson_ratio, nu, rock.young_modulus, rock.young_modulus_normal, delta));
  }
  const PlaneStiffness level{
      .c11 = rock.young_modulus * (1.0 - n * nu * nu) / ((1.0 + rock.poisson_ratio) * delta),
      .c12 = rock.young_modulus * nu / delta,
      .c22 = rock.young_modulus_normal * (1.0 - rock.poisson_ratio) / delta,
      .c66 = rock.shear_modulus_normal};
  return turned(level, rock.bedding_angle);
}

PlaneStiffness turned(const PlaneStiffness& stiffness, double angle) {
  if (angle == 0.0) return stiffness;
  const double c = std::cos(angle), s = std::sin(angle);
  // Components of a tensor after turning it by (c, s).
  const auto turn = [](Sym2 t, double cos, double sin) {
    return Sym2{cos * cos * t.xx + sin * sin * t.yy - 2.0 * sin * cos * t.xy,
                sin * sin * t.xx + cos * cos * t.yy + 2.0 * sin * cos * t.xy,
                sin * cos * (t.xx - t.yy) + (cos * cos - sin * sin) * t.xy};
  };
  const auto stress_of = [&](Sym2 strain) { return turn(stiffness.stress(turn(strain, c, -s)), c, s); };
  const Sym2 xx = stress_of({1.0, 0.0, 0.0}), yy = stress_of({0.0, 1.0, 0.0}),
             xy = stress_of({0.0, 0.0, 0.5});
  return {.c11 = xx.xx, .c12 = xx.yy, .c22 = yy.yy, .c16 = xx.xy, .c26 = yy.xy, .c66 = xy.xy};
}

namespace {

// Symmetric matrix over (xx, yy, √2 xy), in which stiffness and compliance are each other's inverse.
struct Mandel {
  double a, b, c, d, e, f;  // rows (a b c), (b d e), (c e f)
  double determinant() const { return a * (d * f - e * e) - b * (b * f - c * e) + c * (b * e - c * d); }
  bool positive() const { return a > 0.0 && a * d - b * b > 0.0 && determinant() > 0.0; }
  Mandel inverse() const {
    const double q = 1.0 / determinant();
    return {q * (d * f - e * e), q * (c * e - b * f), q * (b * e - c * d),
            q * (a * f - c * c), q * (b * c - a * e), q * (a * d - b * b)};
  }
};

}  // namespace

PlaneStiffness compensated(const PlaneStiffness& stiffness, double compliance) {
  const double r2 = std::numbers::sqrt2;
  Mandel m = Mandel{stiffness.c11, stiffness.c12,      r2 * stiffness.c16,
                    stiffness.c22, r2 * stiffness.c26, 2.0 * stiffness.c66}
                 .inverse();
  m.a -= compliance;
  m.d -= compliance;
  m.f -= compliance;
  if (!m.positive()) {
    throw CaseError(
        fmt::format("the cohesive elements alone are more compliant (by {:.3g} 1/Pa) than the rock, which no "
                    "stiffness of the triangles can make up for: take a larger cohesive.penalty",
                    compliance));
  }
  const Mandel c = m.inverse();
  return {.c11 = c.a, .c12 = c.b, .c22 = c.d, .c16 = c.c / r2, .c26 = c.e / r2, .c66 = 0.5 * c.f};
}

WaveSpeeds wave_speeds(const PlaneStiffness& stiffness, double density, Vec2 direction) {
  const PlaneStiffness& c = stiffness;
  const Vec2 n = direction;
  // Eigenvalues of the acoustic tensor n·C·n (Christoffel).
  const double xx = c.c11 * n.x * n.x + 2.0 * c.c16 * n.x * n.y + c.c66 * n.y * n.y;
  const double yy = c.c66 * n.x * n.x + 2.0 * c.c26 * n.x * n.y + c.c22 * n.y * n.y;
  const double xy = c.c16 * n.x * n.x + (c.c12 + c.c66) * n.x * n.y + c.c26 * n.y * n.y;
  const double mean = 0.5 * (xx + yy), radius = std::hypot(0.5 * (xx - yy), xy);
  return {std::sqrt((mean + radius) / density), std::sqrt((mean - radius) / density)};
}

WaveSpeeds wave_speeds(const PlaneStiffness& stiffness, double density) {
  WaveSpeeds fastest;
  for (int degree = 0; degree < 180; ++degree) {
    const double angle = degree * std::numbers::pi / 180.0;
    const WaveSpeeds w = wave_speeds(stiffness, density, {std::cos(angle), std::sin(angle)});
    fastest = {std::max(fastest.p, w.p), std::max(fastest.s, w.s)};
  }
  return fastest;
}

}  // namespace crackle
