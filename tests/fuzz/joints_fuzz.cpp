// SPDX-License-Identifier: GPL-3.0-or-later
//
// Any text as a table of joints: joints with finite ends, or a CaseError.
#include <cmath>
#include <cstdint>
#include <cstdlib>

#include "crackle/core/errors.hpp"
#include "crackle/io/joints_csv.hpp"
#include "scratch_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    for (const crackle::Joint& joint :
         crackle::read_joints_csv(crackle_fuzz::scratch_file(data, size, ".csv"), 0)) {
      if (!std::isfinite(crackle::norm(joint.from)) || !std::isfinite(crackle::norm(joint.to))) std::abort();
    }
  } catch (const crackle::CaseError&) {
  }
  return 0;
}
