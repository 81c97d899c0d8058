// SPDX-License-Identifier: GPL-3.0-or-later
#include "crackle/seismic/moment_tensor.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>

namespace crackle {

MomentTensor moment_of_jump(const Lame& rock, Vec2 direction, double length, double opening, double slip) {
  const Vec2 t = (1.0 / norm(direction)) * direction;
  const Vec2 n = right_normal(t);
  const Vec2 u = opening * n + slip * t;
  const double volume = rock.lambda * opening;
  return {length * (volume + 2.0 * rock.shear_modulus * u.x * n.x),
          length * (volume + 2.0 * rock.shear_modulus * u.y * n.y), length * volume,
          length * rock.shear_modulus * (u.x * n.y + u.y * n.x)};
}

double scalar_moment(const MomentTensor& m) {
  return std::sqrt(0.5 * (m.xx * m.xx + m.yy * m.yy + m.zz * m.zz + 2.0 * m.xy * m.xy));
}

double moment_magnitude(double moment) { return 2.0 / 3.0 * (std::log10(std::max(moment, 1e-6)) - 9.1); }

MomentShares moment_shares(const MomentTensor& m) {
  const double mean = 0.5 * (m.xx + m.yy), radius = std::hypot(0.5 * (m.xx - m.yy), m.xy);
  std::array<double, 3> e{mean + radius, mean - radius, m.zz};
  std::sort(e.begin(), e.end(), std::greater<>());
  const double iso = (e[0] + e[1] + e[2]) / 3.0;
  const double skew = e[0] + e[2] - 2.0 * e[1];
  const double clvd = 2.0 / 3.0 * skew;
  const double dc = 0.5 * (e[0] - e[2] - std::abs(skew));
  const double sum = std::abs(iso) + std::abs(clvd) + dc;
  if (!(sum > 0.0)) return {};
  return {iso / sum, clvd / sum, dc / sum};
}

const char* to_string(SourceType type) {
  switch (type) {
    case SourceType::tensile:
      return "tensile";
    case SourceType::shear:
      return "shear";
    case SourceType::mixed:
      return "mixed";
    case SourceType::closing:
      return "closing";
  }
  return "unknown";
}

SourceType source_type(double opening, double slip) {
  const double angle = std::atan2(opening, std::abs(slip)) * 180.0 / std::numbers::pi;
  if (angle >= 60.0) return SourceType::tensile;
  if (angle < -30.0) return SourceType::closing;
  return angle <= 30.0 ? SourceType::shear : SourceType::mixed;
}

}  // namespace crackle
