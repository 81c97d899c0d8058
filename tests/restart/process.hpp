// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <sys/resource.h>
#include <sys/types.h>

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "../unit/cli/binary.hpp"

namespace crackle_test {

/// The crackle that was built, as a process of its own.
class Process {
 public:
  /// @param prepare is called in the process before crackle starts (limits, for example)
  Process(const std::vector<std::string>& arguments, const std::string& scratch,
          const std::function<void()>& prepare = {});
  ~Process();
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  void signal(int number) const;
  bool has_ended();
  /// Processor time it has taken [s].
  double processor_time() const;
  /// Memory that it holds [bytes].
  double resident_bytes() const;
  /// The most memory it has held, once it has ended [bytes].
  double peak_memory() const;
  /// Waits for its end; code -1 if a signal ended it.
  Outcome wait();

 private:
  pid_t child_;
  std::string out_, err_;
  int status_ = 0;
  rusage usage_{};
  bool ended_ = false;
};

/// Waits until a file is there, or the process has ended. @return whether the file is there
bool wait_for(const std::string& file, Process& process);

/// Files of a run folder with their bytes, but for what says when and how fast: run.log, status.json, and
/// the wall times in summary.json.
std::map<std::string, std::string> results(const std::string& folder);

/// Expects the same files with the same bytes.
void expect_same_results(const std::string& folder, const std::string& reference);

/// Expects that fields.pvd and fractures.pvd, where they are, can be read, and list whole files only.
void expect_readable_frames(const std::string& folder);

}  // namespace crackle_test
