// SPDX-License-Identifier: GPL-3.0-or-later
//
// Any bytes as a checkpoint, as they are and with a right checksum: what is not one is refused, nothing is
// changed then, and nothing of it stays open.
#include <hdf5.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>

#include "crackle/core/errors.hpp"
#include "crackle/io/checkpoint.hpp"
#include "crackle/state/members.hpp"

namespace {

void unpack(std::string_view bytes) {
  crackle::ContactState state;
  try {
    crackle::unpack_checkpoint(bytes, "fuzz.h5", crackle::columns_of(state, "contact"));
  } catch (const crackle::CaseError&) {
    if (!state.points.empty() || state.broken != -1) std::abort();
  }
  if (H5Fget_obj_count(H5F_OBJ_ALL, H5F_OBJ_ALL) != 0) std::abort();
}

void put(std::string& bytes, const char* key, std::size_t digits, const std::string& value) {
  const std::size_t at = bytes.find(key);
  if (at < 512) bytes.replace(at + std::string_view(key).size(), digits, value);
}

// FNV-1a of the whole with zeros for the checksum, as src/io/checkpoint.cpp has it.
std::string sealed(std::string bytes) {
  put(bytes, "\nchecksum ", 16, std::string(16, '0'));
  std::uint64_t sum = 0xcbf29ce484222325u;
  for (const char c : bytes) sum = (sum ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
  char text[17];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(sum));
  put(bytes, "\nchecksum ", 16, text);
  return bytes;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  unpack(bytes);
  if (size > 512) unpack(sealed(std::string(bytes)));
  return 0;
}
