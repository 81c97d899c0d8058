// SPDX-License-Identifier: GPL-3.0-or-later
//
// Body of kernel_*.cpp, which set CRACKLE_LEVEL, CRACKLE_WIDTH (how many of a group's eight lanes the
// processor takes at a time: of a longer vector the compiler takes comparisons apart number by number) and
// the compiler's flags. Everything here is inlined: nothing that is compiled for one level may be linked into
// another, so nothing of the standard library is used.
#include "kernel.hpp"

#ifndef CRACKLE_LEVEL
#error "include it from kernel_*.cpp"
#endif

namespace crackle::tiles {
namespace {

inline constexpr int width = CRACKLE_WIDTH;
inline constexpr int parts = lanes / width;  // of a group

using V = double __attribute__((vector_size(8 * width)));
using V8 = double __attribute__((vector_size(64)));
using V4 = double __attribute__((vector_size(32)));
using V2 = double __attribute__((vector_size(16), aligned(16), may_alias));
using Row = double __attribute__((vector_size(8 * width), aligned(8 * width), may_alias));
using Bytes = std::uint8_t __attribute__((vector_size(width), aligned(width), may_alias));

#define CRACKLE_INLINE [[gnu::always_inline]] inline

CRACKLE_INLINE std::uintptr_t index(std::uint16_t n) { return n; }
CRACKLE_INLINE V row(const double* p) { return *reinterpret_cast<const Row*>(p); }
CRACKLE_INLINE void put(double* p, V v) { *reinterpret_cast<Row*>(p) = v; }
CRACKLE_INLINE V2 two(const double* p) { return *reinterpret_cast<const V2*>(p); }

template <class Mask>
CRACKLE_INLINE void put_mask(std::uint8_t* p, Mask mask) {
  *reinterpret_cast<Bytes*>(p) = __builtin_convertvector(mask, Bytes);
}

// Of four nodes, aligned like one: by bytes, as clang takes a vector in memory to be aligned like the vector.
template <class Vector>
CRACKLE_INLINE Vector unaligned(const double* p) {
  Vector v;
  __builtin_memcpy(&v, p, sizeof v);
  return v;
}
CRACKLE_INLINE V4 four(const double* p) { return unaligned<V4>(p); }
CRACKLE_INLINE V8 pairs(const double* p) { return unaligned<V8>(p); }
CRACKLE_INLINE void put_pairs(double* p, V8 v) { __builtin_memcpy(p, &v, sizeof v); }
CRACKLE_INLINE void put_two(double* p, V2 v) { *reinterpret_cast<V2*>(p) = v; }

struct Pairs {
  V x, y;
};
struct Motion {
  Pairs displacement, velocity;
};

// A node by its name, where two numbers or four belong to each.
template <class Number>
CRACKLE_INLINE Number* of_two(Number* p, std::uint16_t name) {
  return p + index(name) / 2;
}

CRACKLE_INLINE Pairs gather(const double* p, const std::uint16_t* n) {
  const auto one = [&](int k) { return two(of_two(p, n[k])); };
#if CRACKLE_WIDTH == 2
  const V low = one(0), high = one(1);
  return {__builtin_shufflevector(low, high, 0, 2), __builtin_shufflevector(low, high, 1, 3)};
#else
  const auto both = [&](int k) { return __builtin_shufflevector(one(k), one(k + 1), 0, 1, 2, 3); };
#if CRACKLE_WIDTH == 4
  const V low = both(0), high = both(2);
  return {__builtin_shufflevector(low, high, 0, 2, 4, 6), __builtin_shufflevector(low, high, 1, 3, 5, 7)};
#else
  const V low = __builtin_shufflevector(both(0), both(2), 0, 1, 2, 3, 4, 5, 6, 7);
  const V high = __builtin_shufflevector(both(4), both(6), 0, 1, 2, 3, 4, 5, 6, 7);
  return {__builtin_shufflevector(low, high, 0, 2, 4, 6, 8, 10, 12, 14),
          __builtin_shufflevector(low, high, 1, 3, 5, 7, 9, 11, 13, 15)};
#endif
#endif
}

// Displacement and velocity at once: rows of four numbers, turned over.
CRACKLE_INLINE Motion gather_motion(const double* p, const std::uint16_t* n) {
  const auto node = [&](int k) { return p + index(n[k]); };
#if CRACKLE_WIDTH == 2
  const V u0 = two(node(0)), u1 = two(node(1)), v0 = two(node(0) + 2), v1 = two(node(1) + 2);
  return {{__builtin_shufflevector(u0, u1, 0, 2), __builtin_shufflevector(u0, u1, 1, 3)},
          {__builtin_shufflevector(v0, v1, 0, 2), __builtin_shufflevector(v0, v1, 1, 3)}};
#elif CRACKLE_WIDTH == 4
  const V r0 = four(node(0)), r1 = four(node(1)), r2 = four(node(2)), r3 = four(node(3));
  const V x01 = __builtin_shufflevector(r0, r1, 0, 4, 2, 6),
          y01 = __builtin_shufflevector(r0, r1, 1, 5, 3, 7);
  const V x23 = __builtin_shufflevector(r2, r3, 0, 4, 2, 6),
          y23 = __builtin_shufflevector(r2, r3, 1, 5, 3, 7);
  return {{__builtin_shufflevector(x01, x23, 0, 1, 4, 5), __builtin_shufflevector(y01, y23, 0, 1, 4, 5)},
          {__builtin_shufflevector(x01, x23, 2, 3, 6, 7), __builtin_shufflevector(y01, y23, 2, 3, 6, 7)}};
#else
  const auto both = [&](int k) {
    return __builtin_shufflevector(four(node(k)), four(node(k + 2)), 0, 1, 2, 3, 4, 5, 6, 7);
  };
  const V r02 = both(0), r13 = both(1), r46 = both(4), r57 = both(5);
  const V xl = __builtin_shufflevector(r02, r13, 0, 8, 2, 10, 4, 12, 6, 14);
  const V yl = __builtin_shufflevector(r02, r13, 1, 9, 3, 11, 5, 13, 7, 15);
  const V xh = __builtin_shufflevector(r46, r57, 0, 8, 2, 10, 4, 12, 6, 14);
  const V yh = __builtin_shufflevector(r46, r57, 1, 9, 3, 11, 5, 13, 7, 15);
  return {{__builtin_shufflevector(xl, xh, 0, 1, 4, 5, 8, 9, 12, 13),
           __builtin_shufflevector(yl, yh, 0, 1, 4, 5, 8, 9, 12, 13)},
          {__builtin_shufflevector(xl, xh, 2, 3, 6, 7, 10, 11, 14, 15),
           __builtin_shufflevector(yl, yh, 2, 3, 6, 7, 10, 11, 14, 15)}};
#endif
}

// Forces, lane after lane, in pairs of lanes.
struct Spread {
  alignas(64) double even[width], odd[width];
  CRACKLE_INLINE Spread(V x, V y) {
#if CRACKLE_WIDTH == 2
    put(even, __builtin_shufflevector(x, y, 0, 2));
    put(odd, __builtin_shufflevector(x, y, 1, 3));
#elif CRACKLE_WIDTH == 4
    put(even, __builtin_shufflevector(x, y, 0, 4, 2, 6));
    put(odd, __builtin_shufflevector(x, y, 1, 5, 3, 7));
#else
    put(even, __builtin_shufflevector(x, y, 0, 8, 2, 10, 4, 12, 6, 14));
    put(odd, __builtin_shufflevector(x, y, 1, 9, 3, 11, 5, 13, 7, 15));
#endif
  }
  CRACKLE_INLINE V2 operator[](int lane) const { return two((lane % 2 ? odd : even) + (lane & ~1)); }
};

CRACKLE_INLINE void add(double* force, std::uint16_t n, V2 f) {
  double* const at = of_two(force, n);
  put_two(at, two(at) + f);
}

class Fetch {
 public:
  CRACKLE_INLINE explicit Fetch(const Ahead& a) : a_(a), at_(a.range < a.end ? a.range->from : nullptr) {}
  CRACKLE_INLINE void some() {
    for (int k = 0; k < a_.lines && a_.range < a_.end; ++k) {
      __builtin_prefetch(at_, 0, 2);
      at_ += 64;
      if (at_ >= a_.range->to && ++a_.range < a_.end) at_ = a_.range->from;
    }
  }

 private:
  Ahead a_;
  const char* at_;
};

// The work by value: what is stored cannot change it, so it is read once.
template <bool viscous, bool screened>
CRACKLE_INLINE void rock_groups(const RockWork w) {
  const double third = w.weight / 3.0;
  V power[parts] = {};
  for (int part = 0; viscous && part < parts; ++part) power[part] = row(w.power + width * part);
  Fetch fetch(w.ahead);
  for (int k = 0; k < parts * w.groups; ++k) {
    const int g = k / parts, part = k % parts, lane = width * part;
    if (part == 0) fetch.some();
    const std::uint16_t* n = w.corners + 3 * lanes * g + lane;
    Motion m0, m1, m2;
    if constexpr (viscous) {
      m0 = gather_motion(w.motion, n);
      m1 = gather_motion(w.motion, n + lanes);
      m2 = gather_motion(w.motion, n + 2 * lanes);
    } else {
      m0.displacement = gather(w.displacement, n);
      m1.displacement = gather(w.displacement, n + lanes);
      m2.displacement = gather(w.displacement, n + 2 * lanes);
    }
    const Pairs &u0 = m0.displacement, &u1 = m1.displacement, &u2 = m2.displacement;
    const double* sides = w.sides + 4 * lanes * g + lane;
    const V e1x = row(sides), e1y = row(sides + lanes), e2x = row(sides + 2 * lanes),
            e2y = row(sides + 3 * lanes);
    const V twice = e1x * e2y - e1y * e2x;
    const V inverse = 1.0 / twice;
    const triangle::Shape<V> shape{e2y * inverse, -e2x * inverse, -e1y * inverse, e1x * inverse};
    const auto h = triangle::gradient(shape, u1.x - u0.x, u1.y - u0.y, u2.x - u0.x, u2.y - u0.y);
    auto s = triangle::stress(w.stiffness, triangle::green_strain(h));
    if (w.in_situ_rows != nullptr) {
      const double* in_situ = w.in_situ_rows + 3 * lanes * g + lane;
      s = {s.xx + row(in_situ), s.yy + row(in_situ + lanes), s.xy + row(in_situ + 2 * lanes)};
    } else {
      s = {s.xx + w.in_situ.xx, s.yy + w.in_situ.yy, s.xy + w.in_situ.xy};
    }
    if constexpr (screened) put_mask(w.stressed + lanes * g + lane, triangle::passes(w.screen, s));
    const V area = 0.5 * twice;
    if constexpr (viscous) {
      const Pairs &v0 = m0.velocity, &v1 = m1.velocity, &v2 = m2.velocity;
      const auto rate = triangle::strain_rate(
          h, triangle::gradient(shape, v1.x - v0.x, v1.y - v0.y, v2.x - v0.x, v2.y - v0.y));
      double* last = w.strain_rate + 3 * lanes * g + lane;
      const triangle::Tensor<V> before{row(last), row(last + lanes), row(last + 2 * lanes)};
      const V viscosity = row(w.viscosity + lanes * g + lane);
      power[part] += triangle::viscous_power(area, viscosity, rate, before);
      put(last, rate.xx);
      put(last + lanes, rate.yy);
      put(last + 2 * lanes, rate.xy);
      s = {s.xx + viscosity * rate.xx, s.yy + viscosity * rate.yy, s.xy + viscosity * rate.xy};
    }
    const auto f = triangle::forces(h, s, shape, area);
    const V weight = third * area;
    const Spread f0(-f.x1 - f.x2, -f.y1 - f.y2 + weight), f1(f.x1, f.y1 + weight), f2(f.x2, f.y2 + weight);
#pragma GCC unroll 8
    for (int l = 0; l < width; ++l) {
      add(w.force, n[l], f0[l]);
      add(w.force, n[lanes + l], f1[l]);
      add(w.force, n[2 * lanes + l], f2[l]);
    }
  }
  for (int part = 0; viscous && part < parts; ++part) put(w.power + width * part, power[part]);
}

template <bool viscous>
CRACKLE_INLINE void element_groups(const ElementWork w) {
  Fetch fetch(w.ahead);
  for (int k = 0; k < parts * w.groups; ++k) {
    const int g = k / parts, lane = width * (k % parts);
    if (lane == 0) fetch.some();
    const std::uint16_t* n = w.ends + 4 * lanes * g + lane;
    const auto end = [&](int which) {
      if constexpr (viscous) return gather_motion(w.motion, n + which * lanes).displacement;
      return gather(w.displacement, n + which * lanes);
    };
    const Pairs a0 = end(0), a1 = end(1), b0 = end(2), b1 = end(3);
    const double* numbers = w.numbers + 7 * lanes * g + lane;
    const V inverse_length = row(numbers), dx = row(numbers + lanes), dy = row(numbers + 2 * lanes);
    const ElasticElement<V> e{b0.x - a0.x,
                              b0.y - a0.y,
                              b1.x - a1.x,
                              b1.y - a1.y,
                              dx + 0.5 * ((a1.x + b1.x) - (a0.x + b0.x)),
                              dy + 0.5 * ((a1.y + b1.y) - (a0.y + b0.y)),
                              (dx * dx + dy * dy) * inverse_length,
                              inverse_length,
                              row(numbers + 3 * lanes),
                              row(numbers + 4 * lanes),
                              row(numbers + 5 * lanes),
                              row(numbers + 6 * lanes)};
    ElasticForces<V> f;
    if (w.limit_rows != nullptr) {
      const double* limits = w.limit_rows + 4 * lanes * g + lane;
      f = elastic_forces(e, ElasticLimits<V>{row(limits + 3 * lanes), row(limits), row(limits + lanes),
                                             row(limits + 2 * lanes), w.limits.curvature});
    } else {
      f = elastic_forces(e, w.limits);
    }
    put_mask(w.near + lanes * g + lane, f.beyond > 0.0);
    const Spread end0(f.x0, f.y0), end1(f.x1, f.y1);
#pragma GCC unroll 8
    for (int l = 0; l < width; ++l) {
      add(w.force, n[l], end0[l]);
      add(w.force, n[lanes + l], end1[l]);
      add(w.force, n[2 * lanes + l], -end0[l]);
      add(w.force, n[3 * lanes + l], -end1[l]);
    }
  }
}

}  // namespace

// One file a level includes this.
// NOLINTBEGIN(misc-definitions-in-headers)
namespace CRACKLE_LEVEL {

void copy(const CopyWork& w) {
  for (const Run* run = w.run; run < w.end; ++run) {
    const double* from = w.from + 2 * static_cast<std::ptrdiff_t>(run->node);
    double* to = w.to + 2 * run->local;
    int k = 0;
    for (; width == 8 && k + 4 <= run->count; k += 4) put_pairs(to + 2 * k, pairs(from + 2 * k));
    for (; k < run->count; ++k) put_two(to + 2 * k, two(from + 2 * k));
  }
}

void copy_motion(const MotionWork& w) {
  for (const Run* run = w.run; run < w.end; ++run) {
    const auto node = static_cast<std::ptrdiff_t>(run->node);
    const double *displacement = w.displacement + 2 * node, *velocity = w.velocity + 2 * node;
    double* to = w.to + 4 * run->local;
    int k = 0;
    for (; width == 8 && k + 4 <= run->count; k += 4) {
      const V8 u = pairs(displacement + 2 * k), v = pairs(velocity + 2 * k);
      put_pairs(to + 4 * k, __builtin_shufflevector(u, v, 0, 1, 8, 9, 2, 3, 10, 11));
      put_pairs(to + 4 * k + 8, __builtin_shufflevector(u, v, 4, 5, 12, 13, 6, 7, 14, 15));
    }
    for (; k < run->count; ++k) {
      put_two(to + 4 * k, two(displacement + 2 * k));
      put_two(to + 4 * k + 2, two(velocity + 2 * k));
    }
  }
}

void move(const MoveWork& w) {
  for (const Run* run = w.run; run < w.end; ++run) {
    const auto node = static_cast<std::ptrdiff_t>(run->node);
    const double *mobility = w.inverse_mass + node, *force = w.force + 2 * run->local;
    double *velocity = w.velocity + 2 * node, *displacement = w.displacement + 2 * node;
    int k = 0;
    for (; width == 8 && k + 4 <= run->count; k += 4) {
      const V4 m = w.dt * four(mobility + k);
      const V8 v = pairs(velocity + 2 * k) +
                   __builtin_shufflevector(m, m, 0, 0, 1, 1, 2, 2, 3, 3) * pairs(force + 2 * k);
      put_pairs(velocity + 2 * k, v);
      put_pairs(displacement + 2 * k, pairs(displacement + 2 * k) + w.dt * v);
    }
    for (; k < run->count; ++k) {
      const V2 v = two(velocity + 2 * k) + (w.dt * mobility[k]) * two(force + 2 * k);
      put_two(velocity + 2 * k, v);
      put_two(displacement + 2 * k, two(displacement + 2 * k) + w.dt * v);
    }
  }
}

void rock(const RockWork& w) {
  if (w.motion != nullptr) {
    w.stressed != nullptr ? rock_groups<true, true>(w) : rock_groups<true, false>(w);
  } else {
    w.stressed != nullptr ? rock_groups<false, true>(w) : rock_groups<false, false>(w);
  }
}

void elements(const ElementWork& w) {
  w.motion != nullptr ? element_groups<true>(w) : element_groups<false>(w);
}

}  // namespace CRACKLE_LEVEL
// NOLINTEND(misc-definitions-in-headers)
}  // namespace crackle::tiles
