// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a run is in either regime: one process of it, from the beginning or a checkpoint to the end or an
// interruption, with its folder, its progress and its checkpoints.
#pragma once

#include <chrono>
#include <string>

#include "commands.hpp"
#include "crackle/io/case.hpp"
#include "crackle/io/output.hpp"
#include "progress.hpp"
#include "status.hpp"
#include "tally.hpp"

namespace crackle {

class RunLoop {
 public:
  RunLoop(const RunOptions& options, const Case& scene, RunFolder& folder, Status& status);
  RunLoop(const RunLoop&) = delete;
  RunLoop& operator=(const RunLoop&) = delete;
  virtual ~RunLoop() = default;

  /// @return exit code
  int go();

 protected:
  using Clock = std::chrono::steady_clock;
  static double seconds_since(Clock::time_point start);

  void say(const std::string& line);
  double wall() const { return seconds_since(start_); }  ///< of this process [s]
  const std::string& exit_reason() const { return exit_; }

  const RunOptions& options_;
  const Case& scene_;
  RunFolder& folder_;
  Tally tally_;
  std::string text_;  // of the resolved case

 private:
  /// From the case, or from the folder's newest checkpoint.
  virtual void begin() = 0;
  /// What comes before the first step.
  virtual void set_out() {}
  virtual bool is_at_end() const = 0;
  virtual void step() = 0;
  /// What comes after the last one.
  virtual void arrive() {}
  virtual Progress::Now now() const = 0;
  virtual void write_checkpoint() = 0;
  /// The last frame and summary.json, also of a run that was stopped.
  virtual RunSummary finish() = 0;
  virtual void report(const RunSummary& summary) = 0;

  void step_to_end(Progress& progress);
  bool checkpoint_is_due() const;
  void write_checkpoint_now();

  Status& status_;
  std::string exit_ = "done";
  Clock::time_point start_ = Clock::now(), last_checkpoint_ = start_;
};

}  // namespace crackle
