// SPDX-License-Identifier: GPL-3.0-or-later
//
// Linear softening after a straight elastic branch (Hillerborg, Modéer, Petersson 1976; Camacho and
// Ortiz 1996):
//   z(D) = 1 − D,  ∫₀¹ z dD = ½
// The "y_geo" calibration ignores the elastic branch, as Y-Geo does: softening length 2 G / f.
#include "crackle/cohesive/law.hpp"

namespace crackle {
namespace {

class Linear final : public CohesiveLaw {
 public:
  std::string name() const override { return "linear"; }
  std::string description() const override {
    return "straight rise and straight softening (Hillerborg et al. 1976)";
  }
  double curvature() const override { return 0.0; }
  double softening(double damage) const override { return 1.0 - damage; }
  double softening_integral() const override { return 0.5; }
  double y_geo_factor() const override { return 2.0; }
};

const RegisterLaw registration{std::make_shared<Linear>()};

}  // namespace
}  // namespace crackle
