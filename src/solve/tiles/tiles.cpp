// SPDX-License-Identifier: GPL-3.0-or-later
#include "crackle/solve/tiles.hpp"

#include <algorithm>
#include <array>

#include "crackle/core/large_pages.hpp"
#include "crackle/core/parallel.hpp"
#include "kernel.hpp"

namespace crackle {
namespace {

using tiles::lanes;

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

struct alignas(64) Row {
  std::array<double, lanes> lane{};
};

// Triangles (or elements) of one lane follow one another, so that the eight of a group share no node as a
// rule and their sums do not wait for one another.
struct Place {
  int group, lane;
};
Place place_of(Index i, int groups) { return {i % groups, i / groups}; }
int groups_of(std::size_t items) { return static_cast<int>((items + lanes - 1) / lanes); }

// Nodes that stand for none: corners of the triangle that fills up a group.
constexpr Index dummies = 3;
constexpr std::array<Vec2, dummies> dummy_place{{{0.0, 0.0}, {1.0, 0.0}, {0.0, 1.0}}};

void sort_out(std::vector<Index>& items) {
  std::sort(items.begin(), items.end());
  items.erase(std::unique(items.begin(), items.end()), items.end());
}

std::span<const Index> corners_of(const State& state, Index node) {
  return std::span(state.node_corners).subspan(at(state.node_first[at(node)]), at(state.node_size[at(node)]));
}

template <class Work>
void for_each_tile(std::size_t count, const Work& work) {
  for_each_block(static_cast<Index>(count) * block_size, [&](Index, Index, Index tile) { work(tile); });
}

}  // namespace

struct Tiles::Tile {
  struct Added {  // an element whose force is only added
    Index element;
    std::array<std::uint16_t, 4> ends;
  };

  Index begin = 0, end = 0;            // triangles
  std::vector<Index> nodes;            // those shared with other tiles first, both parts ascending
  Index shared = 0;                    // so many
  bool in_a_row = false;               // nodes follow one another and none is shared
  std::vector<std::uint16_t> vertex;   // of nodes and dummies: number in place
  std::vector<Vec2> place;             // reference positions of the tile's vertices, then of the dummies
  std::vector<std::uint16_t> corners;  // [group][corner][lane]
  struct Damaged {
    Index number;  // into state.damage.triangles
    std::array<std::uint16_t, 3> corners;
  };
  std::vector<Damaged> damaged;     // fill up their groups like triangles that are not there
  std::vector<Row> in_situ;         // [group][component]; empty: the same in all triangles
  std::vector<Row> viscosity;       // [group]
  std::vector<Index> elements;      // evaluated here, ascending
  std::vector<std::uint16_t> ends;  // [group][end][lane]
  std::vector<Row> numbers;         // [group][5]
  std::uint16_t material = 0;       // of all of them
  std::vector<Added> added;
  std::vector<Vec2> partial;  // forces on shared nodes
  // Shared nodes of which this is the first tile: their parts in all tiles.
  std::vector<Index> owned;
  std::vector<std::uint16_t> parts;  // of each
  std::vector<const Vec2*> part;

  Index count() const { return static_cast<Index>(nodes.size()); }
  int groups() const { return groups_of(at(end - begin)); }
  // Twice the number of a node in the tile.
  std::uint16_t name(Index node) const { return static_cast<std::uint16_t>(2 * local(node)); }
  std::uint16_t dummy(Index k) const {
    return static_cast<std::uint16_t>(2 * (static_cast<Index>(nodes.size()) + k));
  }
  Index local(Index node) const {
    const auto middle = nodes.begin() + shared;
    auto it = std::lower_bound(nodes.begin(), middle, node);
    if (it == middle || *it != node) it = std::lower_bound(middle, nodes.end(), node);
    return static_cast<Index>(it - nodes.begin());
  }
};

// The small arrays that a tile works in.
struct Tiles::Scratch {
  static constexpr std::size_t most = 3 * block_size + dummies;
  alignas(64) std::array<double, 4 * most> nodes;
  alignas(64) std::array<double, 2 * most> force, velocity;
  alignas(64) std::array<double, 3 * block_size> strain_rate;
  alignas(64) std::array<double, lanes> power;
  alignas(64) std::array<std::uint8_t, block_size> stressed;
  alignas(64) std::array<std::uint8_t, 2 * block_size> near;

  template <class Node>
  void load(const State& state, const Tile& tile, const Node& node) {
    const std::size_t count = tile.nodes.size();
    for (std::size_t k = 0; k < count + dummies; ++k) {
      const Vec2 u = k < count ? state.displacement[node(k)] : Vec2{}, x = tile.place[tile.vertex[k]];
      nodes[4 * k] = u.x;
      nodes[4 * k + 1] = u.y;
      nodes[4 * k + 2] = x.x;
      nodes[4 * k + 3] = x.y;
    }
  }
  // v += Δt f/m, x += Δt v of the nodes that are the tile's own
  template <class Node>
  void move(State& state, const Tile& tile, double dt, const Node& node) const {
    for (std::size_t k = at(tile.shared); k < tile.nodes.size(); ++k) {
      const std::size_t n = node(k);
      const double w = dt * state.inverse_mass[n];
      Vec2 v = state.velocity[n];
      v.x += w * force[2 * k];
      v.y += w * force[2 * k + 1];
      state.velocity[n] = v;
      state.displacement[n] = {nodes[4 * k] + dt * v.x, nodes[4 * k + 1] + dt * v.y};
    }
  }
};

namespace {

template <class T>
tiles::Ahead::Range range_of(const T* first, std::size_t count) {
  const char* from = reinterpret_cast<const char*>(first);
  return {from, from + count * sizeof(T)};
}

}  // namespace

// What a tile reads, for Ahead.
struct Tiles::Reads {
  std::array<tiles::Ahead::Range, 9> ranges;
  std::size_t count = 0;
  std::size_t lines = 0;

  void add(tiles::Ahead::Range r) {
    if (r.from >= r.to) return;
    ranges[count++] = r;
    lines += static_cast<std::size_t>(r.to - r.from) / 64 + 1;
  }
  Reads(const State& state, const Tile& tile) {
    const std::size_t first = at(tile.nodes[at(std::min(tile.shared, tile.count() - 1))]);
    const std::size_t own = at(tile.nodes.back()) - std::min(first, at(tile.nodes.back())) + 1;
    if (own < 2 * tile.nodes.size()) {  // else they are far from one another
      add(range_of(state.displacement.data() + first, own));
      add(range_of(state.velocity.data() + first, own));
      add(range_of(state.inverse_mass.data() + first, own));
    }
    if (!tile.in_a_row) add(range_of(tile.nodes.data(), tile.nodes.size()));
    add(range_of(tile.vertex.data(), tile.vertex.size()));
    add(range_of(tile.place.data(), tile.place.size()));
    add(range_of(tile.corners.data(), tile.corners.size()));
    add(range_of(tile.ends.data(), tile.ends.size()));
    add(range_of(tile.numbers.data(), tile.numbers.size()));
  }
};

Tiles::Tiles(Tiles&&) noexcept = default;
Tiles::~Tiles() = default;

Tiles::Tiles(const State& state, const Physics& physics)
    : tiles_(at(block_count(state.mesh->triangle_count()))),
      apart_(tiles_.size()),
      near_of_tile_(tiles_.size()),
      power_(tiles_.size(), 0.0) {
  for_each_tile(tiles_.size(), [&](Index i) {
    tiles_[at(i)].begin = i * block_size;
    tiles_[at(i)].end = std::min(state.mesh->triangle_count(), (i + 1) * block_size);
    number_nodes(state, i);
    number_corners(state, physics.bulk, i);
    list_elements(state, physics.cohesive, i);
  });
  for_each_tile(tiles_.size(), [&](Index i) { link(state, i); });
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

void Tiles::number_nodes(const State& state, Index i) {
  Tile& tile = tiles_[at(i)];
  tile.nodes.assign(state.node_of_corner.begin() + 3 * tile.begin,
                    state.node_of_corner.begin() + 3 * tile.end);
  sort_out(tile.nodes);
  const auto middle = std::stable_partition(tile.nodes.begin(), tile.nodes.end(), [&](Index node) {
    return std::ranges::any_of(corners_of(state, node),
                               [&](Index corner) { return corner / (3 * block_size) != i; });
  });
  tile.shared = static_cast<Index>(middle - tile.nodes.begin());
  tile.nodes.shrink_to_fit();
  tile.partial.assign(at(tile.shared), {});
  tile.in_a_row = tile.shared == 0 && tile.nodes.back() - tile.nodes.front() + 1 == tile.count();
  const auto vertex_of = [&](Index node) {
    const Index corner = corners_of(state, node).front();
    return state.mesh->triangles[at(corner / 3)][at(corner % 3)];
  };
  std::vector<Index> vertices;
  for (const Index node : tile.nodes) vertices.push_back(vertex_of(node));
  sort_out(vertices);
  tile.vertex.clear();
  tile.vertex.reserve(tile.nodes.size() + dummies);
  for (const Index node : tile.nodes) {
    const auto it = std::lower_bound(vertices.begin(), vertices.end(), vertex_of(node));
    tile.vertex.push_back(static_cast<std::uint16_t>(it - vertices.begin()));
  }
  tile.place.clear();
  tile.place.reserve(vertices.size() + dummies);
  for (const Index v : vertices) tile.place.push_back(state.mesh->vertices[at(v)]);
  for (const Vec2 x : dummy_place) {
    tile.vertex.push_back(static_cast<std::uint16_t>(tile.place.size()));
    tile.place.push_back(x);
  }
}

void Tiles::number_corners(const State& state, const Bulk& bulk, Index i) {
  Tile& tile = tiles_[at(i)];
  const int groups = tile.groups();
  tile.corners.resize(at(3 * lanes * groups));
  tile.damaged.clear();
  if (bulk.viscous()) tile.viscosity.assign(at(groups), {});
  bool uniform = true;
  for (Index t = tile.begin; t < tile.end; ++t)
    uniform = uniform && bulk.in_situ(t) == bulk.in_situ(tile.begin);
  if (!uniform) tile.in_situ.assign(at(3 * groups), {});
  for (Index t = 0; t < groups * lanes; ++t) {
    const Place p = place_of(t, groups);
    bool real = t < tile.end - tile.begin;
    const Index number =
        real && !state.damage.of_triangle.empty() ? state.damage.of_triangle[at(tile.begin + t)] : -1;
    if (number >= 0) {
      const Index* nodes = &state.node_of_corner[at(3 * (tile.begin + t))];
      tile.damaged.push_back({number, {tile.name(nodes[0]), tile.name(nodes[1]), tile.name(nodes[2])}});
      real = false;
    }
    for (Index k = 0; k < 3; ++k) {
      tile.corners[at((3 * p.group + k) * lanes + p.lane)] =
          real ? tile.name(state.node_of_corner[at(3 * (tile.begin + t) + k)]) : tile.dummy(k);
    }
    if (real && !uniform) {
      const Sym2 stress = bulk.in_situ(tile.begin + t);
      Row* rows = &tile.in_situ[at(3 * p.group)];
      rows[0].lane[at(p.lane)] = stress.xx;
      rows[1].lane[at(p.lane)] = stress.yy;
      rows[2].lane[at(p.lane)] = stress.xy;
    }
    if (real && bulk.viscous()) tile.viscosity[at(p.group)].lane[at(p.lane)] = bulk.viscosity(tile.begin + t);
  }
}

void Tiles::list_elements(const State& state, const Cohesive* cohesive, Index i) {
  Tile& tile = tiles_[at(i)];
  const CohesiveElements& c = state.cohesive;
  tile.elements.clear();
  tile.added.clear();
  apart_[at(i)].clear();
  near_of_tile_[at(i)].clear();
  if (cohesive == nullptr) return;
  std::vector<Index> all;
  for (Index corner = 3 * tile.begin; corner < 3 * tile.end; ++corner) {
    if (state.element_on_side[at(corner)] >= 0) all.push_back(state.element_on_side[at(corner)] / 2);
  }
  if (all.empty()) return;
  sort_out(all);
  const std::uint16_t material = c.material[at(all.front())];
  tile.material = material;
  const bool bedded = bool(cohesive->materials()[material].bedding);  // each element has its own strength
  for (const Index element : all) {
    const Edge& edge = state.mesh->edges[at(c.edge[at(element)])];
    std::array<bool, 2> here{};
    for (std::size_t face = 0; face < 2; ++face) {
      here[face] = edge.triangle[face] >= tile.begin && edge.triangle[face] < tile.end;
    }
    const bool intact = c.history_of[at(element)] < 0;
    if (intact && !bedded && here[0] && here[1] && c.material[at(element)] == material) {
      tile.elements.push_back(element);
      continue;
    }
    if (intact && here[0]) apart_[at(i)].push_back(element);
    Tile::Added added{element, {}};
    for (std::size_t k = 0; k < 4; ++k) {
      added.ends[k] = here[k / 2] ? tile.name(c.nodes[at(element)][k]) : tile.dummy(0);
    }
    tile.added.push_back(added);
  }
  const int groups = groups_of(tile.elements.size());
  tile.ends.resize(at(4 * lanes * groups));
  tile.numbers.assign(at(5 * groups), {});
  for (Index j = 0; j < groups * lanes; ++j) {
    const Place p = place_of(j, groups);
    const bool real = at(j) < tile.elements.size();
    const Index element = real ? tile.elements[at(j)] : -1;
    for (Index k = 0; k < 4; ++k) {
      tile.ends[at((4 * p.group + k) * lanes + p.lane)] =
          real ? tile.name(c.nodes[at(element)][at(k)]) : tile.dummy(k % 2);
    }
    const auto number = [&](Index k) -> double& {
      return tile.numbers[at(5 * p.group + k)].lane[at(p.lane)];
    };
    number(0) = real ? c.inverse_length[at(element)] : 1.0;
    for (Index k = 0; k < 4 && real; ++k) number(1 + k) = c.offset[at(element)][at(k)];
  }
}

void Tiles::link(const State& state, Index i) {
  Tile& tile = tiles_[at(i)];
  tile.owned.clear();
  tile.parts.clear();
  tile.part.clear();
  for (Index k = 0; k < tile.shared; ++k) {
    const Index node = tile.nodes[at(k)];
    std::vector<Index> in;
    for (const Index corner : corners_of(state, node)) in.push_back(corner / (3 * block_size));
    sort_out(in);
    if (in.front() != i) continue;
    tile.owned.push_back(node);
    tile.parts.push_back(static_cast<std::uint16_t>(in.size()));
    for (const Index other : in) {
      const Tile& from = tiles_[at(other)];
      tile.part.push_back(&from.partial[at(from.local(node))]);
    }
  }
}

void Tiles::triangles_changed(const State& state, const Physics& physics, std::span<const Index> triangles) {
  std::vector<Index> changed;
  for (const Index t : triangles) changed.push_back(t / block_size);
  sort_out(changed);
  for (const Index i : changed) number_corners(state, physics.bulk, i);
}

void Tiles::elements_changed(const State& state, const Physics& physics, std::span<const Index> elements) {
  std::vector<Index> changed;
  for (const Index element : elements) {
    for (const Index t : state.mesh->edges[at(state.cohesive.edge[at(element)])].triangle)
      changed.push_back(t / block_size);
  }
  sort_out(changed);
  for (const Index i : changed) list_elements(state, physics.cohesive, i);
}

void Tiles::inserted(const State& state, const Physics& physics, std::span<const Index> edges) {
  std::vector<Index> changed;
  for (const Index e : edges) {
    for (const Index vertex : state.mesh->edges[at(e)].vertex) {
      for (const Index corner : corners_at(state, vertex)) changed.push_back(corner / (3 * block_size));
    }
  }
  sort_out(changed);
  // Tiles that own a node with a part in one of these, before or after, are linked anew.
  std::vector<Index> linked;
  const auto note_sharers = [&](Index i) {
    const Tile& tile = tiles_[at(i)];
    for (Index k = 0; k < tile.shared; ++k) {
      for (const Index corner : corners_of(state, tile.nodes[at(k)]))
        linked.push_back(corner / (3 * block_size));
    }
    linked.push_back(i);
  };
  for (const Index i : changed) {
    note_sharers(i);
    number_nodes(state, i);
    number_corners(state, physics.bulk, i);
    list_elements(state, physics.cohesive, i);
    note_sharers(i);
  }
  sort_out(linked);
  for (const Index i : linked) link(state, i);
}

const std::vector<double>& Tiles::move(State& state, const Physics& physics, double dt,
                                       const StressScreen& screen, std::span<std::uint8_t> stressed,
                                       std::span<char> tile_stressed) {
  for_each_tile(tiles_.size(),
                [&](Index i) { work(state, physics, i, dt, screen, stressed, tile_stressed); });
  for_each_tile(tiles_.size(), [&](Index i) { move_shared(state, tiles_[at(i)], dt); });
  near_.clear();
  for (const auto& found : near_of_tile_) near_.insert(near_.end(), found.begin(), found.end());
  std::sort(near_.begin(), near_.end());
  return power_;
}

void Tiles::work(State& state, const Physics& physics, Index i, double dt, const StressScreen& screen,
                 std::span<std::uint8_t> stressed, std::span<char> tile_stressed) {
  Tile& tile = tiles_[at(i)];
  const Bulk& bulk = physics.bulk;
  Scratch s;  // not initialised
  const std::size_t count = tile.nodes.size();
  tile.in_a_row ? s.load(state, tile, [first = tile.nodes.front()](std::size_t k) { return at(first) + k; })
                : s.load(state, tile, [&](std::size_t k) { return at(tile.nodes[k]); });
  std::fill_n(s.force.begin(), 2 * (count + dummies), 0.0);

  const int groups = tile.groups();
  tiles::RockWork rock{.groups = groups,
                       .corners = tile.corners.data(),
                       .nodes = s.nodes.data(),
                       .force = s.force.data(),
                       .stiffness = bulk.stiffness(),
                       .in_situ = bulk.in_situ(tile.begin),
                       .in_situ_rows = tile.in_situ.empty() ? nullptr : tile.in_situ.front().lane.data(),
                       .weight = bulk.weight(),
                       .velocity = nullptr,
                       .viscosity = nullptr,
                       .strain_rate = nullptr,
                       .power = nullptr,
                       .screen = screen,
                       .stressed = stressed.empty() ? nullptr : s.stressed.data(),
                       .ahead = {}};
  // Half of what the next tile reads is fetched with the triangles, half with the elements.
  const Reads reads(state, tiles_[std::min(at(i) + 1, tiles_.size() - 1)]);
  const int element_groups = groups_of(tile.elements.size());
  const tiles::Ahead::Range* const ranges = reads.ranges.data();
  const std::size_t half = element_groups > 0 ? reads.count / 2 : reads.count;
  const int lines = static_cast<int>(reads.lines) / (groups + element_groups) + 1;
  rock.ahead = {ranges, ranges + half, lines};
  if (bulk.viscous()) {
    for (std::size_t k = 0; k < count; ++k) {
      const Vec2 v = state.velocity[at(tile.nodes[k])];
      s.velocity[2 * k] = v.x;
      s.velocity[2 * k + 1] = v.y;
    }
    std::fill_n(s.velocity.begin() + static_cast<std::ptrdiff_t>(2 * count), 2 * dummies, 0.0);
    for (Index t = 0; t < groups * lanes; ++t) {
      const Place p = place_of(t, groups);
      double* rate = s.strain_rate.data() + 3 * lanes * p.group + p.lane;
      const Sym2 last = t < tile.end - tile.begin ? state.strain_rate[at(tile.begin + t)] : Sym2{};
      rate[0] = last.xx;
      rate[lanes] = last.yy;
      rate[2 * lanes] = last.xy;
    }
    s.power.fill(0.0);
    rock.velocity = s.velocity.data();
    rock.viscosity = tile.viscosity.front().lane.data();
    rock.strain_rate = s.strain_rate.data();
    rock.power = s.power.data();
  }
  const tiles::Kernels& kernels = tiles::kernels();
  kernels.rock(rock);
  if (bulk.viscous()) {
    double power = 0.0;
    for (const double p : s.power) power += p;
    power_[at(i)] = power;
    for (Index t = 0; t < tile.end - tile.begin; ++t) {
      const Place p = place_of(t, groups);
      const double* rate = s.strain_rate.data() + 3 * lanes * p.group + p.lane;
      state.strain_rate[at(tile.begin + t)] = {rate[0], rate[lanes], rate[2 * lanes]};
    }
  }
  if (!stressed.empty()) {
    char any = 0;
    for (Index t = 0; t < tile.end - tile.begin; ++t) {
      const Place p = place_of(t, groups);
      const std::uint8_t mark = s.stressed[at(lanes * p.group + p.lane)] & 1;
      stressed[at(tile.begin + t)] = mark;
      any |= static_cast<char>(mark);
    }
    tile_stressed[at(i)] = any;
  }

  std::vector<Index>& near = near_of_tile_[at(i)];
  near.clear();
  if (!tile.elements.empty()) {
    const CohesiveMaterial& m = physics.cohesive->materials()[tile.material];
    kernels.elements(
        {element_groups,
         tile.ends.data(),
         tile.numbers.front().lane.data(),
         s.nodes.data(),
         s.force.data(),
         {m.penalty, m.tensile_strength, m.cohesion, m.tan_friction, physics.cohesive->law().curvature()},
         s.near.data(),
         {ranges + half, ranges + reads.count, lines}});
    if (std::any_of(s.near.begin(), s.near.begin() + lanes * element_groups,
                    [](auto mark) { return mark != 0; })) {
      for (Index j = 0; j < static_cast<Index>(tile.elements.size()); ++j) {
        const Place p = place_of(j, element_groups);
        if (s.near[at(lanes * p.group + p.lane)] != 0) near.push_back(tile.elements[at(j)]);
      }
    }
  }
  const auto add = [&](std::uint16_t n, Vec2 f) {
    s.force[n] += f.x;
    s.force[n + 1u] += f.y;
  };
  for (const Tile::Damaged& d : tile.damaged) {
    const DamagedTriangle& triangle = state.damage.triangles[at(d.number)];
    const Vec2 weight{0.0, bulk.corner_weight(triangle.triangle)};
    for (std::size_t k = 0; k < 3; ++k) add(d.corners[k], triangle.force[k] + weight);
  }
  for (const Tile::Added& a : tile.added) {
    const EndForces& f = state.cohesive.force[at(a.element)];
    add(a.ends[0], f.end0);
    add(a.ends[1], f.end1);
    add(a.ends[2], -f.end0);
    add(a.ends[3], -f.end1);
  }

  for (std::size_t k = 0; k < at(tile.shared); ++k) tile.partial[k] = {s.force[2 * k], s.force[2 * k + 1]};
  tile.in_a_row
      ? s.move(state, tile, dt, [first = tile.nodes.front()](std::size_t k) { return at(first) + k; })
      : s.move(state, tile, dt, [&](std::size_t k) { return at(tile.nodes[k]); });
}

void Tiles::move_shared(State& state, const Tile& tile, double dt) const {
  const Vec2* const* part = tile.part.data();
  for (std::size_t k = 0; k < tile.owned.size(); ++k) {
    Vec2 force;
    for (std::uint16_t j = 0; j < tile.parts[k]; ++j) force += **part++;
    const std::size_t n = at(tile.owned[k]);
    state.velocity[n] += (dt * state.inverse_mass[n]) * force;
    state.displacement[n] += dt * state.velocity[n];
  }
}

}  // namespace crackle
