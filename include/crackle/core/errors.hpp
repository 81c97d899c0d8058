// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <stdexcept>
#include <string>

namespace crackle {

/// Exit codes of the `crackle` command, one for each kind of end.
enum class ExitCode : int { done = 0, bad_case = 2, bad_mesh = 3, numerical_stop = 4, interrupted = 75 };

/// Base of every error that crackle reports: one line that says what, where and what to do.
class Error : public std::runtime_error {
 public:
  Error(ExitCode code, const std::string& message) : std::runtime_error(message), code_(code) {}
  ExitCode code() const { return code_; }

 private:
  ExitCode code_;
};

/// Something in the user's case (or command line, or output folder) is wrong.
class CaseError : public Error {
 public:
  /// @param file case file or folder the error is in; may be empty
  /// @param line, column position in the file, counted from 1; 0 where there is none
  CaseError(const std::string& file, int line, int column, const std::string& message)
      : Error(ExitCode::bad_case, place(file, line, column) + message) {}
  explicit CaseError(const std::string& message) : Error(ExitCode::bad_case, message) {}

 private:
  static std::string place(const std::string& file, int line, int column) {
    std::string at = file;
    if (line > 0) {
      at += ':';
      at += std::to_string(line);
      at += ':';
      at += std::to_string(column);
    }
    if (!at.empty()) at += ": ";
    return at;
  }
};

/// A mesh cannot be made or read, or is not fit for a run.
class MeshError : public Error {
 public:
  explicit MeshError(const std::string& message) : Error(ExitCode::bad_mesh, message) {}
};

/// The computation left the range in which its result means anything; the message names the
/// element, the place, the step and the time, and the likely cause.
class NumericalError : public Error {
 public:
  explicit NumericalError(const std::string& message) : Error(ExitCode::numerical_stop, message) {}
};

}  // namespace crackle
