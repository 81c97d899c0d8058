// SPDX-License-Identifier: GPL-3.0-or-later
//
// Softening of Evans and Marathe (1968), see evans_marathe.hpp.
// Elastic branch: parabola. Softening length in Y-Geo: 3 G / f.
#include "evans_marathe.hpp"

#include "crackle/cohesive/law.hpp"

namespace crackle {

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
