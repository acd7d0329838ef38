// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "coupler/link/process.hpp"

namespace demvof {

/// The exit codes of foam_side and dem_side.
enum ExitCode : int { exit_done = 0, exit_input = 2, exit_failed = 3, exit_partner_lost = 4 };

/// How a run of a process ended before its time.
struct Failure {
  int exit_code = exit_failed;
  Side side = Side::fluid;  // that failed: the cause may lie with another process than the one that tells
  std::string stage;        // what it was doing, in the words of its main loop
  double time = 0;          // simulated, s
  std::string message;      // what happened and what to try
};
/// Of this process, now.
Failure failure_here(Side side, int exit_code, const std::string& message);

/// One line of text, and back; nothing when it is none of to_text().
std::string to_text(const Failure& failure);
std::optional<Failure> failure_from(const std::string& text);

/// Registers what a failing process still has to do, e.g. to write results.json. Called at most once,
/// from the main thread or, when that is busy, stuck or has crashed, from the watching thread while the main
/// thread runs on: it must work on data of its own and must not call MPI or a solver.
void set_last_words(std::function<void(const Failure&)> last_words);

/// True for the first caller only: the one who reports the failure and ends the process.
bool claim_failure();
/// Prints the text on stderr (unless quiet) and speaks the last words.
void report_failure(const Failure& failure, const std::string& text, bool quiet = false);
/// Ends the process at once: no destructors, no exit handlers, no MPI_Finalize that would wait for
/// the others. mpirun sees to the rest of the job.
[[noreturn]] void end_now(int exit_code);

/// What this process has heard of as the cause of its end, if anything: the first failure of another process.
void heard_of(const Failure& failure);
std::optional<Failure> cause_heard();

// Whoever finds a process dead wants to know why, and may be in a state in which no message is received: a
// failing process leaves a note in the folder of the run.

/// The folder; before the first note. Removes this process's note of an earlier run.
void leave_notes_in(const std::filesystem::path& folder, const Process& self);
void leave_note(const Failure& failure) noexcept;
/// The note of a process, if it left one.
std::optional<Failure> note_of(const Process& process);

}  // namespace demvof
