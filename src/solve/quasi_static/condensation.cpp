// SPDX-License-Identifier: GPL-3.0-or-later
#include "crackle/solve/condensation.hpp"

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <algorithm>

#include "crackle/core/errors.hpp"
#include "crackle/solve/element_stiffness.hpp"

namespace crackle {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

constexpr std::array<Vec2, 2> axis{Vec2{1.0, 0.0}, Vec2{0.0, 1.0}};

std::size_t corner_of(const std::array<Index, 3>& triangle, Index vertex) {
  return static_cast<std::size_t>(std::find(triangle.begin(), triangle.end(), vertex) - triangle.begin());
}

}  // namespace

struct Condensation::Factor {
  struct Load {
    std::vector<PointLoad> corners;
    Eigen::VectorXd force, response;  // on the intact mesh's unknowns
    std::vector<double> on_jumps;     // per column
  };
  /// Forces on the intact mesh's unknowns.
  Eigen::VectorXd sum(const std::vector<Index>& equation, const std::vector<PointLoad>& forces) const;

  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver;
  std::vector<Load> loads;
};

Condensation::~Condensation() = default;

Condensation::Condensation(std::shared_ptr<const Mesh> mesh, const Bulk& bulk, const Held& held)
    : mesh_(std::move(mesh)), bulk_(bulk), factor_(std::make_unique<Factor>()) {
  equation_.assign(2 * mesh_->vertices.size(), -1);
  Index count = 0;
  for (std::size_t i = 0; i < equation_.size(); ++i) {
    if (!((held[i / 2] >> (i % 2)) & 1)) equation_[i] = count++;
  }
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(mesh_->triangles.size() * 21);
  for (Index t = 0; t < mesh_->triangle_count(); ++t) {
    const auto g = bulk_.shape_gradients(t);
    const auto& v = mesh_->triangles[at(t)];
    for (std::size_t j = 0; j < 3; ++j) {
      for (std::size_t b = 0; b < 2; ++b) {
        const Index column = equation_[2 * at(v[j]) + b];
        if (column < 0) continue;
        for (std::size_t i = 0; i < 3; ++i) {
          const Vec2 force = bulk_.area(t) * element_force(bulk_.stiffness(t), g[i], g[j], axis[b]);
          for (std::size_t a = 0; a < 2; ++a) {
            const Index row = equation_[2 * at(v[i]) + a];
            if (row >= column) entries.emplace_back(row, column, dot(force, axis[a]));
          }
        }
      }
    }
  }
  Eigen::SparseMatrix<double> stiffness(count, count);
  stiffness.setFromTriplets(entries.begin(), entries.end());
  factor_->solver.compute(stiffness);
  if (factor_->solver.info() != Eigen::Success || !(factor_->solver.vectorD().minCoeff() > 0.0))
    throw NumericalError(
        "static condensation: the stiffness matrix is singular; is the rock held by nothing?");
}

const std::vector<PointLoad>& Condensation::load(std::size_t number) const {
  return factor_->loads[number].corners;
}

Eigen::VectorXd Condensation::Factor::sum(const std::vector<Index>& equation,
                                          const std::vector<PointLoad>& forces) const {
  Eigen::VectorXd all = Eigen::VectorXd::Zero(solver.rows());
  for (const PointLoad& corner : forces) {
    for (std::size_t a = 0; a < 2; ++a) {
      const Index row = equation[2 * at(corner.vertex) + a];
      if (row >= 0) all[row] += dot(corner.force, axis[a]);
    }
  }
  return all;
}

std::vector<Vec2> Condensation::by_vertex(const double* unknowns) const {
  std::vector<Vec2> result(mesh_->vertices.size());
  for (std::size_t v = 0; v < result.size(); ++v) {
    const Index x = equation_[2 * v], y = equation_[2 * v + 1];
    result[v] = {x < 0 ? 0.0 : unknowns[x], y < 0 ? 0.0 : unknowns[y]};
  }
  return result;
}

std::vector<Vec2> Condensation::respond(const std::vector<PointLoad>& forces) const {
  const Eigen::VectorXd u = factor_->solver.solve(factor_->sum(equation_, forces));
  return by_vertex(u.data());
}

void Condensation::add_load(std::vector<PointLoad> forces) {
  Factor::Load load{std::move(forces), {}, {}, {}};
  load.force = factor_->sum(equation_, load.corners);
  load.response = factor_->solver.solve(load.force);
  factor_->loads.push_back(std::move(load));
}

double Condensation::force(std::size_t load, std::size_t i) const { return factor_->loads[load].on_jumps[i]; }

double Condensation::compliance(std::size_t a, std::size_t b) const {
  return factor_->loads[a].force.dot(factor_->loads[b].response);
}

double Condensation::overlap(const JumpUnknown& a, const JumpUnknown& b) const {
  double sum = 0.0;
  for (const Index t : a.triangles) {
    if (!std::binary_search(b.triangles.begin(), b.triangles.end(), t)) continue;
    const auto g = bulk_.shape_gradients(t);
    const auto& v = mesh_->triangles[at(t)];
    sum += bulk_.area(t) * dot(a.direction, element_force(bulk_.stiffness(t), g[corner_of(v, a.vertex)],
                                                          g[corner_of(v, b.vertex)], b.direction));
  }
  return sum;
}

void Condensation::append(const JumpUnknown& unknown) {
  Column column{unknown, {}};
  Eigen::VectorXd force = Eigen::VectorXd::Zero(factor_->solver.rows());
  for (const Index t : unknown.triangles) {
    const auto g = bulk_.shape_gradients(t);
    const auto& v = mesh_->triangles[at(t)];
    const Vec2 moved = g[corner_of(v, unknown.vertex)];
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec2 f = bulk_.area(t) * element_force(bulk_.stiffness(t), g[i], moved, unknown.direction);
      for (std::size_t a = 0; a < 2; ++a) {
        const Index row = equation_[2 * at(v[i]) + a];
        if (row < 0) continue;
        column.force.emplace_back(row, 0.0);
        force[row] += dot(f, axis[a]);
      }
    }
  }
  std::sort(column.force.begin(), column.force.end());
  column.force.erase(std::unique(column.force.begin(), column.force.end()), column.force.end());
  for (auto& [row, value] : column.force) value = force[row];
  for (Factor::Load& load : factor_->loads) {
    double f = 0.0;
    for (const PointLoad& corner : load.corners) {
      if (corner.vertex == unknown.vertex &&
          std::binary_search(unknown.triangles.begin(), unknown.triangles.end(), corner.triangle))
        f += dot(corner.force, unknown.direction);
    }
    for (const auto& [row, value] : column.force) f -= value * load.response[row];
    load.on_jumps.push_back(f);
  }
  const Eigen::VectorXd response = factor_->solver.solve(force);
  columns_.push_back(std::move(column));
  for (const Column& other : columns_) {
    double s = overlap(other.unknown, unknown);
    for (const auto& [row, value] : other.force) s -= value * response[row];
    stiffness_.push_back(s);
  }
}

void Condensation::follow(const std::vector<JumpUnknown>& unknowns) {
  for (size_ = 0; size_ < unknowns.size(); ++size_) {
    if (size_ < columns_.size() && columns_[size_].unknown == unknowns[size_]) continue;
    if (size_ < columns_.size()) {
      columns_.resize(size_);
      stiffness_.resize(size_ * (size_ + 1) / 2);
      for (Factor::Load& load : factor_->loads) load.on_jumps.resize(size_);
    }
    append(unknowns[size_]);
  }
}

std::vector<Vec2> Condensation::displacement(std::span<const double> jumps,
                                             std::span<const double> loads) const {
  Eigen::VectorXd force = Eigen::VectorXd::Zero(factor_->solver.rows());
  for (std::size_t l = 0; l < loads.size(); ++l) force += loads[l] * factor_->loads[l].force;
  for (std::size_t k = 0; k < jumps.size(); ++k) {
    for (const auto& [row, value] : columns_[k].force) force[row] -= value * jumps[k];
  }
  const Eigen::VectorXd u = factor_->solver.solve(force);
  return by_vertex(u.data());
}

}  // namespace crackle
