// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <mpi.h>

#include <string>
#include <vector>

#include "coupler/link/side.hpp"

namespace demvof {

/// One process of the pair, as the others know it.
struct Process {
  Side side;
  int rank;                  // in its own program
  long pid;                  // on its host
  unsigned long long start;  // when it was started, in the kernel's count: a pid may be given again
  std::string host;

  /// "dem_side rank 0 (process 4711 on host)"
  std::string name() const;
};

/// What to try when one is stopped.
inline constexpr const char* advice_on_a_stop =
    "see who stops it (SIGSTOP, Ctrl-Z, a debugger, a batch system), and let it go on (SIGCONT) in time.";

/// The calling process.
Process this_process(Side side, int rank);
/// All processes of a communicator in the order of its ranks. Collective.
std::vector<Process> all_processes(MPI_Comm comm, const Process& self);
/// What the kernel says of a process of this host.
struct Activity {
  char state = 'X';        // R, S, D, T, Z, ... as in proc(5); X: there is none
  double cpu_seconds = 0;  // used so far, all threads
};
Activity activity_of(const Process& process);
/// False when the process has ended, be it unburied (a zombie), or cannot be seen from here
/// (another host, another process namespace).
bool is_running(const Process& process);

}  // namespace demvof
