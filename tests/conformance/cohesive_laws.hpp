// SPDX-License-Identifier: GPL-3.0-or-later
//
// Every registered law, for tests that run on all of them without a list.
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <ostream>
#include <string>
#include <vector>

#include "../granite.hpp"
#include "crackle/cohesive/law.hpp"

namespace crackle {

using LawPointer = std::shared_ptr<const CohesiveLaw>;

inline std::string name_of(const testing::TestParamInfo<LawPointer>& info) { return info.param->name(); }

inline void PrintTo(const LawPointer& law, std::ostream* out) { *out << law->name(); }

inline constexpr double edge_length = 3e-3;  // [m]

/// The granite with a residual friction below its internal one.
inline CohesiveMaterial weaker_friction(Calibration calibration = Calibration::exact) {
  CohesiveMaterial m = granite::cohesive();
  m.tan_residual = 0.5 * m.tan_friction;
  m.calibration = calibration;
  return m;
}

/// A point that is moved about, with the work done on it [J/m2].
class Mover {
 public:
  Mover(const CohesiveLaw& law, const CohesiveMaterial& material, double length = edge_length)
      : law_(law), material_(material), length_(length) {
    law_.move(material_, length_, 0.0, 0.0, point_);
  }

  void step(double opening, double slip) {
    const CohesivePoint old = point_;
    law_.move(material_, length_, opening, slip, point_);
    const double normal = 0.5 * (point_.normal + old.normal) * (point_.opening - old.opening);
    const double shear =
        0.5 * (point_.shear + point_.friction + old.shear + old.friction) * (point_.slip - old.slip);
    work_ += normal + shear;
    turnover_ += std::abs(normal) + std::abs(shear);
  }
  /// In a straight line, in so many steps.
  void go(double opening, double slip, int steps) {
    const double o = point_.opening, s = point_.slip;
    for (int i = 1; i <= steps; ++i) {
      const double part = static_cast<double>(i) / steps;
      step(o + part * (opening - o), s + part * (slip - s));
    }
  }

  const CohesivePoint& point() const { return point_; }
  double shear() const { return point_.shear + point_.friction; }
  double work() const { return work_; }
  double turnover() const { return turnover_; }  ///< sum of |work| of the steps [J/m2]
  double dissipated() const { return work_ - point_.stored; }
  /// Slope of the tractions over opening and slip [Pa/m], from here: larger eigenvalue, by its real part.
  double slope(double step) const;

 private:
  const CohesiveLaw& law_;
  CohesiveMaterial material_;
  double length_;
  CohesivePoint point_;
  double work_ = 0.0, turnover_ = 0.0;
};

inline double Mover::slope(double step) const {
  const auto tractions = [&](double opening, double slip) {
    CohesivePoint p = point_;
    law_.move(material_, length_, opening, slip, p);
    return Vec2{p.normal, p.shear + p.friction};
  };
  const double o = point_.opening, s = point_.slip;
  const Vec2 here = tractions(o, s);
  const Vec2 across = (1.0 / step) * (tractions(o + step, s) - here);
  const Vec2 along = (1.0 / step) * (tractions(o, s + step) - here);
  const double mean = 0.5 * (across.x + along.y), half = 0.5 * (across.x - along.y);
  const double square = half * half + across.y * along.x;
  return mean + (square > 0.0 ? std::sqrt(square) : 0.0);
}

/// Openings and slips [m] to go to one after another: some with a direction's end, some small.
inline std::vector<Vec2> random_walk(unsigned seed, int stops, double closed, double open, double slip) {
  std::vector<Vec2> walk;
  std::uint64_t x = 0x9e3779b97f4a7c15ULL * (seed + 1);
  const auto random = [&] {  // xorshift64*
    x ^= x >> 12;
    x ^= x << 25;
    x ^= x >> 27;
    return static_cast<double>((x * 0x2545f4914f6cdd1dULL) >> 11) / 9007199254740992.0;
  };
  for (int i = 0; i < stops; ++i) {
    const double scale = std::pow(random(), 2.0);
    walk.push_back({scale * (-closed + (closed + open) * random()), scale * slip * (2.0 * random() - 1.0)});
  }
  return walk;
}

}  // namespace crackle
