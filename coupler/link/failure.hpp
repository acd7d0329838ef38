// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <string>

namespace demvof {

/// The exit codes of foam_side and dem_side.
enum ExitCode : int { exit_done = 0, exit_input = 2, exit_failed = 3, exit_partner_lost = 4 };

/// How a run of this process ended before its time.
struct Failure {
  int exit_code = exit_failed;
  std::string stage;    // what it was doing, in the words of its main loop
  double time = 0;      // simulated, s
  std::string message;  // what happened and what to try
};

/// Registers what a failing process still has to do, e.g. to write results.json. Called at most once,
/// from the main thread or, when that is busy or stuck, from the watching thread while the main thread
/// runs on: it must work on data of its own and must not call MPI or a solver.
void set_last_words(std::function<void(const Failure&)> last_words);

/// True for the first caller only: the one who reports the failure and ends the process.
bool claim_failure();
/// Prints the message with stage and time on stderr (unless quiet) and speaks the last words.
void report_failure(int exit_code, const std::string& message, bool quiet = false);
/// Ends the process at once: no destructors, no exit handlers, no MPI_Finalize that would wait for
/// the others. mpirun sees to the rest of the job.
[[noreturn]] void end_now(int exit_code);

}  // namespace demvof
