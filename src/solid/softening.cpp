// SPDX-License-Identifier: GPL-3.0-or-later
#include "crackle/solid/softening.hpp"

#include <algorithm>
#include <cmath>

namespace crackle {
namespace {

class Linear final : public SofteningLaw {
 public:
  std::string name() const override { return "linear"; }
  std::string description() const override { return "f = 1 - x/2"; }
  double traction(double x) const override { return std::max(0.0, 1.0 - 0.5 * x); }
  double slope(double x) const override { return x < 2.0 ? -0.5 : 0.0; }
  double area(double x) const override { return x < 2.0 ? x - 0.25 * x * x : 1.0; }
  double end() const override { return 2.0; }
};

class Exponential final : public SofteningLaw {
 public:
  std::string name() const override { return "exponential"; }
  std::string description() const override { return "f = exp(-x), cut at 1e-4"; }
  double traction(double x) const override { return x < end() ? std::exp(-x) : 0.0; }
  double slope(double x) const override { return x < end() ? -std::exp(-x) : 0.0; }
  double area(double x) const override { return 1.0 - std::exp(-std::min(x, end())); }
  double end() const override { return 4.0 * std::log(10.0); }
};

class CubicStep final : public SofteningLaw {
 public:
  std::string name() const override { return "cubic_step"; }
  std::string description() const override { return "f = (1 - y)^2 (1 + 2 y), y = x/2"; }
  double traction(double x) const override {
    const double y = std::min(0.5 * x, 1.0);
    return (1.0 - y) * (1.0 - y) * (1.0 + 2.0 * y);
  }
  double slope(double x) const override {
    const double y = std::min(0.5 * x, 1.0);
    return -3.0 * y * (1.0 - y);
  }
  double area(double x) const override {
    const double y = std::min(0.5 * x, 1.0);
    return 2.0 * y * (1.0 - y * y * (1.0 - 0.5 * y));
  }
  double end() const override { return 2.0; }
};

// Root of a rising function in [low, high], by Newton's method kept inside by bisection.
template <class Value, class Slope>
double root(double low, double high, const Value& value, const Slope& slope) {
  double x = 0.5 * (low + high);
  for (int i = 0; i < 100 && high - low > 1e-15 * high; ++i) {
    const double miss = value(x);
    (miss < 0.0 ? low : high) = x;
    const double newton = x - miss / slope(x);
    const double next = newton > low && newton < high ? newton : 0.5 * (low + high);
    if (std::abs(next - x) <= 1e-15 * high) return next;
    x = next;
  }
  return x;
}

}  // namespace

double SofteningLaw::dissipated(double x) const { return area(x) - 0.5 * std::min(x, end()) * traction(x); }

double SofteningLaw::size_factor() const {
  double steepest = 0.0;
  for (int i = 0; i <= 1000; ++i) steepest = std::max(steepest, -slope(1e-3 * i * 0.999999 * end()));
  return 1.0 / steepest;
}

double SofteningLaw::loaded(double r, double u) const {
  if (u <= r) return 0.0;
  if (u >= end()) return end();
  return root(
      0.0, u, [&](double x) { return x + r * traction(x) - u; },
      [&](double x) { return 1.0 + r * slope(x); });
}

double SofteningLaw::damage(double r, double x) const {
  if (x <= 0.0) return 0.0;
  return x < end() ? x / (x + r * traction(x)) : 1.0;
}

double SofteningLaw::at_damage(double r, double damage) const {
  if (damage <= 0.0) return 0.0;
  if (damage >= 1.0) return end();
  return root(
      0.0, end(), [&](double x) { return x * (1.0 - damage) - damage * r * traction(x); },
      [&](double x) { return 1.0 - damage - damage * r * slope(x); });
}

std::vector<std::shared_ptr<const SofteningLaw>> registered_softening() {
  static const std::vector<std::shared_ptr<const SofteningLaw>> laws{
      std::make_shared<CubicStep>(), std::make_shared<Exponential>(), std::make_shared<Linear>()};
  return laws;
}

std::shared_ptr<const SofteningLaw> find_softening(const std::string& name) {
  for (const auto& law : registered_softening()) {
    if (law->name() == name) return law;
  }
  return nullptr;
}

}  // namespace crackle
