// SPDX-License-Identifier: GPL-3.0-or-later
#include "file.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
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

/// On the disk, not only with the operating system; the errno value on failure, else 0. What cannot
/// be synced (a pipe, some network file systems) counts as done.
int bring_to_disk(int descriptor) { return fsync(descriptor) == 0 || errno == EINVAL ? 0 : errno; }

void write_file(const std::string& path, std::string_view text, bool durable) {
  const std::string unfinished = path + ".tmp";
  std::FILE* stream = std::fopen(unfinished.c_str(), "wb");
  if (stream == nullptr) throw_file_error(path, "write", errno);
  int reason = put(stream, text);
  if (durable && reason == 0) reason = bring_to_disk(fileno(stream));
  // close() is where a network file system reports what it could not store
  if (std::fclose(stream) != 0 && reason == 0) reason = errno;
  if (reason != 0) {
    std::remove(unfinished.c_str());
    throw_file_error(path, "write", reason);
  }
  rename_finished(path);
}

}  // namespace

void throw_file_error(const std::string& path, const std::string& what, int errno_value) {
  std::string message = path + ": cannot " + what + ": " + std::strerror(errno_value);
  if (errno_value == ENOSPC || errno_value == EDQUOT) {
    message += "; free some space, or write fewer frames ([output] fields_every)";
  }
  throw CaseError(message);
}

void write_whole_file(const std::string& path, std::string_view text) { write_file(path, text, false); }

void write_durable_file(const std::string& path, std::string_view text) {
  write_file(path, text, true);
  // The name is on the disk once the folder is.
  const std::string folder = std::filesystem::path(path).parent_path().string();
  const int descriptor = open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  bring_to_disk(descriptor);
  close(descriptor);
}

void rename_finished(const std::string& path) {
  const std::string unfinished = path + ".tmp";
  if (std::rename(unfinished.c_str(), path.c_str()) == 0) return;
  const int reason = errno;
  std::remove(unfinished.c_str());
  throw_file_error(path, "write", reason);
}

std::string read_whole_file(const std::string& path, std::size_t most) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> stream(std::fopen(path.c_str(), "rb"), std::fclose);
  if (stream == nullptr) throw_file_error(path, "read", errno);
  std::string text;
  char block[65536];
  for (;;) {
    errno = 0;
    const std::size_t count = std::fread(block, 1, sizeof block, stream.get());
    text.append(block, count);
    if (text.size() > most)
      throw CaseError(path + ": too large to be read (over " + std::to_string(most >> 20) + " MiB)");
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
  struct stat now {};
  if (fstat(fileno(stream_), &now) == 0 && now.st_nlink == 0) throw_file_error(path_, "write", ENOENT);
  if (const int reason = put(stream_, text); reason != 0) throw_file_error(path_, "write", reason);
}

std::int64_t AppendedFile::size() const {
  struct stat now {};
  return fstat(fileno(stream_), &now) == 0 ? now.st_size : 0;
}

void AppendedFile::sync() {
  if (const int reason = bring_to_disk(fileno(stream_)); reason != 0)
    throw_file_error(path_, "write", reason);
}

void AppendedFile::cut(std::int64_t size) {
  if (ftruncate(fileno(stream_), size) != 0) throw_file_error(path_, "cut", errno);
}

bool AppendedFile::lock() {
  // A file system without locks gives none: then there is no telling.
  return flock(fileno(stream_), LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK;
}

}  // namespace crackle
