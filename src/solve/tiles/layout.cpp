// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which nodes, triangles and elements a tile has, made from the state, and again where it has changed.
#include "crackle/core/large_pages.hpp"
#include "tile.hpp"

namespace crackle {
namespace {

using tiles::groups_of;
using tiles::lanes;
using tiles::Place;
using tiles::place_of;

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

void sort_out(std::vector<Index>& items) {
  std::sort(items.begin(), items.end());
  items.erase(std::unique(items.begin(), items.end()), items.end());
}

std::span<const Index> corners_of(const State& state, Index node) {
  return std::span(state.node_corners).subspan(at(state.node_first[at(node)]), at(state.node_size[at(node)]));
}

Index tile_of_corner(Index corner) { return corner / (3 * block_size); }

// An element belongs to the tile of its face a.
Index tile_of_element(const State& state, Index element) {
  return state.mesh->edges[at(state.cohesive.edge[at(element)])].triangle[0] / block_size;
}

// Tiles with a part in a node: those of its triangles and those of the elements at it. May come twice.
template <class Visit>
void for_tiles_at(const State& state, Index node, const Visit& visit) {
  for (const Index corner : corners_of(state, node)) {
    visit(tile_of_corner(corner));
    for (const Index side : {corner, corner % 3 == 0 ? corner + 2 : corner - 1}) {
      const Index code = state.element_on_side[at(side)];
      if (code >= 0) visit(tile_of_element(state, code / 2));
    }
  }
}

void append(std::vector<tiles::Run>& runs, Index node, std::uint16_t local) {
  if (!runs.empty() && runs.back().node + runs.back().count == node) {
    ++runs.back().count;
  } else {
    runs.push_back({node, local, 1});
  }
}

template <class T>
tiles::Ahead::Range range_of(const T* first, std::size_t count) {
  return {reinterpret_cast<const char*>(first), reinterpret_cast<const char*>(first + count)};
}

}  // namespace

void Tiles::Reads::add(tiles::Ahead::Range r) {
  if (r.from >= r.to) return;
  ranges[count++] = r;
  lines += static_cast<std::size_t>(r.to - r.from) / 64 + 1;
}

Tiles::Reads::Reads(const State& state, const Tile& tile) {
  if (!tile.own.empty()) {
    const std::size_t first = at(tile.own.front().node);
    const std::size_t span = at(tile.own.back().node) + tile.own.back().count - first;
    if (span < 2 * at(tile.count)) {  // else they are far from one another
      add(range_of(state.displacement.data() + first, span));
      add(range_of(state.velocity.data() + first, span));
      add(range_of(state.inverse_mass.data() + first, span));
    }
  }
  add(range_of(tile.nodes.data(), tile.nodes.size()));
  add(range_of(tile.own.data(), tile.own.size()));
  add(range_of(tile.shared.data(), tile.shared.size()));
  add(range_of(tile.corners.data(), tile.corners.size()));
  add(range_of(tile.sides.data(), tile.sides.size()));
  add(range_of(tile.ends.data(), tile.ends.size()));
  add(range_of(tile.numbers.data(), tile.numbers.size()));
  add(range_of(tile.partial.data(), tile.partial.size()));
  add(range_of(tile.owned.data(), tile.owned.size()));
  add(range_of(tile.from.data(), tile.from.size()));
  add(range_of(tile.parts.data(), tile.parts.size()));
  add(range_of(tile.part.data(), tile.part.size()));
  if (!tile.viscosity.empty()) {
    add(range_of(tile.viscosity.data(), tile.viscosity.size()));
    add(range_of(state.strain_rate.data() + tile.begin / block_size, 1));
  }
}

Tiles::Tiles(const State& state, const Physics& physics)
    : tiles_(at(block_count(state.mesh->triangle_count()))),
      near_of_tile_(tiles_.size()),
      power_(tiles_.size(), 0.0) {
  tiles::for_each_tile(tiles_.size(), [&](Index i) {
    tiles_[at(i)].begin = i * block_size;
    tiles_[at(i)].end = std::min(state.mesh->triangle_count(), (i + 1) * block_size);
    sort_by_material(physics.bulk, i);
    number_nodes(state, i);
    number_corners(state, physics.bulk, i);
    list_elements(state, physics.cohesive, i);
  });
  tiles::for_each_tile(tiles_.size(), [&](Index i) { link(state, i); });
  std::vector<std::span<const std::byte>> arrays;
  for (const Tile& tile : tiles_) {
    const Reads reads(state, tile);
    for (std::size_t k = 0; k < reads.count; ++k) {
      const auto [from, to] = reads.ranges[k];
      arrays.push_back(std::as_bytes(std::span(from, to)));
    }
  }
  use_large_pages(arrays);
}

void Tiles::sort_by_material(const Bulk& bulk, Index i) {
  Tile& tile = tiles_[at(i)];
  std::vector<std::vector<Index>> of(bulk.materials().size());
  for (Index t = tile.begin; t < tile.end; ++t) of[bulk.number(t)].push_back(t - tile.begin);
  int first = 0;
  for (std::size_t m = 0; m < of.size(); ++m) {
    if (of[m].empty()) continue;
    tile.rocks.push_back({static_cast<std::uint16_t>(m), first, groups_of(of[m].size())});
    first += tile.rocks.back().groups;
  }
  if (tile.rocks.size() == 1) return;
  tile.places.resize(at(tile.end - tile.begin));
  for (const Tile::Batch& rock : tile.rocks) {
    const std::vector<Index>& triangles = of[rock.material];
    for (std::size_t k = 0; k < triangles.size(); ++k) {
      const Place p = place_of(static_cast<Index>(k), rock.groups);
      tile.places[at(triangles[k])] = {rock.first + p.group, p.lane};
    }
  }
}

void Tiles::number_nodes(const State& state, Index i) {
  Tile& tile = tiles_[at(i)];
  std::vector<Index> nodes(state.node_of_corner.begin() + 3 * tile.begin,
                           state.node_of_corner.begin() + 3 * tile.end);
  for (Index corner = 3 * tile.begin; corner < 3 * tile.end; ++corner) {
    const Index code = state.element_on_side[at(corner)];
    if (code < 0 || tile_of_element(state, code / 2) != i) continue;
    const auto& ends = state.cohesive.nodes[at(code / 2)];
    nodes.insert(nodes.end(), ends.begin(), ends.end());
  }
  sort_out(nodes);
  tile.count = static_cast<Index>(nodes.size());
  tile.nodes.clear();
  tile.own.clear();
  tile.shared.clear();
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    const auto local = static_cast<std::uint16_t>(k);
    append(tile.nodes, nodes[k], local);
    bool others = false;
    for_tiles_at(state, nodes[k], [&](Index other) { others = others || other != i; });
    if (others) {
      tile.shared.push_back(local);
    } else {
      append(tile.own, nodes[k], local);
    }
  }
  tile.partial.assign(tile.shared.size(), {});
}

void Tiles::number_corners(const State& state, const Bulk& bulk, Index i) {
  Tile& tile = tiles_[at(i)];
  const int groups = tile.groups();
  tile.corners.resize(at(3 * lanes * groups));
  // What no triangle fills: one of the nodes that stand for none.
  for (Index k = 0; k < 3 * lanes * groups; ++k) tile.corners[at(k)] = tile.dummy(k / lanes % 3);
  tile.sides.assign(at(4 * groups), {});
  for (Index g = 0; g < groups; ++g) {
    for (const Index component : {0, 3}) tile.sides[at(4 * g + component)].lane.fill(1.0);
  }
  tile.damaged.clear();
  if (bulk.viscous()) tile.viscosity.assign(at(groups), {});
  bool uniform = true;
  tile.stress = bulk.in_situ(tile.begin);
  for (Index t = tile.begin; t < tile.end; ++t) uniform = uniform && bulk.in_situ(t) == tile.stress;
  if (!uniform) tile.in_situ.assign(at(3 * groups), {});
  for (Index t = 0; t < tile.end - tile.begin; ++t) {
    const Place p = tile.place(t);
    const Index first = 3 * (tile.begin + t);
    const Index* nodes = &state.node_of_corner[at(first)];
    const Index number = state.damage.of_triangle.empty() ? -1 : state.damage.of_triangle[at(tile.begin + t)];
    if (number >= 0) {
      tile.damaged.push_back({number, {tile.name(nodes[0]), tile.name(nodes[1]), tile.name(nodes[2])}});
      continue;
    }
    for (Index k = 0; k < 3; ++k) tile.corners[at((3 * p.group + k) * lanes + p.lane)] = tile.name(nodes[k]);
    for (Index k = 1; k < 3; ++k) {
      const Vec2 side = state.reference(first + k) - state.reference(first);
      tile.sides[at(4 * p.group + 2 * k - 2)].lane[at(p.lane)] = side.x;
      tile.sides[at(4 * p.group + 2 * k - 1)].lane[at(p.lane)] = side.y;
    }
    if (!uniform) {
      const Sym2 stress = bulk.in_situ(tile.begin + t);
      tiles::Row* rows = &tile.in_situ[at(3 * p.group)];
      rows[0].lane[at(p.lane)] = stress.xx;
      rows[1].lane[at(p.lane)] = stress.yy;
      rows[2].lane[at(p.lane)] = stress.xy;
    }
    if (bulk.viscous()) tile.viscosity[at(p.group)].lane[at(p.lane)] = bulk.viscosity(tile.begin + t);
  }
}

void Tiles::set_element(const State& state, Tile& tile, int group, int lane, Index element) {
  const CohesiveElements& c = state.cohesive;
  tile.elements[at(lanes * group + lane)] = element;
  for (Index k = 0; k < 4; ++k) {
    tile.ends[at((4 * group + k) * lanes + lane)] =
        element >= 0 ? tile.name(c.nodes[at(element)][at(k)]) : tile.dummy(k % 2);
  }
  std::array<double, 7> numbers{1.0, 1.0};
  if (element >= 0) {
    const auto& offset = c.offset[at(element)];
    const Vec2 direction = c.direction[at(element)];
    numbers = {
        c.inverse_length[at(element)], direction.x, direction.y, offset[0], offset[1], offset[2], offset[3]};
  }
  for (std::size_t k = 0; k < 7; ++k) tile.numbers[at(7 * group) + k].lane[at(lane)] = numbers[k];
}

void Tiles::list_elements(const State& state, const Cohesive* cohesive, Index i) {
  Tile& tile = tiles_[at(i)];
  const CohesiveElements& c = state.cohesive;
  tile.added.clear();
  tile.batches.clear();
  near_of_tile_[at(i)].clear();
  tile.elements.clear();
  if (cohesive == nullptr) return;
  std::vector<Index> intact;
  for (Index corner = 3 * tile.begin; corner < 3 * tile.end; ++corner) {
    const Index code = state.element_on_side[at(corner)];
    if (code < 0 || code % 2 != 0) continue;  // listed from face a
    const Index element = code / 2;
    if (c.status[at(element)] == CohesiveStatus::intact) {
      intact.push_back(element);
      continue;
    }
    const auto& n = c.nodes[at(element)];
    tile.added.push_back({element, {tile.name(n[0]), tile.name(n[1]), tile.name(n[2]), tile.name(n[3])}});
  }
  std::stable_sort(intact.begin(), intact.end(),
                   [&](Index a, Index b) { return c.material[at(a)] < c.material[at(b)]; });
  int groups = 0;
  for (auto from = intact.begin(); from != intact.end();) {
    const std::uint16_t material = c.material[at(*from)];
    const auto to =
        std::find_if(from, intact.end(), [&](Index element) { return c.material[at(element)] != material; });
    tile.batches.push_back({material, groups, groups_of(at(static_cast<Index>(to - from)))});
    groups += tile.batches.back().groups;
    from = to;
  }
  tile.elements.assign(at(lanes * groups), -1);
  tile.ends.resize(at(4 * lanes * groups));
  tile.numbers.resize(at(7 * groups));
  const auto& materials = cohesive->materials();
  // Of its direction in bedded rock; those inserted on demand have their own penalty.
  const bool own = std::any_of(intact.begin(), intact.end(), [&](Index element) {
    return c.history_of[at(element)] >= 0 || bool(materials[c.material[at(element)]].bedding);
  });
  tile.limits.assign(own ? at(4 * groups) : 0, {});
  auto next = intact.begin();
  for (const Tile::Batch& batch : tile.batches) {
    for (Index j = 0; j < batch.groups * lanes; ++j) {
      const Place p = place_of(j, batch.groups);
      const bool real = next != intact.end() && c.material[at(*next)] == batch.material;
      const Index element = real ? *next++ : -1;
      set_element(state, tile, batch.first + p.group, p.lane, element);
      if (!own) continue;
      const CohesiveMaterial m = real ? cohesive->material(state, element) : materials[batch.material];
      tiles::Row* limits = &tile.limits[at(4 * (batch.first + p.group))];
      limits[0].lane[at(p.lane)] = m.tensile_strength;
      limits[1].lane[at(p.lane)] = m.cohesion;
      limits[2].lane[at(p.lane)] = m.tan_friction;
      limits[3].lane[at(p.lane)] = m.penalty;
    }
  }
}

template <class Visit>
void Tiles::for_shared(const Tile& tile, const Visit& visit) {
  auto run = tile.nodes.begin();
  for (const std::uint16_t k : tile.shared) {
    while (k >= run->local + run->count) ++run;
    visit(run->node + (k - run->local));
  }
}

void Tiles::link(const State& state, Index i) {
  Tile& tile = tiles_[at(i)];
  tile.owned.clear();
  tile.from.clear();
  tile.parts.clear();
  tile.part.clear();
  std::vector<Index> in;
  for_shared(tile, [&](Index node) {
    Index last = i;
    for_tiles_at(state, node, [&](Index other) { last = std::max(last, other); });
    if (last != i) return;
    in.clear();
    for_tiles_at(state, node, [&](Index other) { in.push_back(other); });
    sort_out(in);
    tile.owned.push_back(node);
    tile.from.push_back(in.front());
    tile.parts.push_back(static_cast<std::uint16_t>(in.size()));
    for (const Index other : in) {
      const Tile& from = tiles_[at(other)];
      const auto it = std::lower_bound(from.shared.begin(), from.shared.end(), from.local(node));
      tile.part.push_back(&from.partial[at(static_cast<Index>(it - from.shared.begin()))]);
    }
  });
}

void Tiles::triangles_changed(const State& state, const Physics& physics, std::span<const Index> triangles) {
  std::vector<Index> changed;
  for (const Index t : triangles) changed.push_back(t / block_size);
  sort_out(changed);
  for (const Index i : changed) number_corners(state, physics.bulk, i);
}

void Tiles::elements_changed(const State& state, const Physics& physics, std::span<const Index> elements) {
  std::vector<Index> changed;
  for (const Index element : elements) changed.push_back(tile_of_element(state, element));
  sort_out(changed);
  for (const Index i : changed) list_elements(state, physics.cohesive, i);
}

void Tiles::inserted(const State& state, const Physics& physics, std::span<const Index> edges) {
  std::vector<Index> changed;
  for (const Index e : edges) {
    for (const Index vertex : state.mesh->edges[at(e)].vertex) {
      for (const Index corner : corners_at(state, vertex)) changed.push_back(tile_of_corner(corner));
    }
  }
  sort_out(changed);
  // Tiles that own a node with a part in one of these, before or after, are linked anew.
  std::vector<char> linked(tiles_.size(), 0);
  const auto note_sharers = [&](Index i) {
    const Tile& tile = tiles_[at(i)];
    for_shared(tile,
               [&](Index node) { for_tiles_at(state, node, [&](Index other) { linked[at(other)] = 1; }); });
    linked[at(i)] = 1;
  };
  for (const Index i : changed) {
    note_sharers(i);
    number_nodes(state, i);
    number_corners(state, physics.bulk, i);
    list_elements(state, physics.cohesive, i);
    note_sharers(i);
  }
  for (std::size_t i = 0; i < linked.size(); ++i) {
    if (linked[i]) link(state, static_cast<Index>(i));
  }
}

}  // namespace crackle
