// SPDX-License-Identifier: GPL-3.0-or-later
//
// One tile of Tiles: which nodes, triangles and elements, under which numbers. Rows of eight as kernel.hpp
// wants them.
#pragma once

#include <algorithm>
#include <array>

#include "crackle/core/parallel.hpp"
#include "crackle/solve/tiles.hpp"
#include "kernel.hpp"

namespace crackle {

namespace tiles {

struct alignas(64) Row {
  std::array<double, lanes> lane{};
};

// Triangles (or elements) of one lane follow one another, so that the eight of a group share no node as a
// rule and their sums do not wait for one another.
struct Place {
  int group, lane;
};
inline Place place_of(Index i, int groups) { return {i % groups, i / groups}; }
template <class Work>
void for_each_place(Index items, int groups, const Work& work) {
  for (Index i = 0, lane = 0; i < items; ++lane) {
    for (Index group = 0; group < groups && i < items; ++group, ++i) work(i, Place{group, lane});
  }
}
inline int groups_of(std::size_t items) { return static_cast<int>((items + lanes - 1) / lanes); }

// Nodes that stand for none: corners of what fills up a group.
inline constexpr Index dummies = 3;

template <class Work>
void for_each_tile(std::size_t count, const Work& work) {
  for_each_block(static_cast<Index>(count) * block_size, [&](Index, Index, Index tile) { work(tile); });
}

}  // namespace tiles

struct Tiles::Tile {
  struct Damaged {
    Index number;  // into state.damage.triangles
    std::array<std::uint16_t, 3> corners;
  };
  struct Added {  // an element whose force is only added
    Index element;
    std::array<std::uint16_t, 4> ends;
  };
  struct Batch {  // triangles or elements of one material
    std::uint16_t material;
    int first, groups;  // of the groups
  };

  Index begin = 0, end = 0;  // triangles
  // Nodes of its triangles and of its elements, ascending.
  std::vector<tiles::Run> nodes;
  Index count = 0;                     // so many
  std::vector<tiles::Run> own;         // those of them that no other tile has a part in
  std::vector<std::uint16_t> shared;   // numbers in the tile of the rest
  std::vector<Batch> rocks;            // its triangles, by material
  std::vector<tiles::Place> places;    // of the triangles, where there are several materials
  std::vector<std::uint16_t> corners;  // [group][corner][lane]
  std::vector<tiles::Row> sides;       // [group][from corner 0 to 1, to 2: x y x y], reference
  std::vector<Damaged> damaged;        // fill up their groups like triangles that are not there
  Sym2 stress;                         // in-situ, where it is the same in all triangles
  std::vector<tiles::Row> in_situ;     // [group][component]; empty: the same in all triangles
  std::vector<tiles::Row> viscosity;   // [group]
  std::vector<Batch> batches;
  std::vector<Index> elements;      // evaluated here: [group][lane]; -1: none
  std::vector<std::uint16_t> ends;  // [group][end][lane]
  std::vector<tiles::Row> numbers;  // [group][7]
  std::vector<tiles::Row> limits;   // [group][4]; empty: those of the materials
  std::vector<Added> added;
  std::vector<Vec2> partial;  // forces on shared nodes
  // Shared nodes of which this is the last tile: their parts in all tiles.
  std::vector<Index> owned;
  std::vector<Index> from;           // the first tile that has a part in each
  std::vector<std::uint16_t> parts;  // of each
  std::vector<const Vec2*> part;

  int groups() const { return rocks.back().first + rocks.back().groups; }
  /// @param t counted from the tile's first triangle
  tiles::Place place(Index t) const {
    return places.empty() ? tiles::place_of(t, groups()) : places[static_cast<std::size_t>(t)];
  }
  template <class Work>
  void for_each_triangle(const Work& work) const {
    if (places.empty()) return tiles::for_each_place(end - begin, groups(), work);
    for (Index t = 0; t < end - begin; ++t) work(t, places[static_cast<std::size_t>(t)]);
  }
  /// Whole and of one rock: the state's strain rates lie in its order.
  bool regular() const { return places.empty() && end - begin == block_size; }
  int element_groups() const { return static_cast<int>(elements.size()) / tiles::lanes; }
  // Four times the number of a node in the tile.
  std::uint16_t name(Index node) const { return static_cast<std::uint16_t>(4 * local(node)); }
  std::uint16_t dummy(Index k) const { return static_cast<std::uint16_t>(4 * (count + k)); }
  std::uint16_t local(Index node) const {
    const auto after = std::upper_bound(nodes.begin(), nodes.end(), node,
                                        [](Index n, const tiles::Run& run) { return n < run.node; });
    const tiles::Run& run = *(after - 1);
    return static_cast<std::uint16_t>(run.local + (node - run.node));
  }
};

// What a tile reads, for tiles::Ahead.
struct Tiles::Reads {
  std::array<tiles::Ahead::Range, 18> ranges;
  std::size_t count = 0;
  std::size_t lines = 0;

  Reads(const State& state, const Tile& tile);

 private:
  void add(tiles::Ahead::Range r);
};

}  // namespace crackle
