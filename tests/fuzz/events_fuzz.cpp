// SPDX-License-Identifier: GPL-3.0-or-later
//
// Any text as the events.csv of a run: events, or a CaseError that names the line.
#include <cstdint>

#include "crackle/core/errors.hpp"
#include "crackle/io/output.hpp"
#include "scratch_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    crackle::read_events_csv(crackle_fuzz::scratch_file(data, size, ".csv"));
  } catch (const crackle::CaseError&) {
  }
  return 0;
}
