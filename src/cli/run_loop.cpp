// SPDX-License-Identifier: GPL-3.0-or-later
#include "run_loop.hpp"

#include <fmt/format.h>

#include "crackle/core/errors.hpp"
#include "crackle/core/version.hpp"
#include "signals.hpp"

namespace crackle {

RunLoop::RunLoop(const RunOptions& options, const Case& scene, RunFolder& folder, Status& status)
    : options_(options),
      scene_(scene),
      folder_(folder),
      tally_(scene.run.end_time),
      text_(resolved_toml(scene)),
      status_(status) {}

int RunLoop::go() {
  say(fmt::format("crackle {}: {}", version, scene_.title.empty() ? scene_.file : scene_.title));
  begin();
  heed_interrupt();
  Progress progress(scene_.run.end_time, options_.quiet);
  last_checkpoint_ = Clock::now();
  try {
    step_to_end(progress);
  } catch (const NumericalError& error) {
    exit_ = error.what();
    finish();
    progress.finish(now());
    folder_.log(exit_);
    throw;
  }
  const RunSummary summary = finish();
  progress.finish(now());
  if (is_at_end()) folder_.remove_checkpoints();
  report(summary);
  say(fmt::format("{}: {}", exit_, folder_.path()));
  if (is_at_end()) return static_cast<int>(ExitCode::done);
  say("to go on: crackle run --resume " + folder_.path());
  return static_cast<int>(ExitCode::interrupted);
}

void RunLoop::step_to_end(Progress& progress) {
  set_out();
  while (!is_at_end() && !stop_requested()) {
    step();
    progress.show(now());
    status_.show(now());
    if (checkpoint_is_due()) write_checkpoint_now();
  }
  if (is_at_end()) {
    arrive();
  } else {
    exit_ = "interrupted";
    write_checkpoint_now();
  }
}

bool RunLoop::checkpoint_is_due() const {
  if (take_checkpoint_request()) return true;
  const double every = scene_.output.checkpoint_every;
  return every > 0.0 && seconds_since(last_checkpoint_) >= every;
}

void RunLoop::write_checkpoint_now() {
  write_checkpoint();
  last_checkpoint_ = Clock::now();
}

void RunLoop::say(const std::string& line) {
  folder_.log(line);
  if (!options_.quiet) print_line(line);
}

double RunLoop::seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

}  // namespace crackle
