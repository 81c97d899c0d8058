// SPDX-License-Identifier: GPL-3.0-or-later
//
// Any text as a case: a case or a CaseError of one line; and what was resolved is read back to the same.
#include <cstdint>
#include <cstdlib>
#include <string>

#include "crackle/core/errors.hpp"
#include "crackle/io/case.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const crackle::Case scene = crackle::parse_case({reinterpret_cast<const char*>(data), size}, "fuzz.toml");
    const std::string resolved = crackle::resolved_toml(scene);
    if (crackle::resolved_toml(crackle::parse_case(resolved, "resolved.toml")) != resolved) std::abort();
  } catch (const crackle::CaseError& error) {
    if (std::string(error.what()).find('\n') != std::string::npos) std::abort();
  }
  return 0;
}
