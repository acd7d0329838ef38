// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace demvof {

/// SIGINT, SIGTERM and SIGUSR1 ask for a stop at the end of the window. Solvers install handlers of
/// their own while they open a case: call this again once the solver is open. A second SIGINT or
/// SIGTERM is left to the system's default and ends the process at once.
///
/// mpirun answers Ctrl-C and its own SIGTERM by sending SIGTERM to all ranks and SIGKILL one second
/// later (--mca odls_base_sigkill_timeout); it passes SIGUSR1 on. The death of any rank makes it do
/// the same, so SIGTERM also wakes the watch (watch.hpp), which tells the two cases apart.
void install_signal_handlers();

/// True once one of the signals has come. The link carries it to every rank of both sides.
bool stop_requested();

}  // namespace demvof
