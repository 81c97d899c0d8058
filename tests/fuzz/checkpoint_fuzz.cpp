// SPDX-License-Identifier: GPL-3.0-or-later
//
// Any bytes as a checkpoint: what is not one is refused, and nothing is changed then.
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "crackle/core/errors.hpp"
#include "crackle/io/checkpoint.hpp"
#include "crackle/state/members.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  crackle::ContactState state;
  try {
    crackle::unpack_checkpoint({reinterpret_cast<const char*>(data), size}, "fuzz.h5",
                               crackle::columns_of(state, "contact"));
  } catch (const crackle::CaseError&) {
    if (!state.points.empty() || state.broken != -1) std::abort();
  }
  return 0;
}
