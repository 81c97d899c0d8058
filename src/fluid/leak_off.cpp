// SPDX-License-Identifier: GPL-3.0-or-later
#include "crackle/fluid/leak_off.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace crackle {

CarterLeakOff::Volume CarterLeakOff::volume(double before, double dt, double pressure, double bare) const {
  const double reach = 2.0 * coefficient * bare;
  const double full = std::sqrt(before * before + reach * reach * dt) - before;
  const double share = (pressure - reservoir_pressure) / cut_off;
  if (share <= 0.0) return {};
  if (share >= 1.0) return {full, 0.0};
  return {full * share, full / cut_off};
}

namespace {

constexpr double first_width = 1e-4, growth = 1.25;

}  // namespace

int diffusion_cells(const MatrixRock& rock, double time) {
  const double reach =
      6.0 * std::sqrt(rock.permeability * time / (rock.porosity * rock.compressibility * rock.viscosity));
  const double cells = std::log1p(reach * (growth - 1.0) / first_width) / std::log(growth);
  return std::max(40, static_cast<int>(std::ceil(cells)));
}

MatrixDiffusion::MatrixDiffusion(const MatrixRock& rock) : rock_(rock) {
  double width = first_width;
  double before = 0.0;
  for (int i = 0; i < rock.cells; ++i) {
    width_.push_back(width);
    transmissibility_.push_back(rock.permeability / rock.viscosity / (0.5 * (before + width)));
    before = width;
    width *= growth;
  }
}

double MatrixDiffusion::reach() const { return std::accumulate(width_.begin(), width_.end(), 0.0); }

void MatrixDiffusion::eliminate(double dt, std::span<const double> profile, std::vector<double>& a,
                                std::vector<double>& b) const {
  const std::size_t n = width_.size();
  a.resize(n);
  b.resize(n);
  for (std::size_t i = n; i-- > 0;) {
    const double store = rock_.porosity * rock_.compressibility * width_[i] / dt;
    const double in = transmissibility_[i];
    double diagonal = store + in, right = store * profile[i];
    if (i + 1 < n) {
      diagonal += transmissibility_[i + 1] * (1.0 - a[i + 1]);
      right += transmissibility_[i + 1] * b[i + 1];
    }
    a[i] = in / diagonal;
    b[i] = right / diagonal;
  }
}

MatrixDiffusion::Response MatrixDiffusion::response(std::span<const double> profile, double dt) const {
  std::vector<double> a, b;
  eliminate(dt, profile, a, b);
  return {dt * transmissibility_[0] * (1.0 - a[0]), -dt * transmissibility_[0] * b[0]};
}

void MatrixDiffusion::advance(std::span<double> profile, double dt, double pressure) const {
  std::vector<double> a, b;
  eliminate(dt, profile, a, b);
  double before = pressure;
  for (std::size_t i = 0; i < profile.size(); ++i) before = profile[i] = a[i] * before + b[i];
}

double MatrixDiffusion::stored(std::span<const double> profile) const {
  double sum = 0.0;
  for (std::size_t i = 0; i < profile.size(); ++i)
    sum += rock_.porosity * rock_.compressibility * width_[i] * (profile[i] - rock_.reservoir_pressure);
  return sum;
}

}  // namespace crackle
