// SPDX-License-Identifier: GPL-3.0-or-later
//
// Softening of Evans and Marathe (1968), as fitted by Munjiza, Andrews and White (1999):
//   z(D) = [1 − (a+b−1)/(a+b) exp(D (a + c b) / ((a+b)(1−a−b)))] [a (1−D) + b (1−D)^c]
//   a = 0.63, b = 1.8, c = 6;  z(0) = 1, z(1) = 0, z'(0) = 0, ∫₀¹ z dD = 0.38630729474394
// Elastic branch: parabola. Softening length in Y-Geo: 3 G / f.
#include "evans_marathe.hpp"

#include <cmath>

#include "crackle/cohesive/law.hpp"

namespace crackle {

double evans_marathe_softening(double damage) {
  constexpr double a = 0.63, b = 1.8, c = 6.0;
  const double left = 1.0 - damage;
  const double cube = left * left * left;
  return (1.0 - (a + b - 1.0) / (a + b) * std::exp(damage * (a + c * b) / ((a + b) * (1.0 - a - b)))) *
         (a * left + b * cube * cube);
}

namespace {

class EvansMarathe final : public CohesiveLaw {
 public:
  std::string name() const override { return "evans_marathe"; }
  std::string description() const override {
    return "parabolic rise, softening curve of Evans & Marathe (1968) after Munjiza et al. (1999)";
  }
  double curvature() const override { return 1.0; }
  double softening(double damage) const override { return evans_marathe_softening(damage); }
  double softening_integral() const override { return evans_marathe_integral; }
  double y_geo_factor() const override { return 3.0; }
};

const RegisterLaw registration{std::make_shared<EvansMarathe>()};

}  // namespace
}  // namespace crackle
