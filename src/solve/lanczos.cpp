// SPDX-License-Identifier: GPL-3.0-or-later
#include "crackle/solve/lanczos.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

#include "crackle/core/parallel.hpp"

namespace crackle {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

using Field = std::vector<Vec2>;  // a vector per node

double product(const Field& a, const Field& b) {
  return sum_over_blocks(static_cast<Index>(a.size()), [&](Index begin, Index end) {
    double sum = 0.0;
    for (Index n = begin; n < end; ++n) sum += dot(a[at(n)], b[at(n)]);
    return sum;
  });
}

// M^-½ A M^-½ with A the stiffness of rock and elements, or the viscosity of the rock.
class MassScaled {
 public:
  enum class Part { stiffness, viscosity };

  MassScaled(const State& state, const Bulk& bulk, const Cohesive* cohesive, Part part)
      : state_(state), bulk_(bulk), cohesive_(cohesive), part_(part), corner_(state.node_of_corner.size()) {
    for (const double inverse : state.inverse_mass) scale_.push_back(std::sqrt(inverse));
  }

  void apply(const Field& x, Field& y) {
    scaled_.resize(x.size());
    for (std::size_t n = 0; n < x.size(); ++n) scaled_[n] = scale_[n] * x[n];
    for_each_block(state_.mesh->triangle_count(), [&](Index begin, Index end, Index) {
      for (Index t = begin; t < end; ++t) add_triangle(t);
    });
    for_each_block(state_.node_count(), [&](Index begin, Index end, Index) {
      for (Index n = begin; n < end; ++n) {
        Vec2 sum;
        for (Index j = 0; j < state_.node_size[at(n)]; ++j)
          sum += corner_[at(state_.node_corners[at(state_.node_first[at(n)] + j)])];
        y[at(n)] = sum;
      }
    });
    if (cohesive_ != nullptr && part_ == Part::stiffness) {
      for (Index e = 0; e < state_.cohesive.count(); ++e) add_element(e, y);
    }
    for (std::size_t n = 0; n < y.size(); ++n) y[n] *= scale_[n];
  }

 private:
  void add_triangle(Index t) {
    const auto gradient = bulk_.shape_gradients(t);
    Sym2 strain;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec2 u = scaled_[at(state_.node_of_corner[at(3 * t) + i])], g = gradient[i];
      strain = strain + Sym2{u.x * g.x, u.y * g.y, 0.5 * (u.x * g.y + u.y * g.x)};
    }
    const Sym2 stress =
        part_ == Part::stiffness ? bulk_.stiffness(t).stress(strain) : bulk_.viscosity(t) * strain;
    for (std::size_t i = 0; i < 3; ++i) corner_[at(3 * t) + i] = bulk_.area(t) * (stress * gradient[i]);
  }

  // Springs p_f/L over the length L: p_f [1/3 1/6; 1/6 1/3] on the jumps at both ends, in any direction.
  void add_element(Index e, Field& y) const {
    if (state_.cohesive.status[at(e)] == CohesiveStatus::released) return;
    const auto& n = state_.cohesive.nodes[at(e)];
    const CohesiveMaterial material = cohesive_->material(state_, e);
    const double third = std::max(material.penalty, material.tangential_penalty) / 3.0;
    const Vec2 jump0 = scaled_[at(n[2])] - scaled_[at(n[0])], jump1 = scaled_[at(n[3])] - scaled_[at(n[1])];
    const Vec2 f0 = third * (jump0 + 0.5 * jump1), f1 = third * (0.5 * jump0 + jump1);
    y[at(n[0])] -= f0;
    y[at(n[1])] -= f1;
    y[at(n[2])] += f0;
    y[at(n[3])] += f1;
  }

  const State& state_;
  const Bulk& bulk_;
  const Cohesive* cohesive_;
  Part part_;
  std::vector<double> scale_;
  Field scaled_, corner_;
};

// The same for everyone: xorshift64*. Sums of four are near enough to a normal distribution: no direction is
// preferred.
Field start_vector(std::size_t size) {
  std::uint64_t x = 0x2545f4914f6cdd1dULL;
  const auto random = [&] {
    x ^= x >> 12;
    x ^= x << 25;
    x ^= x >> 27;
    return static_cast<double>((x * 0x2545f4914f6cdd1dULL) >> 11) / 9007199254740992.0 - 0.5;
  };
  Field v(size);
  for (Vec2& u : v) {
    u.x = (random() + random()) + (random() + random());
    u.y = (random() + random()) + (random() + random());
  }
  return v;
}

struct Largest {
  double value = 0.0, residual = 0.0, margin = 0.0;
};

// See the head of lanczos.hpp; a share of the largest eigenvalue.
double margin_after(int products, std::size_t unknowns) {
  const double root =
      (std::log(1.648 * std::sqrt(static_cast<double>(unknowns))) - std::log(1e-9)) / (2.0 * products - 1.0);
  return std::min(1.0, root * root);
}

Largest largest_eigenvalue(MassScaled& matrix, std::size_t size, int products) {
  Field now = start_vector(size), before(size), next(size);
  matrix.apply(now, next);  // held nodes drop out
  double beta = std::sqrt(product(next, next));
  if (beta == 0.0) return {};
  std::swap(now, next);
  std::vector<double> diagonal, side;
  bool all = false;
  for (int j = 0; j < products; ++j) {
    for (Vec2& u : now) u *= 1.0 / beta;
    matrix.apply(now, next);
    const double alpha = product(next, now);
    const double back = j > 0 ? beta : 0.0;
    for (std::size_t n = 0; n < size; ++n) next[n] += -alpha * now[n] - back * before[n];
    diagonal.push_back(alpha);
    beta = std::sqrt(product(next, next));
    side.push_back(beta);
    if (beta <= 1e-12 * alpha) {  // nothing else is left of the start vector: this is all there is
      all = true;
      break;
    }
    before = now;
    std::swap(now, next);
  }
  // Scaled: this solver's test of what is as good as zero is not free of the unit. It gave eigenvalues in
  // any order then, and the last one was a step of 1.23 times the stable one.
  const double scale = *std::max_element(diagonal.begin(), diagonal.end());
  const auto count = static_cast<Eigen::Index>(diagonal.size());
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver;
  solver.computeFromTridiagonal(Eigen::Map<Eigen::VectorXd>(diagonal.data(), count) / scale,
                                Eigen::Map<Eigen::VectorXd>(side.data(), count - 1) / scale);
  if (solver.info() != Eigen::Success) return {scale, 1.0, 1.0};
  const double value = scale * solver.eigenvalues()[count - 1];
  return {value, side.back() * std::abs(solver.eigenvectors()(count - 1, count - 1)) / value,
          all ? 1e-9 : margin_after(products, 2 * size)};
}

double step_of(double frequency, double viscous_rate) {
  if (frequency == 0.0) return std::numeric_limits<double>::infinity();
  const double xi = viscous_rate / (2.0 * frequency);
  return 2.0 / frequency * (std::sqrt(1.0 + xi * xi) - xi);
}

}  // namespace

HighestFrequency highest_frequency(const State& state, const Bulk& bulk, const Cohesive* cohesive,
                                   int products) {
  MassScaled stiffness(state, bulk, cohesive, MassScaled::Part::stiffness);
  const Largest rock = largest_eigenvalue(stiffness, state.displacement.size(), products);
  HighestFrequency found{std::sqrt(rock.value), rock.residual, 0.0, rock.margin};
  if (bulk.viscous()) {
    MassScaled viscosity(state, bulk, nullptr, MassScaled::Part::viscosity);
    const Largest rate = largest_eigenvalue(viscosity, state.displacement.size(), products);
    found.viscous_rate = rate.value;
    found.margin = std::max(found.margin, rate.margin);
  }
  return found;
}

double HighestFrequency::stable_step() const { return step_of(frequency, viscous_rate); }

double HighestFrequency::safe_step() const {
  if (margin >= 1.0) return 0.0;
  return step_of(frequency / std::sqrt(1.0 - margin), viscous_rate / (1.0 - margin));
}

StableStep sharpened(const StableStep& proven, const State& state, const Bulk& bulk,
                     const Cohesive* cohesive) {
  const HighestFrequency found = highest_frequency(state, bulk, cohesive, 80);
  StableStep step = proven;
  const double safe = found.safe_step();
  if (std::isfinite(safe) && safe > proven.limit) {
    step.limit = safe;
    step.margin = found.margin;
  }
  return step;
}

}  // namespace crackle
