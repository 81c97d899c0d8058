// SPDX-License-Identifier: GPL-3.0-or-later
//
// Softening of a smeared crack: its traction over the strength σ_c, f(x), against its opening (slip) over
// G/σ_c, x. The area under the curve is 1, so that the crack dissipates G.
//
// | law         | f(x)                   | ends at | η = 1/max|f'| |
// |-------------|------------------------|---------|---------------|
// | linear      | 1 − x/2                | 2       | 2             |
// | exponential | e^−x                   | ln 10⁴  | 1             |
// | cubic_step  | (1 − y)² (1 + 2y), y = x/2 | 2   | 4/3           |
//
// (Nairn, Hammerquist, Aimene 2017.) A triangle of element length ℓ can follow its curve only where
// ℓ ≤ η G A/σ_c², A its stiffness across the crack: beyond, its elastic energy is above G ℓ⁻¹ at once.
#pragma once

#include <memory>
#include <string>
#include <vector>

namespace crackle {

class SofteningLaw {
 public:
  virtual ~SofteningLaw() = default;
  virtual std::string name() const = 0;
  /// One line: form.
  virtual std::string description() const = 0;
  /// f(x): share of the strength left at an opening of x G/σ_c; 1 at 0, falling.
  virtual double traction(double x) const = 0;
  virtual double slope(double x) const = 0;  ///< df/dx
  /// ∫₀ˣ f dx
  virtual double area(double x) const = 0;
  /// x from which nothing is borne.
  virtual double end() const = 0;

  /// What is dissipated when unloaded to the origin from x, over G: ∫₀ˣ f dx − ½ x f.
  double dissipated(double x) const;
  /// η above.
  double size_factor() const;
  /// x at which the crack and the elastic triangle in series, whose strain at the strength is r G/σ_c, have
  /// the strain u G/σ_c: x + r f(x) = u. @param r below size_factor() @return 0 below the strength, end()
  /// beyond the end
  double loaded(double r, double u) const;
  /// Share d = x/(x + r f) of the stiffness that is lost at x, and its inverse.
  double damage(double r, double x) const;
  double at_damage(double r, double damage) const;
};

/// A registered law by name; nullptr if there is none of that name.
std::shared_ptr<const SofteningLaw> find_softening(const std::string& name);
/// All of them, by name.
std::vector<std::shared_ptr<const SofteningLaw>> registered_softening();

}  // namespace crackle
