// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace crackle {

/// From now on SIGUSR1 asks for a checkpoint; SIGTERM and SIGHUP ask the run to stop; a limit of file size or
/// a closed terminal is met as an error of the write, not as the end of the process. A SIGHUP that was
/// ignored (nohup) still is.
void heed_signals();
/// From now on SIGINT asks the run to stop too. Before its first step whoever sits there need not wait.
void heed_interrupt();

bool stop_requested();
/// Whether a checkpoint has been asked for since the last call.
bool take_checkpoint_request();

}  // namespace crackle
