// SPDX-License-Identifier: GPL-3.0-or-later
#include "crackle/core/large_pages.hpp"

#include <algorithm>
#include <cstdint>
#include <map>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace crackle {

void use_large_pages([[maybe_unused]] const std::vector<std::span<const std::byte>>& arrays) {
#if defined(__linux__) && defined(MADV_HUGEPAGE)
  constexpr std::uintptr_t page = std::uintptr_t{1} << 21;
  constexpr int collapse = 25;                    // MADV_COLLAPSE, Linux 6.1: at once, not some day
  std::map<std::uintptr_t, std::uintptr_t> used;  // bytes of a page
  for (const auto array : arrays) {
    const auto begin = reinterpret_cast<std::uintptr_t>(array.data()), end = begin + array.size();
    for (std::uintptr_t p = begin / page; p * page < end; ++p)
      used[p] += std::min(end, (p + 1) * page) - std::max(begin, p * page);
  }
  for (const auto& [p, bytes] : used) {
    if (bytes < page / 4) continue;
    // The start of a page, which no pointer that there is need point to.
    void* const where = reinterpret_cast<void*>(p * page);  // NOLINT(performance-no-int-to-ptr)
    (void)madvise(where, page, MADV_HUGEPAGE);
    (void)madvise(where, page, collapse);
  }
#endif
}

}  // namespace crackle
