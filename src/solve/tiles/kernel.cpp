// SPDX-License-Identifier: GPL-3.0-or-later
#include "kernel.hpp"

namespace crackle::tiles {

const Kernels& kernels() {
  static const Kernels best = [] {
#ifdef CRACKLE_X86_LEVELS
    const bool v3 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
                    __builtin_cpu_supports("bmi") && __builtin_cpu_supports("bmi2");
    const bool v4 = v3 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
                    __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("avx512dq") &&
                    __builtin_cpu_supports("avx512vl");
    if (v4) return Kernels{v4::copy, v4::copy_motion, v4::move, v4::rock, v4::elements};
    if (v3) return Kernels{v3::copy, v3::copy_motion, v3::move, v3::rock, v3::elements};
#endif
    return Kernels{baseline::copy, baseline::copy_motion, baseline::move, baseline::rock, baseline::elements};
  }();
  return best;
}

}  // namespace crackle::tiles
