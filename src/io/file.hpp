// SPDX-License-Identifier: GPL-3.0-or-later
// Files whose every write is checked. Private to io.
#pragma once

#include <cstdint>
#include <cstdio>
#include <string>
#include <string_view>

namespace crackle {

/// @throws CaseError "<path>: cannot <what>: <reason of errno_value>" with advice on a full disk
[[noreturn]] void throw_file_error(const std::string& path, const std::string& what, int errno_value);

/// Writes the whole text to "<path>.tmp" and renames it to path: whoever reads path sees the old
/// file or the new one, never a part. @throws CaseError; "<path>.tmp" is removed then
void write_whole_file(const std::string& path, std::string_view text);

/// The same for a file that has to outlive a power cut: on the disk when this returns. @throws CaseError
void write_durable_file(const std::string& path, std::string_view text);

/// Renames "<path>.tmp" to path. @throws CaseError
void rename_finished(const std::string& path);

/// Tables that people bring, at most [bytes].
inline constexpr std::size_t largest_table = std::size_t{1} << 30;

/// The content of a file. @param most its size, at most [bytes] @throws CaseError
std::string read_whole_file(const std::string& path, std::size_t most = std::string::npos);

/// A text file that grows; each append reaches the operating system before it returns.
class AppendedFile {
 public:
  enum class Mode {
    create,  ///< the file must not be there yet
    extend,  ///< what is there stays
  };
  /// @throws CaseError
  AppendedFile(const std::string& path, Mode mode);
  ~AppendedFile();
  AppendedFile(const AppendedFile&) = delete;
  AppendedFile& operator=(const AppendedFile&) = delete;

  /// @throws CaseError; also when the file has been deleted meanwhile
  void append(std::string_view text);
  /// Bytes in the file.
  std::int64_t size() const;
  /// Brings all of it to the disk. @throws CaseError
  void sync();
  /// Cuts the file down to its first bytes. @throws CaseError
  void cut(std::int64_t size);
  /// Keeps others from locking it as long as it is open. @return false if another process has
  bool lock();

 private:
  std::string path_;
  std::FILE* stream_;
};

}  // namespace crackle
