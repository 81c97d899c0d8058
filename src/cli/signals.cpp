// SPDX-License-Identifier: GPL-3.0-or-later
#include "signals.hpp"

#include <csignal>

namespace crackle {
namespace {

volatile std::sig_atomic_t stop = 0;
volatile std::sig_atomic_t checkpoint = 0;
void on_stop(int) { stop = 1; }
void on_checkpoint(int) { checkpoint = 1; }

}  // namespace

void heed_signals() {
  std::signal(SIGUSR1, on_checkpoint);
  std::signal(SIGXFSZ, SIG_IGN);
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGTERM, on_stop);
  if (std::signal(SIGHUP, on_stop) == SIG_IGN) std::signal(SIGHUP, SIG_IGN);
}

void heed_interrupt() { std::signal(SIGINT, on_stop); }

bool stop_requested() { return stop != 0; }

bool take_checkpoint_request() {
  const bool asked = checkpoint != 0;
  checkpoint = 0;
  return asked;
}

}  // namespace crackle
