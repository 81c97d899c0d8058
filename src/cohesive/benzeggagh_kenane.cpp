// SPDX-License-Identifier: GPL-3.0-or-later
//
// Damage with friction on the damaged share of an edge (Alfano and Sacco 2006), mixed mode of
// Benzeggagh and Kenane (1996), softening curve of Evans and Marathe (1968). Of an edge the share d is
// broken; the rest is elastic, and the broken share rubs as a spring k in series with a Coulomb slider:
//   energy      ψ = ½ (1−d) k (⟨o⟩² + s²) + ½ k ⟨−o⟩² + ½ d k (s − sₚ)²,   k = p_f / L
//   tractions   σ = (1−d) k ⟨o⟩ − k ⟨−o⟩,   τ = (1−d) k s + d k (s − sₚ)
//   friction    |k (s − sₚ)| ≤ f_r = k ⟨−o⟩ tan φ_f
//   separation  δ = √(⟨o⟩² + sₚ²); sₚ is all of s where the edge is open
//   damage      d = 1 − z(D) δ₀/δ,  D = (δ − δ₀)/δ_t, never falls
//   onset       k δ₀ = t₀: the nearer of σ = f_t and |τ| = f_s on the present ray, that is
//               Mohr-Coulomb with tension cut-off, f_s = c + k ⟨−o⟩ tan φ_i
//   energy      G = G_I + (G_II − G_I) B^η,  B = sₚ²/δ²;   δ_t = (G − ½ t₀ δ₀)/(I t₀)
//
// η is 4 by default. An edge that lies askew to a fracture opens and slides at once; the nearest edge of a
// mesh is up to 30° off. With G_II = 16 G_I a fracture on such edges dissipates 1.32 G_I per area with η = 2
// and 1.05 G_I with 4 (cases/accuracy_speed).
//
// Damage dissipates ½ k δ² per share, which sums to G on every straight ray, and friction
// f_r d(d sₚ): neither is ever negative, whatever the path, and with ψ they make up all work, also where
// the normal stress changes on the way. The stiffness across a closed edge stays k throughout, and no
// slope exceeds k.
//
// Parameters as in law.hpp, but that the friction spring is the elastic one: tangential_penalty has
// no part in it. `damage` of a point is d, and its plastic_slip the mean d sₚ over the edge.
// Limits: an edge longer than longest_edge() dissipates more than G.
#include <cmath>

#include "crackle/cohesive/law.hpp"
#include "crackle/core/parallel.hpp"
#include "evans_marathe.hpp"

namespace crackle {
namespace {

struct Point {
  double damage, plastic_slip, normal, shear, friction, stored;
};

// Of the material and the edge.
struct Numbers {
  double stiffness, tensile_strength, cohesion, tan_friction, tan_residual, energy1, energy2, exponent;
  bool exact;
};

// Products where they will do: pow() is slow, and another in every C library.
bool by_products(double exponent) { return exponent == 4.0 || exponent == 2.0; }
struct Products {
  double operator()(double base, double exponent) const {
    const double square = base * base;
    return exponent == 4.0 ? square * square : square;
  }
};
struct Power {
  double operator()(double base, double exponent) const {
    return by_products(exponent) ? Products()(base, exponent) : std::pow(base, exponent);
  }
};

// Without a branch, so that a loop over points vectorises.
template <class P>
[[gnu::always_inline]] inline Point moved(const Numbers& m, double opening, double slip, double damage,
                                          double plastic_slip, const P& power) {
  const double k = m.stiffness;
  const double pull = opening > 0.0 ? opening : 0.0, push = opening < 0.0 ? -opening : 0.0;
  const double strength = m.cohesion + k * push * m.tan_friction;
  const double residual = k * push * m.tan_residual;
  // The slider of the broken share.
  const double before = damage > 0.0 ? plastic_slip / damage : 0.0;
  const double trial = k * (slip - before);
  const double rub = trial > residual ? residual : trial < -residual ? -residual : trial;
  double slid = rub == trial ? before : slip - rub / k;

  // The nearer of both strengths on the present ray is `limit`, reached by the component `along`. Of a closed
  // edge softens what is above residual friction.
  const double slide = std::abs(slid);
  const double square = pull * pull + slid * slid;
  const double separation = std::sqrt(square);
  const bool open = pull > 0.0;
  const bool shears = !open || m.tensile_strength * slide > m.cohesion * pull;
  const double above = strength - residual, least = 0.1 * strength;
  const double drop = above > least ? above : least;
  const double limit = open ? (shears ? m.cohesion : m.tensile_strength) : drop;
  const double share = limit / (k * (shears ? slide : pull));  // δ₀/δ
  const double onset = share * separation, peak = k * onset;
  const double mixed = m.energy1 + (m.energy2 - m.energy1) * power(slid * slid / square, m.exponent);
  const double energy = open ? mixed : m.energy2;
  const double rise = open ? 0.5 * peak * onset : (0.5 * strength - residual) * (strength / k);
  const double rest = energy - rise, floor = 0.01 * energy;
  const double soft = m.exact ? (rest > floor ? rest : floor) : 3.0 * energy;  // δ_t times what it falls from
  const double from = m.exact ? evans_marathe_integral * (open ? peak : drop) : (open ? peak : strength);
  const double done = (separation - onset) * from / soft;
  const double broken = done < 1.0 ? 1.0 - evans_marathe_softening(done) * share : 1.0;
  const bool grows = share < 1.0 && broken > damage;
  const double d = grows ? broken : damage;
  const bool whole = d == 0.0;  // nothing is broken yet that could rub
  slid = whole ? 0.0 : slid;

  Point p;
  p.damage = d;
  p.plastic_slip = d * slid;
  p.friction = whole ? 0.0 : rub;
  const double left = 1.0 - d, stuck = slip - slid;
  p.normal = k * (left * pull - push);
  p.shear = k * (slip - p.plastic_slip) - p.friction;
  p.stored = 0.5 * k * (left * (pull * pull + slip * slip) + d * (stuck * stuck) + push * push);
  return p;
}

template <class P>
[[gnu::always_inline]] inline void move_lanes(const ElementLanes& e, const LaneRow& exponent,
                                              const LaneRow& exact, PointLanes& p, const P& power) {
#pragma omp simd
  for (std::size_t l = 0; l < element_lanes; ++l) {
    const Numbers m{e.penalty[l] / e.length[l],
                    e.tensile_strength[l],
                    e.cohesion[l],
                    e.tan_friction[l],
                    e.tan_residual[l],
                    e.fracture_energy_mode1[l] + p.given[l],
                    e.fracture_energy_mode2[l] + p.given[l],
                    exponent[l],
                    exact[l] > 0.0};
    const Point now = moved(m, p.opening[l], p.slip[l], p.damage[l], p.plastic_slip[l], power);
    p.damage[l] = now.damage;
    p.plastic_slip[l] = now.plastic_slip;
    p.normal[l] = now.normal;
    p.shear[l] = now.shear;
    p.friction[l] = now.friction;
    p.stored[l] = now.stored;
  }
}

CRACKLE_KERNEL void move_by_products(const ElementLanes& e, const LaneRow& exponent, const LaneRow& exact,
                                     PointLanes& p) {
  move_lanes(e, exponent, exact, p, Products());
}

class BenzeggaghKenane final : public CohesiveLaw {
 public:
  std::string name() const override { return "benzeggagh_kenane"; }
  std::string description() const override {
    return "secant damage with friction on the damaged share (Alfano & Sacco 2006), mixed mode of Benzeggagh "
           "& Kenane (1996)";
  }
  std::string formulas() const override {
    return "  tractions  sigma = (1 - d) k <o> - k <-o>, tau = (1 - d) k s + d k (s - s_p), k = p_f / L\n"
           "  strength   f_s = cohesion + k <-o> tan(phi_i), Mohr-Coulomb with tension cut-off f_t\n"
           "  friction   |k (s - s_p)| <= k <-o> tan(phi_f) on the damaged share d\n"
           "  damage     d = 1 - z(D) delta_0/delta, D = (delta - delta_0)/delta_t, never falls;\n"
           "             delta^2 = <o>^2 + s_p^2, t_0 = k delta_0 at the strength, z as in evans_marathe\n"
           "  energy     G = G_I + (G_II - G_I) B^eta, B = s_p^2/delta^2\n"
           "  lengths    calibration \"exact\": delta_t = (G - t_0 delta_0/2)/(I t_0), I = 0.386307;\n"
           "             calibration \"y_geo\": delta_t = 3 G/t_0\n";
  }
  double curvature() const override { return 0.0; }
  double softening(double damage) const override { return evans_marathe_softening(damage); }
  double softening_integral() const override { return evans_marathe_integral; }
  double y_geo_factor() const override { return 3.0; }
  bool conserves_energy() const override { return true; }
  double largest_stiffness(const CohesiveMaterial& m) const override { return m.penalty; }
  double friction_penalty(const CohesiveMaterial& m) const override { return m.penalty; }

  void move(const CohesiveMaterial& m, double length, double opening, double slip,
            CohesivePoint& p) const override {
    const Point now = moved({m.penalty / length, m.tensile_strength, m.cohesion, m.tan_friction,
                             m.tan_residual, m.fracture_energy_mode1, m.fracture_energy_mode2,
                             m.mixed_mode_exponent, m.calibration == Calibration::exact},
                            opening, slip, p.damage, p.plastic_slip, Power());
    p.opening = opening;
    p.slip = slip;
    p.damage = now.damage;
    p.plastic_slip = now.plastic_slip;
    p.normal = now.normal;
    p.shear = now.shear;
    p.friction = now.friction;
    p.stored = now.stored;
  }

  void move(const ElementLanes& e, PointLanes& p) const override {
    LaneRow exponent{}, exact{};
    bool products = true;
    for (std::size_t l = 0; l < e.used; ++l) {
      exponent[l] = e.material[l]->mixed_mode_exponent;
      exact[l] = e.material[l]->calibration == Calibration::exact ? 1.0 : 0.0;
      products = products && by_products(exponent[l]);
    }
    if (products) return move_by_products(e, exponent, exact, p);
    move_lanes(e, exponent, exact, p, Power());
  }
};

const RegisterLaw registration{std::make_shared<BenzeggaghKenane>()};

}  // namespace
}  // namespace crackle
