// SPDX-License-Identifier: GPL-3.0-or-later
//
// A cohesive element on its elastic branch: elastic_traction() of law.hpp at both ends and the middle,
// Simpson's rule, without a branch. Over a number type V, a double or a vector of doubles (one element a
// lane), and M, that of the material's numbers. The same operations in the same order: the same bits.
#pragma once

namespace crackle {

/// An element gets a history a little before it can yield, so that its first damage is booked whole.
inline constexpr double near_strength = 0.95;

template <class M>
struct ElasticLimits {
  M penalty;           ///< [Pa]
  M tensile_strength;  ///< [Pa]
  M cohesion;          ///< [Pa]
  M tan_friction;      ///< [-]
  double curvature;    ///< of the branch, see CohesiveLaw
};

template <class V>
struct ElasticElement {
  V gap0_x, gap0_y, gap1_x, gap1_y;    ///< face b from face a at both ends [m]
  V along_x, along_y;                  ///< current direction of the middle line, its length of now [m]
  V length, inverse_length;            ///< reference [m], [1/m]
  V opening0, slip0, opening1, slip1;  ///< offsets [m]
};

template <class V>
struct ElasticForces {
  V x0, y0, x1, y1;  ///< on face a at both ends [N/m]; face b gets the opposite
  V beyond;          ///< above zero: near its strength
};

/// The larger of two numbers, lane by lane.
template <class V>
[[gnu::always_inline]] inline V larger(V a, V b) {
  return a > b ? a : b;
}

template <class V, class M>
[[gnu::always_inline]] inline ElasticForces<V> elastic_forces(const ElasticElement<V>& e,
                                                              const ElasticLimits<M>& m) {
  const V zero{};
  const double quarter = m.curvature / 4.0;
  const double limit = near_strength * (1.0 + m.curvature);
  // Direction of the middle line over its reference length, made a unit vector by two Newton steps from one:
  // exact to round-off for the strains of intact rock.
  const V ex = e.along_x * e.inverse_length, ey = e.along_y * e.inverse_length;
  const V half = 0.5 * (ex * ex + ey * ey);
  const V once = 1.5 - half;
  const V r = once * (1.5 - half * (once * once));
  const V tx = ex * r, ty = ey * r;
  // normal (t.y, −t.x) points from face a to face b
  const V k = m.penalty * e.inverse_length;
  const V tn0 = k * (e.gap0_x * ty - e.gap0_y * tx + e.opening0);
  const V ts0 = k * (e.gap0_x * tx + e.gap0_y * ty + e.slip0);
  const V tn1 = k * (e.gap1_x * ty - e.gap1_y * tx + e.opening1);
  const V ts1 = k * (e.gap1_x * tx + e.gap1_y * ty + e.slip1);
  const V tnm = 0.5 * (tn0 + tn1), tsm = 0.5 * (ts0 + ts1);
  const V pull0 = larger(tn0, zero), pull1 = larger(tn1, zero), pullm = larger(tnm, zero);
  const M bend = quarter / m.tensile_strength;
  const V n0 = tn0 - bend * (pull0 * pull0), n1 = tn1 - bend * (pull1 * pull1),
          nm = tnm - bend * (pullm * pullm);
  // pull − tn is what presses
  const V strength0 = m.cohesion + m.tan_friction * (pull0 - tn0);
  const V strength1 = m.cohesion + m.tan_friction * (pull1 - tn1);
  const V strengthm = m.cohesion + m.tan_friction * (pullm - tnm);
  // One division for the three of s = t − ¼ c t |t| / strength.
  const V both = strength0 * strength1;
  const V share = quarter / (both * strengthm);
  const V push0 = larger(ts0, -ts0), push1 = larger(ts1, -ts1), pushm = larger(tsm, -tsm);
  const V rest = share * strengthm;
  const V s0 = ts0 - (ts0 * push0) * (rest * strength1);
  const V s1 = ts1 - (ts1 * push1) * (rest * strength0);
  const V sm = tsm - (tsm * pushm) * (share * both);
  // Near its strength already? The middle lies between the ends.
  const V beyond = larger(larger(pull0, pull1) - limit * m.tensile_strength,
                          larger(push0 - limit * strength0, push1 - limit * strength1));
  // Simpson's rule; the middle's share goes half to each end.
  const V sixth = e.length * (1.0 / 6.0);
  const V nm2 = nm + nm, sm2 = sm + sm;
  const V p0 = sixth * (n0 + nm2), q0 = sixth * (s0 + sm2);
  const V p1 = sixth * (n1 + nm2), q1 = sixth * (s1 + sm2);
  return {p0 * ty + q0 * tx, q0 * ty - p0 * tx, p1 * ty + q1 * tx, q1 * ty - p1 * tx, beyond};
}

}  // namespace crackle
