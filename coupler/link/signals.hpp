// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace demvof {

/// SIGPIPE ends the process no more: when nobody reads what it prints (mpirun has ended first: Open MPI 5.0
/// with --enable-recovery), printing fails and what has to be written into files still is. Called before
/// MPI_Init, which prints.
void outlive_readers();

/// SIGINT, SIGTERM, SIGUSR1 and SIGXCPU (the shell's limit of CPU time, with a second left until the next
/// one) ask for a stop at the end of the window. Solvers install handlers of
/// their own while they open a case: call this again once the solver is open. A second SIGINT or
/// SIGTERM is left to the system's default and ends the process at once.
///
/// What Open MPI's mpirun 4.1 does, as observed: it passes SIGUSR1 on to all ranks. On Ctrl-C, on
/// SIGTERM and when any rank dies it sends SIGTERM to the ranks, and SIGKILL
/// odls_base_sigkill_timeout (1 s) later or as soon as one of them has ended, and it serves nobody's
/// MPI_Finalize meanwhile. So SIGUSR1 is the way to stop a pair in good order; after SIGTERM both
/// sides end their window and leave without finalising MPI; and SIGTERM wakes the watch (watch.hpp),
/// which knows whether somebody has died.
/// With them come the handlers of crashes (crash.hpp).
void install_signal_handlers();

/// True once one of the signals has come. The link carries it to every rank of both sides.
bool stop_requested();
/// True once SIGTERM has come: there may be less than a second left.
bool in_a_hurry();

}  // namespace demvof
