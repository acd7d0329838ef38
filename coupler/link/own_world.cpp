// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/link/own_world.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cstdlib>
#include <exception>
#include <stdexcept>
#include <thread>

#include "coupler/base/mpi_check.hpp"
#include "coupler/base/words_of.hpp"
#include "coupler/link/pmpi.hpp"
#include "coupler/link/run_stage.hpp"
#include "coupler/link/signals.hpp"
#include "coupler/link/start_limit.hpp"

namespace demvof {
namespace {

using namespace std::chrono_literals;

// Between saying why a process fails and its end.
constexpr auto time_for_the_partner = 1000ms;  // to hear of it and write its own results
constexpr auto time_for_the_sender = 3000ms;   // to end first, so that mpirun reports its exit code
constexpr auto time_to_linger = 300ms;         // for the others to find the first death, not ours

OwnWorld* current = nullptr;
std::thread::id main_thread;

// Somebody ends the program behind our back: exit() in a solver, an exception nobody catches.
void sudden_end(const char* why) {
  if (std::this_thread::get_id() != main_thread || !current) {
    if (claim_failure())
      report_failure(failure_here(current ? current->side() : Side::fluid, exit_failed, why), why);
    end_now(exit_failed);
  }
  current->fail(exit_failed, std::string(program_name(current->side())) + " stopped " +
                                 run_stage().describe() + ": " + why +
                                 ".\nWhat to try: the reason is in the solver's own log.");
}

void at_exit() {
  if (!end_announced()) sudden_end("a solver library called exit()");
}

void on_terminate() {
  std::string why = "the program was terminated";
  if (const auto thrown = std::current_exception()) {
    try {
      std::rethrow_exception(thrown);
    } catch (const std::exception& error) {
      why = words_of(error);
    } catch (...) {
    }
  }
  sudden_end(why.c_str());
}

/// name: for debuggers, and for tests/benchmarks/messages.py.
MPI_Comm duplicate(MPI_Comm comm, const char* name) {
  MPI_Comm copy = MPI_COMM_NULL;
  check_mpi(PMPI_Comm_dup(comm, &copy), "MPI_Comm_dup");
  check_mpi(PMPI_Comm_set_name(copy, name), "MPI_Comm_set_name");
  check_mpi(PMPI_Comm_set_errhandler(copy, MPI_ERRORS_RETURN), "MPI_Comm_set_errhandler");
  return copy;
}

}  // namespace

OwnWorld::OwnWorld(int& argc, char**& argv, Side side, double start_limit, const std::filesystem::path& notes)
    : side_(side), pair_(std::make_unique<Pair>()) {
  if (current) throw std::logic_error("one OwnWorld per process");
  outlive_readers();
  const StartLimit limit(side, start_limit);
  int provided = 0;
  check_mpi(PMPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &provided), "MPI_Init_thread");
  pair_->both = duplicate(MPI_COMM_WORLD, "demvof pair");
  int world_rank = 0;
  check_mpi(PMPI_Comm_rank(pair_->both, &world_rank), "MPI_Comm_rank");

  MPI_Comm program = MPI_COMM_NULL;
  check_mpi(PMPI_Comm_split(MPI_COMM_WORLD, static_cast<int>(side), world_rank, &program), "MPI_Comm_split");
  comm_ = duplicate(program, "demvof program");
  check_mpi(PMPI_Comm_rank(comm_, &rank_), "MPI_Comm_rank");
  check_mpi(PMPI_Comm_size(comm_, &size_), "MPI_Comm_size");

  self_ = this_process(side, rank_);
  pair_->processes = all_processes(pair_->both, self_);
  std::vector<Process> others;
  for (int rank = 0; rank < static_cast<int>(pair_->processes.size()); ++rank) {
    const Process& process = pair_->processes[rank];
    if (process.side != side) {
      ++partner_size_;
      if (process.rank == 0) partner_leader_ = rank;
    }
    if (rank != world_rank) others.push_back(process);
  }
  if (partner_size_ > 0) {
    check_mpi(PMPI_Intercomm_create(comm_, 0, pair_->both, partner_leader_, 0, &pair_->partner),
              "MPI_Intercomm_create");
    check_mpi(PMPI_Comm_set_errhandler(pair_->partner, MPI_ERRORS_RETURN), "MPI_Comm_set_errhandler");
    check_mpi(PMPI_Comm_set_name(pair_->partner, "demvof partner"), "MPI_Comm_set_name");
  }

  current = this;
  main_thread = std::this_thread::get_id();
  if (!notes.empty()) leave_notes_in(notes, self_);
  pair_->failure_signal = std::make_unique<FailureSignal>(pair_->both);
  pair_->watch = std::make_unique<Watch>(self_, others, partner_size_ == 0 ? start_limit : 0);
  install_signal_handlers();
  on_sudden_end(sudden_end);
  std::set_terminate(on_terminate);
  std::atexit(at_exit);
  substitute_world(program);
}

OwnWorld::~OwnWorld() {
  current = nullptr;
}

const Process& OwnWorld::partner(int rank) const {
  for (const Process& process : pair_->processes)
    if (process.side != side_ && process.rank == rank) return process;
  throw std::logic_error("no such partner rank");
}

void OwnWorld::signal_failure(const std::string& reason) const noexcept {
  pair_->failure_signal->send(failure_here(side_, exit_failed, reason));
}

void OwnWorld::fail(int exit_code, const std::string& message, bool heard) const {
  if (!claim_failure()) {  // the watch was first and ends the process
    for (int i = 0; i < 100; ++i) std::this_thread::sleep_for(100ms);
    end_now(exit_code);
  }
  Failure failure = failure_here(side_, exit_code, message);
  // What another process was the first to tell is the cause, also of what followed from it here.
  if (const std::optional<Failure> cause = cause_heard()) {
    failure = *cause;
    failure.exit_code = exit_code;
  }
  leave_note(failure);
  // Rank 0 passes on what others said. All ranks of a side mostly fail with the same words: rank 0 says
  // them, before the other side can say that it did, and the others wait for it.
  if (rank_ == 0) report_failure(failure, message);
  if (!heard) pair_->failure_signal->send(failure);
  if (rank_ != 0)
    report_failure(failure, fmt::format("[rank {}] {}", rank_, message), heard || heard_the_same(message));
  pair_->failure_signal->flush(1.0);
  const auto until = std::chrono::steady_clock::now() + (heard ? time_for_the_sender : time_for_the_partner);
  const bool first = !heard && exit_code != exit_partner_lost;
  const auto others_end = [&] { return pair_->watch->someone_lost() || stop_requested(); };
  while (std::chrono::steady_clock::now() < until && (first || !others_end()))
    std::this_thread::sleep_for(5ms);
  if (!first) std::this_thread::sleep_for(time_to_linger);
  // Not MPI_Abort: it kills a partner that is still writing its results, and hangs when mpirun is
  // already at it. mpirun treats an exit without MPI_Finalize as an abort, but leaves a second.
  end_now(exit_code);
}

bool OwnWorld::heard_the_same(const std::string& reason) const {
  const auto same = [&reason](const std::string& said) { return said == reason.substr(0, said.size()); };
  // It may have come while this rank still waited for all to hear of a disagreement.
  if (const auto cause = cause_heard(); cause && cause->side == side_ && same(cause->message)) return true;
  for (int i = 0; i < 200; ++i) {
    try {
      if (const auto notice = pair_->failure_signal->receive())
        if (pair_->processes[notice->from].side == side_ && same(notice->failure.message)) return true;
    } catch (const std::exception&) {
      return false;
    }
    std::this_thread::sleep_for(5ms);
  }
  return false;
}

void OwnWorld::finalise() {
  if (end_announced()) return;
  pair_->watch->stand_down();
  announce_end();
  // After SIGTERM mpirun does not take part in finalising; it kills whoever waits for it.
  if (pair_->in_a_hurry || (partner_size_ == 0 && in_a_hurry()))
    std::this_thread::sleep_for(std::chrono::milliseconds(50));  // for the others to see the link closed
  else
    check_mpi(PMPI_Finalize(), "MPI_Finalize");
}

}  // namespace demvof
