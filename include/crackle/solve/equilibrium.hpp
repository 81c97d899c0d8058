// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "crackle/solid/bulk.hpp"
#include "crackle/state/state.hpp"

namespace crackle {

/// Adds loads to the forces per corner [N/m] of a tied state in its present place (they may follow its
/// motion, as a pressure does).
using AddLoads = std::function<void(const State&, std::span<Vec2>)>;

/// Static equilibrium of the intact rock (all edges tied) under its in-situ stress and loads, by a
/// sparse direct factorisation, made once, and Newton corrections with it: no steps.
class StaticSolver {
 public:
  /// @param fixed one per vertex: held at zero displacement
  /// @throws NumericalError when the system is singular (nothing holds the body)
  StaticSolver(std::shared_ptr<const Mesh> mesh, const Bulk& bulk, const std::vector<char>& fixed);
  ~StaticSolver();

  /// Displacement of every vertex [m]. @param start where to begin; empty: at rest
  /// @throws NumericalError when there is no equilibrium near
  std::vector<Vec2> displacement(const AddLoads& add_loads, std::vector<Vec2> start = {}) const;

 private:
  struct Factor;
  std::shared_ptr<const Mesh> mesh_;
  const Bulk& bulk_;
  std::vector<Index> unknown_;  // of a vertex; -1: held
  Index count_ = 0;
  std::unique_ptr<Factor> factor_;
};

/// One equilibrium, factor and all.
std::vector<Vec2> static_displacement(const std::shared_ptr<const Mesh>& mesh, const Bulk& bulk,
                                      const std::vector<char>& fixed, const AddLoads& add_loads);

}  // namespace crackle
