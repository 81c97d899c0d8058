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
#include <algorithm>
#include <cmath>

#include "crackle/cohesive/law.hpp"
#include "crackle/state/coulomb.hpp"
#include "evans_marathe.hpp"

namespace crackle {
namespace {

// Separation at which a ray of given mode yields, and from there on to its end [m].
struct Ray {
  double onset, length;
};

// Products where they will do: pow() is slow, and another in every C library.
double power(double base, double exponent) {
  if (exponent == 4.0) return base * base * (base * base);
  return exponent == 2.0 ? base * base : std::pow(base, exponent);
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

  void move(const CohesiveMaterial& m, double length, double opening, double slip,
            CohesivePoint& p) const override {
    const double k = m.penalty / length;
    const double compression = std::min(k * opening, 0.0);  // [Pa], ≤ 0
    const double pull = std::max(opening, 0.0);
    p.opening = opening;
    p.slip = slip;
    double slid = p.damage > 0.0 ? p.plastic_slip / p.damage : 0.0;
    p.friction = coulomb_traction(k, slip, residual_strength(m, compression), slid);
    if (p.damage < 1.0) p.damage = std::max(p.damage, damage_at(m, length, compression, pull, slid));
    if (p.damage == 0.0) slid = p.friction = 0.0;  // nothing is broken yet that could rub
    p.plastic_slip = p.damage * slid;
    const double left = 1.0 - p.damage;
    p.normal = k * (left * pull + std::min(opening, 0.0));
    p.shear = k * (slip - p.plastic_slip) - p.friction;
    p.stored = 0.5 * k *
               (left * (pull * pull + slip * slip) + p.damage * (slip - slid) * (slip - slid) +
                std::min(opening, 0.0) * std::min(opening, 0.0));
  }

 private:
  double damage_at(const CohesiveMaterial& m, double length, double compression, double pull,
                   double slid) const {
    const double separation = std::sqrt(pull * pull + slid * slid);
    const double k = m.penalty / length;
    if (pull == 0.0) {
      // What is above residual friction softens.
      const double strength = shear_strength(m, compression);
      const double drop = std::max(strength - residual_strength(m, compression), 0.1 * strength);
      if (k * separation <= drop) return 0.0;
      return damage_on({drop / k, softening_slip(m, length, compression)}, separation);
    }
    if (k * separation <= std::min(m.tensile_strength, m.cohesion)) return 0.0;  // on no ray
    const double across = pull / separation, along = std::abs(slid) / separation;
    const double tension = m.tensile_strength / across;
    const double peak = along * tension > m.cohesion ? m.cohesion / along : tension;  // t₀
    if (k * separation <= peak) return 0.0;
    const double share = along * along, rise = m.fracture_energy_mode2 - m.fracture_energy_mode1;
    const double energy = m.fracture_energy_mode1 + rise * power(share, m.mixed_mode_exponent);
    const double onset = peak / k;
    if (m.calibration == Calibration::y_geo)
      return damage_on({onset, y_geo_factor() * energy / peak}, separation);
    const double left = std::max(energy - 0.5 * peak * onset, 0.01 * energy);
    return damage_on({onset, left / (softening_integral() * peak)}, separation);
  }

  double damage_on(const Ray& ray, double separation) const {
    const double done = (separation - ray.onset) / ray.length;
    return done < 1.0 ? 1.0 - softening(done) * ray.onset / separation : 1.0;
  }
};

const RegisterLaw registration{std::make_shared<BenzeggaghKenane>()};

}  // namespace
}  // namespace crackle
