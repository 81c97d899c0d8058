// SPDX-License-Identifier: GPL-3.0-or-later
#include "crackle/solve/tiles.hpp"

#include <omp.h>

#include <cstring>

#include "tile.hpp"

namespace crackle {
namespace {

using tiles::lanes;
using tiles::Place;

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

double* numbers(std::vector<Vec2>& v) { return &v.front().x; }

// Whether any of the marks of some groups is set.
bool any_of_groups(const std::uint8_t* marks, int groups) {
  std::uint64_t any = 0;
  for (int g = 0; g < groups; ++g) {
    std::uint64_t of_group = 0;
    std::memcpy(&of_group, marks + lanes * g, lanes);
    any |= of_group;
  }
  return any != 0;
}

}  // namespace

// The small arrays that a tile works in. Every element may have two nodes of another tile.
struct Tiles::Scratch {
  static constexpr std::size_t most = 9 * block_size + tiles::dummies;
  alignas(64) std::array<double, 4 * most> motion;  // or displacement alone
  alignas(64) std::array<double, 2 * most> force;
  // A tile of many rocks may have a triangle a group.
  alignas(64) std::array<double, 3 * lanes * block_size> strain_rate;
  alignas(64) std::array<double, lanes> power;
  alignas(64) std::array<std::uint8_t, lanes * block_size> stressed;
  alignas(64) std::array<std::uint8_t, 4 * block_size> near;
};

// What move_shared() reads besides the tile: it lies with other tiles.
void Tiles::fetch_owned(const State& state, const Tile& tile) {
  for (const Index n : tile.owned) {
    __builtin_prefetch(&state.velocity[at(n)], 1);
    __builtin_prefetch(&state.inverse_mass[at(n)]);
  }
  for (const Vec2* part : tile.part) __builtin_prefetch(part);
}

// What a tile copies of nodes and elements that lie with others: its own nodes are among its Reads.
void Tiles::fetch_nodes(const State& state, const Tile& tile) {
  const Index first = tile.own.empty() ? 0 : tile.own.front().node;
  const Index last = tile.own.empty() ? 0 : tile.own.back().node;
  for (const tiles::Run& run : tile.nodes) {
    if (run.node >= first && run.node <= last) continue;
    __builtin_prefetch(&state.displacement[at(run.node)]);
    __builtin_prefetch(&state.displacement[at(run.node + run.count - 1)]);
  }
  for (const Tile::Added& a : tile.added) __builtin_prefetch(&state.cohesive.force[at(a.element)]);
}

Tiles::Tiles(Tiles&&) noexcept = default;
Tiles::~Tiles() = default;

const std::vector<double>& Tiles::move(State& state, const Physics& physics, double dt,
                                       const StressScreen& screen, std::span<std::uint8_t> stressed,
                                       std::span<char> tile_stressed) {
  // A node moves as soon as the last tile with a part in it is done, while its parts are in the cache yet;
  // where another thread has one, when all are.
  const auto count = static_cast<Index>(tiles_.size());
#pragma omp parallel if (count > 1)
  {
    const Index threads = omp_get_num_threads(), thread = omp_get_thread_num();
    const auto first_of = [&](Index t) { return static_cast<Index>(std::int64_t{count} * t / threads); };
    const Index begin = first_of(thread), end = first_of(thread + 1);
    for (Index i = begin; i < end; ++i) {
      work(state, physics, i, dt, screen, stressed, tile_stressed);
      move_shared(state, tiles_[at(i)], dt, begin, count);
    }
#pragma omp barrier
    for (Index i = begin; i < end && begin > 0; ++i) move_shared(state, tiles_[at(i)], dt, 0, begin);
  }
  near_.clear();
  for (const auto& found : near_of_tile_) near_.insert(near_.end(), found.begin(), found.end());
  std::sort(near_.begin(), near_.end());
  return power_;
}

void Tiles::work(State& state, const Physics& physics, Index i, double dt, const StressScreen& screen,
                 std::span<std::uint8_t> stressed, std::span<char> tile_stressed) {
  Tile& tile = tiles_[at(i)];
  const Bulk& bulk = physics.bulk;
  fetch_owned(state, tile);
  Scratch s;  // not initialised
  const tiles::Kernels& kernels = tiles::kernels();
  const tiles::Run *const nodes = tile.nodes.data(), *const nodes_end = nodes + tile.nodes.size();
  const bool viscous = bulk.viscous();
  const std::ptrdiff_t count = tile.count, numbers_of_node = viscous ? 4 : 2;
  if (viscous) {
    kernels.copy_motion(
        {nodes, nodes_end, numbers(state.displacement), numbers(state.velocity), s.motion.data()});
  } else {
    kernels.copy({nodes, nodes_end, numbers(state.displacement), s.motion.data()});
  }
  std::fill_n(s.motion.begin() + numbers_of_node * count, numbers_of_node * tiles::dummies, 0.0);
  std::fill_n(s.force.begin(), 2 * (count + tiles::dummies), 0.0);
  const double* const displacement = viscous ? nullptr : s.motion.data();
  const double* const motion = viscous ? s.motion.data() : nullptr;

  const int groups = tile.groups();
  tiles::RockWork rock{.groups = groups,
                       .corners = tile.corners.data(),
                       .sides = tile.sides.front().lane.data(),
                       .displacement = displacement,
                       .force = s.force.data(),
                       .stiffness = {},
                       .in_situ = tile.stress,
                       .in_situ_rows = tile.in_situ.empty() ? nullptr : tile.in_situ.front().lane.data(),
                       .weight = 0.0,
                       .motion = motion,
                       .viscosity = nullptr,
                       .strain_rate = nullptr,
                       .power = nullptr,
                       .screen = screen,
                       .stressed = stressed.empty() ? nullptr : s.stressed.data(),
                       .ahead = {}};
  // Half of what the next tile reads is fetched with the triangles, half with the elements.
  const Reads reads(state, tiles_[std::min(at(i) + 1, tiles_.size() - 1)]);
  const int element_groups = tile.element_groups();
  const tiles::Ahead::Range* const ranges = reads.ranges.data();
  const std::size_t half = element_groups > 0 ? reads.count / 2 : reads.count;
  const int lines = static_cast<int>(reads.lines) / (groups + element_groups) + 1;
  rock.ahead = {ranges, ranges + half, lines};
  if (viscous) {
    StrainRates& rates = state.strain_rate[at(i)];
    rock.strain_rate = tile.regular() ? rates.number.data() : s.strain_rate.data();
    if (!tile.regular()) {
      std::fill_n(s.strain_rate.begin(), 3 * lanes * groups, 0.0);
      tile.for_each_triangle([&](Index t, Place p) {
        double* rate = s.strain_rate.data() + 3 * lanes * p.group + p.lane;
        const Sym2 last = rates.of(t);
        rate[0] = last.xx;
        rate[lanes] = last.yy;
        rate[2 * lanes] = last.xy;
      });
    }
    s.power.fill(0.0);
    rock.viscosity = tile.viscosity.front().lane.data();
    rock.power = s.power.data();
  }
  for (const Tile::Batch& batch : tile.rocks) {
    tiles::RockWork part = rock;
    part.groups = batch.groups;
    part.stiffness = bulk.materials()[batch.material].stiffness;
    part.weight = bulk.materials()[batch.material].in_situ.gradient.yy;
    part.corners += 3 * lanes * batch.first;
    part.sides += 4 * lanes * batch.first;
    if (part.in_situ_rows != nullptr) part.in_situ_rows += 3 * lanes * batch.first;
    if (viscous) {
      part.viscosity += lanes * batch.first;
      part.strain_rate += 3 * lanes * batch.first;
    }
    if (part.stressed != nullptr) part.stressed += lanes * batch.first;
    if (batch.first > 0) part.ahead = {};
    kernels.rock(part);
  }
  if (viscous) {
    double power = 0.0;
    for (const double p : s.power) power += p;
    power_[at(i)] = power;
    if (!tile.regular()) {
      tile.for_each_triangle([&](Index t, Place p) {
        const double* rate = s.strain_rate.data() + 3 * lanes * p.group + p.lane;
        state.strain_rate[at(i)].set(t, {rate[0], rate[lanes], rate[2 * lanes]});
      });
    }
  }
  // As a rule nothing is stressed, nor was.
  if (!stressed.empty() && (tile_stressed[at(i)] != 0 || any_of_groups(s.stressed.data(), groups))) {
    char any = 0;
    tile.for_each_triangle([&](Index t, Place p) {
      const std::uint8_t mark = s.stressed[at(lanes * p.group + p.lane)] & 1;
      stressed[at(tile.begin + t)] = mark;
      any |= static_cast<char>(mark);
    });
    tile_stressed[at(i)] = any;
  }

  std::vector<Index>& near = near_of_tile_[at(i)];
  near.clear();
  for (const Tile::Batch& batch : tile.batches) {
    const CohesiveMaterial& m = physics.cohesive->materials()[batch.material];
    const tiles::Ahead rest{ranges + half, ranges + reads.count, lines};
    kernels.elements(
        {batch.groups,
         tile.ends.data() + 4 * lanes * batch.first,
         tile.numbers.front().lane.data() + 7 * lanes * batch.first,
         displacement,
         motion,
         s.force.data(),
         {m.penalty, m.tensile_strength, m.cohesion, m.tan_friction, physics.cohesive->law().curvature()},
         tile.limits.empty() ? nullptr : tile.limits.front().lane.data() + 4 * lanes * batch.first,
         s.near.data() + lanes * batch.first,
         batch.first == 0 ? rest : tiles::Ahead{}});
  }
  for (int g = 0; g < element_groups; ++g) {
    if (!any_of_groups(s.near.data() + lanes * g, 1)) continue;
    for (int j = lanes * g; j < lanes * (g + 1); ++j) {
      if (s.near[at(j)] != 0 && tile.elements[at(j)] >= 0) near.push_back(tile.elements[at(j)]);
    }
  }
  const auto add = [&](std::uint16_t n, Vec2 f) {
    s.force[n / 2u] += f.x;
    s.force[n / 2u + 1u] += f.y;
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

  fetch_nodes(state, tiles_[std::min(at(i) + 1, tiles_.size() - 1)]);
  for (std::size_t k = 0; k < tile.shared.size(); ++k) {
    const double* force = s.force.data() + 2 * tile.shared[k];
    tile.partial[k] = {force[0], force[1]};
  }
  kernels.move({tile.own.data(), tile.own.data() + tile.own.size(), dt, s.force.data(),
                state.inverse_mass.data(), numbers(state.velocity), numbers(state.displacement)});
}

void Tiles::move_shared(State& state, const Tile& tile, double dt, Index begin, Index end) {
  const Vec2* const* part = tile.part.data();
  for (std::size_t k = 0; k < tile.owned.size(); ++k) {
    if (tile.from[k] < begin || tile.from[k] >= end) {
      part += tile.parts[k];
      continue;
    }
    Vec2 force;
    for (std::uint16_t j = 0; j < tile.parts[k]; ++j) force += **part++;
    const std::size_t n = at(tile.owned[k]);
    state.velocity[n] += (dt * state.inverse_mass[n]) * force;
    state.displacement[n] += dt * state.velocity[n];
  }
}

}  // namespace crackle
