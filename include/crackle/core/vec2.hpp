// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <cstdint>

namespace crackle {

/// Index of a vertex, triangle, edge, corner, node or cohesive element; -1 means none.
using Index = std::int32_t;

/// A point or vector in the plane; the unit is that of the quantity it stands for.
struct Vec2 {
  double x = 0.0;
  double y = 0.0;

  constexpr Vec2& operator+=(Vec2 b) {
    x += b.x;
    y += b.y;
    return *this;
  }
  constexpr Vec2& operator-=(Vec2 b) {
    x -= b.x;
    y -= b.y;
    return *this;
  }
  constexpr Vec2& operator*=(double s) {
    x *= s;
    y *= s;
    return *this;
  }
  friend constexpr Vec2 operator+(Vec2 a, Vec2 b) { return {a.x + b.x, a.y + b.y}; }
  friend constexpr Vec2 operator-(Vec2 a, Vec2 b) { return {a.x - b.x, a.y - b.y}; }
  friend constexpr Vec2 operator-(Vec2 a) { return {-a.x, -a.y}; }
  friend constexpr Vec2 operator*(double s, Vec2 a) { return {s * a.x, s * a.y}; }
  friend constexpr bool operator==(Vec2 a, Vec2 b) = default;
};

constexpr double dot(Vec2 a, Vec2 b) { return a.x * b.x + a.y * b.y; }
/// z-component of a x b; positive when b lies to the left of a.
constexpr double cross(Vec2 a, Vec2 b) { return a.x * b.y - a.y * b.x; }
inline double norm(Vec2 a) { return std::sqrt(dot(a, a)); }
/// a turned by -90 degrees: the outward normal of a counter-clockwise boundary edge a (same length).
constexpr Vec2 right_normal(Vec2 a) { return {a.y, -a.x}; }

/// Symmetric 2D tensor: stress [Pa] or strain [-]; tension positive.
struct Sym2 {
  double xx = 0.0;
  double yy = 0.0;
  double xy = 0.0;

  friend constexpr Sym2 operator+(Sym2 a, Sym2 b) { return {a.xx + b.xx, a.yy + b.yy, a.xy + b.xy}; }
  friend constexpr Sym2 operator*(double s, Sym2 a) { return {s * a.xx, s * a.yy, s * a.xy}; }
  friend constexpr Vec2 operator*(Sym2 s, Vec2 n) {
    return {s.xx * n.x + s.xy * n.y, s.xy * n.x + s.yy * n.y};
  }
  friend constexpr bool operator==(Sym2 a, Sym2 b) = default;
};

}  // namespace crackle
