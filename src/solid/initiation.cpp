// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <numbers>

#include "crackle/solid/damage.hpp"

namespace crackle {
namespace {

struct Principal {
  double mean, radius, angle;  // of the largest, from x [rad]
  double largest() const { return mean + radius; }
  double smallest() const { return mean - radius; }
};

Principal principal(Sym2 s) {
  const double half = 0.5 * (s.xx - s.yy);
  return {0.5 * (s.xx + s.yy), std::hypot(half, s.xy), 0.5 * std::atan2(s.xy, half)};
}

Vec2 direction(double angle) { return {std::cos(angle), std::sin(angle)}; }

CrackStart in_tension(const DamageMaterial& m, const Principal& p) {
  if (p.largest() <= m.tensile_strength) return {};
  Vec2 n = direction(p.angle);
  const double first = p.largest() - m.tensile_strength, second = p.smallest() - m.tensile_strength;
  if (second > 0.0) {  // in both: between the two
    const double turn = std::atan2(second, first);
    n = direction(p.angle + turn);
  }
  return {true, false, n, m.cohesion};
}

// On the plane whose normal is `away` from the largest principal stress.
CrackStart on_plane(const Principal& p, double away, double cohesion) {
  return {true, true, direction(p.angle - away), cohesion};
}

CrackStart in_shear(const DamageMaterial& m, const Principal& p) {
  if (p.radius <= m.cohesion) return {};
  return on_plane(p, 0.25 * std::numbers::pi, m.cohesion);
}

CrackStart by_mohr_coulomb(const DamageMaterial& m, const Principal& p) {
  const double secant = std::sqrt(1.0 + m.tan_friction * m.tan_friction);
  if (p.radius * secant + p.mean * m.tan_friction <= m.cohesion) return {};
  const double phi = std::atan(m.tan_friction);
  const double normal = p.mean - p.radius * std::sin(phi);
  // What the crack bears above its friction: cohesion, and internal friction above the residual one.
  const double press = std::max(-normal, 0.0);
  const double cohesion = m.cohesion + std::max(0.0, m.tan_friction - m.tan_residual) * press;
  return on_plane(p, 0.25 * std::numbers::pi + 0.5 * phi, cohesion);
}

CrackStart by_ellipse(const DamageMaterial& m, const Principal& p) {
  constexpr int directions = 90;
  double worst = 0.0, away = 0.0, normal = 0.0, shear = 0.0;
  for (int i = 0; i <= directions; ++i) {
    const double a = 0.5 * std::numbers::pi * i / directions;
    const double t_n = std::max(0.0, p.mean + p.radius * std::cos(2.0 * a)) / m.tensile_strength;
    const double t_s = p.radius * std::sin(2.0 * a) / m.cohesion;
    if (t_n * t_n + t_s * t_s <= worst) continue;
    worst = t_n * t_n + t_s * t_s;
    away = a;
    normal = t_n;
    shear = t_s;
  }
  if (worst <= 1.0) return {};
  CrackStart start = on_plane(p, away, m.cohesion);
  start.in_shear = shear > normal;
  return start;
}

struct WorstPlane {
  double share = 0.0;  // of its strength
  Vec2 normal;
  double stress = 0.0;      // on it, normal [Pa]
  DamageMaterial material;  // of it
};

// The plane with the largest share(material of the plane, σ_n, τ): looked for among directions 2 degrees
// apart from the bedding's on, and then between the neighbours of the best of them.
template <class Share>
WorstPlane worst_plane(const DamageMaterial& rock, Sym2 stress, const Share& share) {
  const double bedding = std::atan2(rock.bedding.normal.y, rock.bedding.normal.x);
  const auto on = [&](double angle) {
    WorstPlane w;
    w.normal = direction(angle);
    w.material = on_plane(rock, w.normal);
    const Vec2 traction = stress * w.normal;
    w.stress = dot(traction, w.normal);
    w.share = share(w.material, w.stress, std::abs(cross(w.normal, traction)));
    return w;
  };
  constexpr int directions = 90;
  constexpr double apart = std::numbers::pi / directions;
  WorstPlane worst = on(bedding);
  double best = bedding;
  for (int i = 1; i < directions; ++i) {
    const WorstPlane w = on(bedding + i * apart);
    if (w.share > worst.share) worst = w, best = bedding + i * apart;
  }
  if (worst.share < 0.99) return worst;  // between the directions it is less than 1 % more
  double low = best - apart, high = best + apart;
  for (int i = 0; i < 40; ++i) {
    const WorstPlane a = on(low + (high - low) / 3.0), b = on(high - (high - low) / 3.0);
    const WorstPlane& better = a.share > b.share ? a : b;
    if (better.share > worst.share) worst = better;
    (a.share > b.share ? high : low) =
        a.share > b.share ? high - (high - low) / 3.0 : low + (high - low) / 3.0;
  }
  return worst;
}

double shear_load(const DamageMaterial& m, double normal, double shear) {
  return (shear + normal * m.tan_friction) / m.cohesion;
}

CrackStart bedded_start(const DamageMaterial& rock, Sym2 stress) {
  const Initiation by = rock.initiation;
  if (by == Initiation::ellipse) {
    const auto parts = [](const DamageMaterial& m, double normal, double shear) {
      return std::array{std::max(0.0, normal) / m.tensile_strength, shear / m.cohesion};
    };
    const WorstPlane w = worst_plane(rock, stress, [&](const DamageMaterial& m, double normal, double shear) {
      const auto [t_n, t_s] = parts(m, normal, shear);
      return std::hypot(t_n, t_s);
    });
    if (w.share <= 1.0) return {};
    const auto [t_n, t_s] = parts(w.material, w.stress, std::abs(cross(w.normal, stress * w.normal)));
    return {true, t_s > t_n, w.normal, w.material.cohesion};
  }
  if (by != Initiation::shear) {
    const WorstPlane w = worst_plane(rock, stress, [](const DamageMaterial& m, double normal, double) {
      return normal / m.tensile_strength;
    });
    if (w.share > 1.0) return {true, false, w.normal, w.material.cohesion};
  }
  if (by == Initiation::principal) return {};
  const bool pressed = by == Initiation::mohr_coulomb;
  DamageMaterial m = rock;
  if (!pressed) m.tan_friction = 0.0;
  const WorstPlane w = worst_plane(m, stress, shear_load);
  if (w.share <= 1.0) return {};
  const double above = pressed ? std::max(0.0, m.tan_friction - m.tan_residual) : 0.0;
  return {true, true, w.normal, w.material.cohesion + above * std::max(-w.stress, 0.0)};
}

}  // namespace

CrackStart crack_start(const DamageMaterial& m, Sym2 stress) {
  if (m.bedding) return bedded_start(m, stress);
  const Principal p = principal(stress);
  CrackStart start;
  switch (m.initiation) {
    case Initiation::principal:
      return in_tension(m, p);
    case Initiation::shear:
      return in_shear(m, p);
    case Initiation::ellipse:
      return by_ellipse(m, p);
    case Initiation::box:
      start = in_tension(m, p);
      return start.reached ? start : in_shear(m, p);
    case Initiation::mohr_coulomb:
      start = in_tension(m, p);
      return start.reached ? start : by_mohr_coulomb(m, p);
  }
  return start;
}

std::optional<Initiation> find_initiation(const std::string& name) {
  if (name == "mohr_coulomb") return Initiation::mohr_coulomb;
  if (name == "principal") return Initiation::principal;
  if (name == "shear") return Initiation::shear;
  if (name == "box") return Initiation::box;
  if (name == "ellipse") return Initiation::ellipse;
  return {};
}

double parting_length(const std::array<Vec2, 3>& gradients, const std::array<bool, 3>& ahead, Vec2 normal) {
  double sum = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    if (ahead[i]) sum += dot(gradients[i], normal);
  }
  return 1.0 / sum;
}

double oliver_length(const std::array<Vec2, 3>& gradients, Vec2 normal) {
  // Heights of the corners along n, from the dual basis of the gradients.
  const Vec2 g1 = gradients[1], g2 = gradients[2];
  const double det = cross(g1, g2);
  const double h1 = cross(normal, g2) / det, h2 = -cross(normal, g1) / det;
  const double mean = (h1 + h2) / 3.0;
  const std::array<double, 3> height{-mean, h1 - mean, h2 - mean};
  const double size = std::max({std::abs(height[0]), std::abs(height[1]), std::abs(height[2])});
  // A corner on the line through the centroid may count or not: the larger length.
  const auto beyond = [&](double limit) {
    return parting_length(gradients, {height[0] > limit, height[1] > limit, height[2] > limit}, normal);
  };
  return std::max(beyond(1e-6 * size), beyond(-1e-6 * size));
}

double chord_length(const std::array<Vec2, 3>& corners, Vec2 normal) {
  const Vec2 centre = (1.0 / 3.0) * (corners[0] + corners[1] + corners[2]);
  const Vec2 along{-normal.y, normal.x};
  double low = 0.0, high = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec2 a = corners[i] - centre, b = corners[(i + 1) % 3] - centre;
    const double ha = dot(a, normal), hb = dot(b, normal);
    if (ha == hb || ha * hb > 0.0) continue;
    const double s = dot(a, along) + (dot(b, along) - dot(a, along)) * ha / (ha - hb);
    low = std::min(low, s);
    high = std::max(high, s);
  }
  const double area = 0.5 * std::abs(cross(corners[1] - corners[0], corners[2] - corners[0]));
  return area / (high - low);
}

}  // namespace crackle
