// SPDX-License-Identifier: GPL-3.0-or-later
#include "crackle/cohesive/interface.hpp"

namespace crackle {

InterfaceLaw::InterfaceLaw(std::shared_ptr<const CohesiveLaw> law, double strength, double fracture_energy,
                           Closure closure, ShearLaw shear)
    : law_(std::move(law)),
      strength_(strength),
      fracture_energy_(fracture_energy),
      closure_(closure),
      shear_(shear) {
  elastic_ = 0.002 * 2.0 * fracture_energy / strength_;
  softening_ = (fracture_energy - 0.5 * strength_ * elastic_) / (strength_ * law_->softening_integral());
}

// An intact bond that is pressed is at least as stiff as one that bears nothing at first.
double InterfaceLaw::bond_stiffness(double opening, double in_situ) const {
  return (strength_ - (opening < 0.0 ? std::min(in_situ, 0.0) : in_situ)) / elastic_;
}

TractionSlope InterfaceLaw::traction(double opening, double max_opening, double in_situ) const {
  if (std::max(opening, max_opening) <= elastic_) {
    const double stiffness = bond_stiffness(opening, in_situ);
    return {in_situ + stiffness * opening, stiffness};
  }
  const double largest = std::max(opening, max_opening);
  const double d = damage(largest);
  TractionSlope t;
  if (opening < max_opening) {
    t = closure_.traction(opening, max_opening);
    if (d < 1.0) {
      const double secant = strength_ * law_->softening(d) / max_opening;
      t.traction += secant * opening;
      t.slope += secant;
    }
  } else if (d < 1.0) {
    constexpr double step = 1e-5;
    const double low = std::max(d - step, 0.0), high = std::min(d + step, 1.0);
    t.traction = strength_ * law_->softening(d);
    t.slope = strength_ * (law_->softening(high) - law_->softening(low)) / ((high - low) * softening_);
  }
  return t;
}

// Asperities below a fiftieth of their height (a third, of fresh faces): the hyperbola goes on as its
// tangent.
double InterfaceLaw::least_opening(double largest) const {
  return largest < closure_.residual_aperture ? 0.3 * largest : 0.02 * closure_.residual_aperture;
}

MixedTraction InterfaceLaw::traction(double opening, double slip, double max_opening, double plastic_slip,
                                     double in_situ, double in_situ_shear) const {
  const double beta2 = shear_.ratio * shear_.ratio, wide = std::max(opening, 0.0);
  const double largest = std::max(wide, max_opening);
  const double in = opening > 0.0 ? 1.0 : 0.0;
  MixedTraction t;
  t.plastic_slip = plastic_slip;
  if (largest <= elastic_) {
    t.nn = bond_stiffness(opening, in_situ);
    t.normal = in_situ + t.nn * opening;
    t.shear = in_situ_shear * (1.0 - wide / elastic_) + beta2 * strength_ / elastic_ * slip;
    t.sn = -in * in_situ_shear / elastic_;
    t.ss = beta2 * strength_ / elastic_;
    return t;
  }
  if (const double d = damage(largest); d < 1.0) {
    const double secant = strength_ * law_->softening(d) / largest;
    double slope = 0.0;  // of the secant by the opening
    if (wide >= max_opening) {
      constexpr double step = 1e-5;
      const double low = std::max(d - step, 0.0), high = std::min(d + step, 1.0);
      slope = (strength_ * (law_->softening(high) - law_->softening(low)) / ((high - low) * softening_) -
               secant) /
              wide;
    }
    t.normal = secant * wide;
    t.shear = secant * beta2 * slip;
    t.nn = in * secant + wide * slope;
    t.sn = beta2 * slip * slope;
    t.ss = beta2 * secant;
  }
  const double least = least_opening(largest);
  TractionSlope pressed = closure_.traction(std::max(opening, least), largest);
  if (opening < least) pressed.traction += pressed.slope * (opening - least);
  t.normal += pressed.traction;
  t.nn += pressed.slope;
  const double stiffness = friction_stiffness();
  const double limit = -shear_.friction * pressed.traction;
  t.friction = in_situ_shear + stiffness * (slip - plastic_slip);
  if (std::abs(t.friction) <= limit) {
    t.ss += stiffness;
  } else {
    const double sign = t.friction > 0.0 ? 1.0 : -1.0;
    t.friction = sign * limit;
    t.sn -= sign * shear_.friction * pressed.slope;
    t.plastic_slip = slip - (t.friction - in_situ_shear) / stiffness;
  }
  t.shear += t.friction;
  return t;
}

double InterfaceLaw::stored(double opening, double max_opening, double in_situ) const {
  const double largest = std::max(opening, max_opening);
  if (largest <= elastic_) return opening * (in_situ + 0.5 * bond_stiffness(opening, in_situ) * opening);
  const double d = damage(largest), wide = std::max(opening, 0.0), least = least_opening(largest);
  const double pressed = std::max(opening, least), beyond = opening - pressed;
  const TractionSlope t = closure_.traction(pressed, largest);
  // the bond's in-situ stress was given up on the elastic branch
  return 0.5 * in_situ * elastic_ + 0.5 * strength_ * law_->softening(d) * wide * wide / largest +
         closure_.energy(pressed, largest) + (t.traction + 0.5 * t.slope * beyond) * beyond;
}

double InterfaceLaw::cohesion(double max_opening) const {
  const double d = damage(max_opening);
  return d > 0.0 && d < 1.0 ? strength_ * law_->softening(d) : 0.0;
}

double InterfaceLaw::shear_stiffness(double max_opening) const {
  const double beta2 = shear_.ratio * shear_.ratio;
  return beta2 * (max_opening <= elastic_ ? strength_ / elastic_ : cohesion(max_opening) / max_opening);
}

double InterfaceLaw::stored_by_slip(double opening, double slip, double max_opening, double friction,
                                    double in_situ_shear) const {
  const double largest = std::max(opening, max_opening);
  const double bond = 0.5 * shear_stiffness(largest) * slip * slip;
  if (largest <= elastic_) return bond + in_situ_shear * slip * (1.0 - std::max(opening, 0.0) / elastic_);
  return bond + 0.5 * friction * friction / friction_stiffness();
}

double InterfaceLaw::dissipated(double max_opening) const {
  if (max_opening <= elastic_) return 0.0;
  const double d = damage(max_opening);
  if (d >= 1.0) return fracture_energy_;
  constexpr int pieces = 32;  // Simpson
  double sum = 0.0;
  for (int i = 0; i < pieces; ++i) {
    const double a = d * i / pieces, b = d * (i + 1) / pieces;
    sum += (b - a) / 6.0 *
           (law_->softening(a) + 4.0 * law_->softening(0.5 * (a + b)) + law_->softening(std::min(b, 1.0)));
  }
  return 0.5 * strength_ * elastic_ + strength_ * softening_ * sum -
         0.5 * strength_ * law_->softening(d) * max_opening;
}

}  // namespace crackle
