// SPDX-License-Identifier: GPL-3.0-or-later
//
// One explicit step of rock and intact cohesive elements, tile by tile. A tile is a block of triangles that
// follow one another along the Hilbert curve, with its nodes copied into arrays that stay in the first cache:
// forces are summed there, and nodes that no other tile has a corner of move at once. What several tiles have
// a part in is summed over the tiles in their order and moves after the last of them. A cohesive element
// belongs to the tile of its face a, which has its other two nodes among its own: it is evaluated there while
// it is intact; the force of an active one (state.cohesive.force) is only added.
//
// Memory moved and operations per triangle and step: cases/scaling/README.md.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "crackle/cohesive/cohesive.hpp"
#include "crackle/solid/bulk.hpp"

namespace crackle {

/// The layout is derived from the state: made anew from the same state it is the same, and so are all bits.
class Tiles {
 public:
  struct Physics {
    const Bulk& bulk;
    const Cohesive* cohesive;  ///< nullptr: no cohesive elements
  };

  Tiles(const State& state, const Physics& physics);
  Tiles(Tiles&&) noexcept;
  Tiles& operator=(Tiles&&) = delete;
  ~Tiles();

  /// Adds the forces of rock and cohesive elements and moves the nodes: v += Δt f/m, x += Δt v. Triangle t is
  /// in tile t / block_size.
  /// @param stressed per triangle, set to 1 where it passes the screen, else 0; empty: no screen
  /// @param tile_stressed per tile: any triangle is
  /// @return viscous dissipation of the step before times 1/dt [W/m], by tiles
  const std::vector<double>& move(State& state, const Physics& physics, double dt, const StressScreen& screen,
                                  std::span<std::uint8_t> stressed, std::span<char> tile_stressed);

  /// Elements that the last move() found near their strength and that are not active yet, ascending.
  std::span<const Index> near() const { return near_; }

  /// Tells that triangles were damaged: their forces (state.damage) are only added.
  void triangles_changed(const State& state, const Physics& physics, std::span<const Index> triangles);
  /// Tells that elements have become active.
  void elements_changed(const State& state, const Physics& physics, std::span<const Index> elements);
  /// Tells that elements were inserted on edges of the mesh, and nodes at their ends may have parted.
  void inserted(const State& state, const Physics& physics, std::span<const Index> edges);

 private:
  struct Tile;
  struct Scratch;
  struct Reads;

  void sort_by_material(const Bulk& bulk, Index i);
  void number_nodes(const State& state, Index i);
  void number_corners(const State& state, const Bulk& bulk, Index i);
  void list_elements(const State& state, const Cohesive* cohesive, Index i);
  static void set_element(const State& state, Tile& tile, int group, int lane, Index element);
  template <class Visit>
  static void for_shared(const Tile& tile, const Visit& visit);
  void link(const State& state, Index i);
  void work(State& state, const Physics& physics, Index i, double dt, const StressScreen& screen,
            std::span<std::uint8_t> stressed, std::span<char> tile_stressed);
  static void fetch_owned(const State& state, const Tile& tile);
  static void fetch_nodes(const State& state, const Tile& tile);
  /// Of the nodes whose last part is the tile's, those whose first part is in one of [begin, end).
  static void move_shared(State& state, const Tile& tile, double dt, Index begin, Index end);

  std::vector<Tile> tiles_;
  std::vector<std::vector<Index>> near_of_tile_;
  std::vector<Index> near_;
  std::vector<double> power_;
};

}  // namespace crackle
