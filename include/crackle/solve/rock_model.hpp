// SPDX-License-Identifier: GPL-3.0-or-later
//
// The rock of a scene, the same in steps and in field time: its mesh, layers and joints, and what each of its
// triangles and edges is made of.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "crackle/cohesive/law.hpp"
#include "crackle/solid/bulk.hpp"
#include "crackle/solid/stiffness.hpp"

namespace crackle {

/// An edge of a joint, there from the start: before the geostatic stage, in which it may slip.
struct JointEdge {
  Index edge = -1;             ///< of the mesh, between two triangles
  std::uint16_t material = 1;  ///< number of its material: 1 is the first of RockModel::joint_materials
  bool bonded = false;         ///< breaks by its own strength; else closed, held by friction alone
};

/// A rock and its in-situ stress.
struct RockMass {
  PlaneStiffness stiffness;
  std::optional<PlaneStiffness> triangle_stiffness;  ///< where it is not the rock's, see compensated()
  double density = 0.0;                              ///< [kg/m3]
  Sym2 stress;                                       ///< in situ, effective, at the origin [Pa]
  Sym2 stress_gradient;                              ///< its change per metre of depth, −y; xy is 0 [Pa/m]
  CohesiveMaterial cohesive;                         ///< of its cohesive elements
};

/// All of it: its own rock is what is not in a layer.
struct RockModel : RockMass {
  std::shared_ptr<const Mesh> mesh;  ///< excavated
  std::vector<RockMass> layers;
  std::vector<std::uint16_t> layer_of_triangle;  ///< 0: none, 1: the first; empty: none anywhere
  std::vector<JointEdge> joints;                 ///< ascending by edge
  std::vector<CohesiveMaterial>
      joint_materials;  ///< the strengths of one that is not bonded are not asked for

  /// Of a layer by its number, as in layer_of_triangle.
  const RockMass& rock(std::size_t layer) const {
    if (layer == 0) return *this;
    return layers[layer - 1];
  }
  const RockMass& rock_of(Index triangle) const {
    return rock(layer_of_triangle.empty() ? 0 : layer_of_triangle[static_cast<std::size_t>(triangle)]);
  }
  /// The joint that runs along an edge of the mesh; nullptr: none.
  const JointEdge* joint_at(Index edge) const;
};

/// The rock between the fractures.
Bulk bulk_of(const RockModel& scene, const Bulk::Damping& damping);

/// Cohesive materials by their numbers: the rock's, those of joints, of layers, and of edges between two
/// rocks, which have the lower of each strength and fracture energy.
struct EdgeMaterials {
  std::vector<CohesiveMaterial> all;
  std::vector<std::uint16_t> of_edge;  ///< of the mesh, as far as no joint runs there; empty: all the rock's
  std::uint16_t number(Index edge) const {
    return of_edge.empty() ? std::uint16_t{0} : of_edge[static_cast<std::size_t>(edge)];
  }
};
EdgeMaterials edge_materials(const RockModel& scene);

}  // namespace crackle
