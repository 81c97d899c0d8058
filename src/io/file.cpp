// SPDX-License-Identifier: GPL-3.0-or-later
#include "file.hpp"

#include <cerrno>
#include <cstring>
#include <memory>

#include "crackle/core/errors.hpp"

namespace crackle {

namespace {

/// Writes and flushes; the errno value on failure, else 0.
int put(std::FILE* stream, std::string_view text) {
  errno = 0;
  const bool written = std::fwrite(text.data(), 1, text.size(), stream) == text.size();
  if (written && std::fflush(stream) == 0) return 0;
  return errno != 0 ? errno : EIO;
}

}  // namespace

void throw_file_error(const std::string& path, const std::string& what, int errno_value) {
  std::string message = path + ": cannot " + what + ": " + std::strerror(errno_value);
  if (errno_value == ENOSPC || errno_value == EDQUOT) {
    message += "; free some space, or write fewer frames ([output] fields_every)";
  }
  throw CaseError(message);
}

void write_whole_file(const std::string& path, std::string_view text) {
  const std::string unfinished = path + ".tmp";
  std::FILE* stream = std::fopen(unfinished.c_str(), "wb");
  if (stream == nullptr) throw_file_error(path, "write", errno);
  int reason = put(stream, text);
  // close() is where a network file system reports what it could not store
  if (std::fclose(stream) != 0 && reason == 0) reason = errno;
  if (reason != 0) {
    std::remove(unfinished.c_str());
    throw_file_error(path, "write", reason);
  }
  rename_finished(path);
}

void rename_finished(const std::string& path) {
  const std::string unfinished = path + ".tmp";
  if (std::rename(unfinished.c_str(), path.c_str()) == 0) return;
  const int reason = errno;
  std::remove(unfinished.c_str());
  throw_file_error(path, "write", reason);
}

std::string read_whole_file(const std::string& path) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> stream(std::fopen(path.c_str(), "rb"), std::fclose);
  if (stream == nullptr) throw_file_error(path, "read", errno);
  std::string text;
  char block[65536];
  for (;;) {
    errno = 0;
    const std::size_t count = std::fread(block, 1, sizeof block, stream.get());
    text.append(block, count);
    if (count < sizeof block) break;
  }
  if (std::ferror(stream.get()) != 0) throw_file_error(path, "read", errno != 0 ? errno : EIO);
  return text;
}

AppendedFile::AppendedFile(const std::string& path, Mode mode)
    : path_(path), stream_(std::fopen(path.c_str(), mode == Mode::create ? "wbx" : "ab")) {
  if (stream_ == nullptr) throw_file_error(path, "create", errno);
}

AppendedFile::~AppendedFile() { std::fclose(stream_); }  // nothing is left to flush: append() did

void AppendedFile::append(std::string_view text) {
  if (const int reason = put(stream_, text); reason != 0) throw_file_error(path_, "write", reason);
}

}  // namespace crackle
