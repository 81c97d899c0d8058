// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace crackle {

/// Starts so many threads once and ends them again. The OpenMP library would end the whole program where a
/// limit of processes or of memory does not let it have them.
/// @param asked by -j; 0: all cores  @return how many a run has
/// @throws CaseError where they cannot be had
int require_threads(int asked);

}  // namespace crackle
