// SPDX-License-Identifier: GPL-3.0-or-later
#include "sparse_solver.hpp"

#include <Eigen/SparseCore>
#include <Eigen/SparseLU>
#include <memory>

#include "crackle/core/errors.hpp"

namespace crackle {

SparseSolver sparse_solver() {
  using Matrix = Eigen::SparseMatrix<double>;
  const auto lu = std::make_shared<Eigen::SparseLU<Matrix>>();
  return [lu](std::span<const MatrixEntry> entries, std::span<double> b, bool fresh) {
    std::vector<Eigen::Triplet<double>> triplets;
    triplets.reserve(entries.size());
    for (const MatrixEntry& e : entries) triplets.emplace_back(e.row, e.column, e.value);
    const auto size = static_cast<Eigen::Index>(b.size());
    Matrix matrix(size, size);
    matrix.setFromTriplets(triplets.begin(), triplets.end());
    if (fresh) lu->analyzePattern(matrix);
    lu->factorize(matrix);
    if (lu->info() != Eigen::Success) throw NumericalError("flow in fractures: the matrix is singular");
    Eigen::Map<Eigen::VectorXd> right(b.data(), size);
    right = lu->solve(Eigen::VectorXd(right));
  };
}

}  // namespace crackle
