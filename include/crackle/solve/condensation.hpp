// SPDX-License-Identifier: GPL-3.0-or-later
//
// Static condensation of the rock onto the jumps of a fracture's path:
//   S = K_jj − K_jI K_II⁻¹ K_Ij,   K_II: the intact mesh, factorised once
// K_Ij: forces on the intact mesh by a unit jump of one sector's triangles. One back substitution for
// every new unknown; the rest of S is untouched by it. Loads f on the rock act on the jumps as
//   f_j − K_jI K_II⁻¹ f_I
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "crackle/solid/bulk.hpp"
#include "crackle/solve/fracture_path.hpp"

namespace crackle {

/// Share of a corner of a triangle in a load: its force per unit of the load.
struct PointLoad {
  Index triangle = -1;
  Index vertex = -1;
  Vec2 force;
};

class Condensation {
 public:
  /// Factorises the stiffness of the intact rock. @throws NumericalError when nothing holds it
  Condensation(std::shared_ptr<const Mesh> mesh, const Bulk& bulk, const Held& held);
  ~Condensation();

  /// Displacement [m] of all vertices of the intact rock by forces [N/m].
  std::vector<Vec2> respond(const std::vector<PointLoad>& forces) const;

  /// Adds a load on the rock; before any unknown is followed. Loads are numbered as they come.
  void add_load(std::vector<PointLoad> forces);
  const std::vector<PointLoad>& load(std::size_t number) const;

  /// Makes the unknowns those given; those that it holds already, in the same place, are kept.
  void follow(const std::vector<JumpUnknown>& unknowns);
  std::size_t size() const { return size_; }
  /// S_ij [Pa m/m]: force of unknown i by a unit of unknown j, i >= j.
  const double* row(std::size_t i) const { return stiffness_.data() + i * (i + 1) / 2; }

  /// Force of a unit of a load on unknown i [m2/m per unit].
  double force(std::size_t load, std::size_t i) const;
  /// Work that a unit of load `a` does on what a unit of load `b` moves in the intact rock [J/m].
  double compliance(std::size_t a, std::size_t b) const;

  /// Displacement [m] of all vertices by given jumps [m] and loads; of a vertex on the path, that of the
  /// sector that no unknown holds. @param loads how many units of each; empty: none
  std::vector<Vec2> displacement(std::span<const double> jumps, std::span<const double> loads = {}) const;

 private:
  struct Factor;
  struct Column {
    JumpUnknown unknown;
    std::vector<std::pair<Index, double>> force;  // on the intact mesh's unknowns
  };
  void append(const JumpUnknown& unknown);
  std::vector<Vec2> by_vertex(const double* unknowns) const;
  double overlap(const JumpUnknown& a, const JumpUnknown& b) const;  // K_jj

  std::shared_ptr<const Mesh> mesh_;
  const Bulk& bulk_;
  std::vector<Index> equation_;  // 2 per vertex, -1: held
  std::unique_ptr<Factor> factor_;
  std::vector<Column> columns_;    // may hold more than size_, from a step taken back
  std::vector<double> stiffness_;  // lower triangle by rows
  std::size_t size_ = 0;
};

}  // namespace crackle
