// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <unistd.h>

#include <cstdint>
#include <cstdio>
#include <string>

namespace crackle_fuzz {

/// For readers that take a path: a file in memory that holds the input.
inline std::string scratch_file(const std::uint8_t* data, std::size_t size, const char* ending) {
  static const std::string path = "/dev/shm/crackle_fuzz_" + std::to_string(getpid()) + ending;
  std::FILE* file = std::fopen(path.c_str(), "wb");
  if (file == nullptr || std::fwrite(data, 1, size, file) != size) std::abort();
  std::fclose(file);
  return path;
}

}  // namespace crackle_fuzz
