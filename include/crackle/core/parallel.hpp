// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "crackle/core/vec2.hpp"

// Hot loops are compiled for several x86 levels and picked at start, so that one binary runs
// everywhere and fast; without contraction (see CrackleRoom.cmake) all give the same bits.
// Sanitizers do not get along with the resolver that this needs.
#if defined(__x86_64__) && !defined(CRACKLE_SANITIZED)
#define CRACKLE_KERNEL __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define CRACKLE_KERNEL
#endif

namespace crackle {

/// Items a block of a parallel loop holds. Fixed, so that sums over blocks have the same order,
/// and results the same bits, for any number of threads.
inline constexpr Index block_size = 256;

inline Index block_count(Index items) { return (items + block_size - 1) / block_size; }

/// Calls work(begin, end, block) for every block of [0, items), in parallel. Blocks must not write
/// to the same place.
template <class Work>
void for_each_block(Index items, const Work& work) {
  const Index blocks = block_count(items);
#pragma omp parallel for schedule(static) if (blocks > 1)
  for (Index b = 0; b < blocks; ++b) work(b * block_size, std::min(items, (b + 1) * block_size), b);
}

/// Sum over all blocks of work(begin, end), in block order whatever the number of threads.
template <class Work>
double sum_over_blocks(Index items, const Work& work) {
  std::vector<double> partial(static_cast<std::size_t>(block_count(items)));
  for_each_block(items, [&](Index begin, Index end, Index b) {
    partial[static_cast<std::size_t>(b)] = work(begin, end);
  });
  double sum = 0.0;
  for (const double p : partial) sum += p;
  return sum;
}

}  // namespace crackle
