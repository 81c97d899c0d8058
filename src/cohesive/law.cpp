// SPDX-License-Identifier: GPL-3.0-or-later
#include "crackle/cohesive/law.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "crackle/state/coulomb.hpp"

namespace crackle {
namespace {

double stiffness_of(const CohesiveMaterial& m, double length) { return m.penalty / length; }

// Area under the elastic branch from 0 to its peak over (strength x peak displacement).
double branch_area(double curvature) { return 0.5 * (1.0 + curvature) - curvature / 3.0; }

// The elastic branch in its own units: value and area at r in [0, 1].
double branch(double curvature, double r) { return r * (1.0 + curvature - curvature * r); }
double branch_energy(double curvature, double r) {
  return r * r * (0.5 * (1.0 + curvature) - curvature * r / 3.0);
}

std::vector<std::shared_ptr<const CohesiveLaw>>& registry() {
  static std::vector<std::shared_ptr<const CohesiveLaw>> laws;
  return laws;
}

}  // namespace

double CohesiveLaw::largest_stiffness(const CohesiveMaterial& m) const {
  // The friction spring of a yielding edge lies beside what is left of its cohesion.
  return m.penalty + (m.tan_residual > 0.0 ? m.tangential_penalty : 0.0);
}

double CohesiveLaw::softening_opening(const CohesiveMaterial& m, double length) const {
  if (m.calibration == Calibration::y_geo)
    return y_geo_factor() * m.fracture_energy_mode1 / m.tensile_strength;
  const double peak = (1.0 + curvature()) * m.tensile_strength / stiffness_of(m, length);
  // Beyond longest_edge() the elastic branch takes more than G: what is left falls off at once, nearly.
  const double rise = branch_area(curvature()) * m.tensile_strength * peak;
  return std::max(m.fracture_energy_mode1 - rise, 0.01 * m.fracture_energy_mode1) /
         (softening_integral() * m.tensile_strength);
}

double CohesiveLaw::softening_slip(const CohesiveMaterial& m, double length, double normal) const {
  const double strength = shear_strength(m, normal);
  if (m.calibration == Calibration::y_geo) return y_geo_factor() * m.fracture_energy_mode2 / strength;
  // Energy above residual friction, the elastic branch included.
  const double residual = residual_strength(m, normal);
  const double drop = std::max(strength - residual, 0.1 * strength);
  const double peak = (1.0 + curvature()) * strength / stiffness_of(m, length);
  const double rise = (branch_area(curvature()) * strength - residual) * peak;
  return std::max(m.fracture_energy_mode2 - rise, 0.01 * m.fracture_energy_mode2) /
         (softening_integral() * drop);
}

double CohesiveLaw::longest_edge(const CohesiveMaterial& m) const {
  if (m.calibration == Calibration::y_geo) return std::numeric_limits<double>::infinity();
  const double c = branch_area(curvature()) * (1.0 + curvature()) / m.penalty;
  return std::min(m.fracture_energy_mode1 / (c * m.tensile_strength * m.tensile_strength),
                  m.fracture_energy_mode2 / (c * m.cohesion * m.cohesion));
}

double CohesiveLaw::elastic_opening(const CohesiveMaterial& m, double length, double normal) const {
  const double k = stiffness_of(m, length);
  if (normal <= 0.0 || curvature() == 0.0) return normal / k;
  // Inverse of t − t²/(4 f) with t = k o.
  const double f = m.tensile_strength;
  return 2.0 * f * (1.0 - std::sqrt(std::max(0.0, 1.0 - normal / f))) / k;
}

double CohesiveLaw::elastic_slip(const CohesiveMaterial& m, double length, double normal,
                                 double shear) const {
  const double k = stiffness_of(m, length);
  if (curvature() == 0.0) return shear / k;
  const double f = shear_strength(m, normal);
  return std::copysign(2.0 * f * (1.0 - std::sqrt(std::max(0.0, 1.0 - std::abs(shear) / f))) / k, shear);
}

void CohesiveLaw::move(const CohesiveMaterial& m, double length, double opening, double slip,
                       CohesivePoint& p) const {
  const double k = stiffness_of(m, length);
  const double c = curvature();
  const CohesivePoint old = p;
  p.opening = opening;
  p.slip = slip;
  if (p.damage == 0.0) {
    const ElasticTraction t =
        elastic_traction(k, c, m.tensile_strength, m.cohesion, m.tan_friction, opening, slip);
    if (!t.beyond) {
      // Of E_s = t²/2k − c |t|³/(12 k f_s), t = k s, by f_s.
      const double t0 = k * std::abs(old.slip), t1 = k * std::abs(slip);
      p.path += c * (t0 * t0 * t0 + t1 * t1 * t1) / (24.0 * k) *
                (1.0 / shear_strength(m, k * old.opening) - 1.0 / shear_strength(m, k * opening));
      p.normal = t.normal;
      p.shear = t.shear;
      p.friction = 0.0;
      p.stored = elastic_energy(k, c, m.tensile_strength, m.cohesion, m.tan_friction, opening, slip);
      return;
    }
  }
  // Past the strength once: damage grows by the ellipse (Eq. 6.3), never falls.
  const bool first = p.damage == 0.0;
  const double compression = std::min(k * opening, 0.0);  // [Pa], ≤ 0
  const double strength = shear_strength(m, compression);
  const double residual = residual_strength(m, compression);
  const double peak_opening = (1.0 + c) * m.tensile_strength / k;
  const double peak_slip = (1.0 + c) * strength / k;
  const double sliding = std::abs(slip);
  if (p.damage < 1.0) {
    const double d_n = std::max(opening - peak_opening, 0.0) / softening_opening(m, length);
    const double d_s = std::max(sliding - peak_slip, 0.0) / softening_slip(m, length, compression);
    p.damage = std::min(1.0, std::max(p.damage, std::hypot(d_n, d_s)));
  }
  if (p.damage == 0.0) p.damage = std::numeric_limits<double>::min();  // exactly at the peak
  p.opening_max = std::max({p.opening_max, peak_opening, opening});
  p.slip_max = std::max({p.slip_max, peak_slip, sliding});
  const double z = p.damage < 1.0 ? softening(p.damage) : 0.0;

  double stored = 0.0;
  if (opening < 0.0) {
    p.normal = k * opening;
    stored += 0.5 * k * opening * opening;
  } else {
    const double r = std::min(1.0, opening / p.opening_max);
    p.normal = z * m.tensile_strength * branch(c, r);
    stored += z * m.tensile_strength * p.opening_max * branch_energy(c, r);
  }
  const double cohesive = z * std::max(strength - residual, 0.0);
  const double r = std::min(1.0, sliding / p.slip_max);
  p.shear = std::copysign(cohesive * branch(c, r), slip);
  stored += cohesive * p.slip_max * branch_energy(c, r);

  const double k_t = m.tangential_penalty / length;
  if (first) {
    // The elastic branch bore the friction too: start the friction spring where it bears that share.
    const double share = residual * branch(c, r);
    p.plastic_slip = slip - std::copysign(share, slip) / k_t;
    p.path += 0.5 * share * share / k_t - residual * peak_slip * branch_energy(c, r);
  } else if (z > 0.0) {
    const double pressed = std::min(k * old.opening, 0.0);  // before
    const double held = std::max(shear_strength(m, pressed) - residual_strength(m, pressed), 0.0);
    const auto share = [&](const CohesivePoint& q) {  // E_s over what is held
      return softening(q.damage) * q.slip_max *
             branch_energy(c, std::min(1.0, std::abs(q.slip) / q.slip_max));
    };
    p.path += 0.5 * (share(old) + share(p)) * (std::max(strength - residual, 0.0) - held);
  }
  p.friction = coulomb_traction(k_t, slip, residual, p.plastic_slip);
  p.stored = stored + 0.5 * p.friction * p.friction / k_t;
}

void CohesiveLaw::move_lane(const ElementLanes& e, std::size_t lane, PointLanes& points) const {
  CohesiveMaterial m = *e.material[lane];
  m.tensile_strength = e.tensile_strength[lane];
  m.cohesion = e.cohesion[lane];
  m.fracture_energy_mode1 = e.fracture_energy_mode1[lane] + points.given[lane];
  m.fracture_energy_mode2 = e.fracture_energy_mode2[lane] + points.given[lane];
  m.penalty = e.penalty[lane];
  m.tangential_penalty = e.tangential_penalty[lane];
  CohesivePoint& p = *points.point[lane];
  points.for_each_row([&](LaneRow& row, double CohesivePoint::*member) { p.*member = row[lane]; });
  move(m, e.length[lane], points.opening[lane], points.slip[lane], p);
  points.for_each_row([&](LaneRow& row, double CohesivePoint::*member) { row[lane] = p.*member; });
}

void CohesiveLaw::move(const ElementLanes& e, PointLanes& points) const {
  for (std::size_t lane = 0; lane < e.used; ++lane) move_lane(e, lane, points);
}

RegisterLaw::RegisterLaw(std::shared_ptr<const CohesiveLaw> law) { registry().push_back(std::move(law)); }

std::vector<std::shared_ptr<const CohesiveLaw>> registered_laws() {
  auto laws = registry();
  std::sort(laws.begin(), laws.end(), [](const auto& a, const auto& b) { return a->name() < b->name(); });
  return laws;
}

std::shared_ptr<const CohesiveLaw> find_law(const std::string& name) {
  for (const auto& law : registry()) {
    if (law->name() == name) return law;
  }
  return nullptr;
}

ModulusRatio artificial_modulus_ratio(double plane_strain_modulus, double shear_modulus, double penalty,
                                      double sum_length2_over_area) {
  return {1.0 / (1.0 + sum_length2_over_area * plane_strain_modulus / (2.0 * penalty)),
          1.0 / (1.0 + sum_length2_over_area * shear_modulus / penalty)};
}

}  // namespace crackle
