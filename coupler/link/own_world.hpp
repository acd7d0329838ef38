// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <mpi.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "coupler/link/failure.hpp"
#include "coupler/link/failure_signal.hpp"
#include "coupler/link/process.hpp"
#include "coupler/link/side.hpp"
#include "coupler/link/watch.hpp"

namespace demvof {

/// The communicator that stands for MPI_COMM_WORLD inside one program of a pair.
///
/// Construction initialises MPI, splits the real world by program, and from then on every MPI call
/// of OpenFOAM's or LIGGGHTS's code that names MPI_COMM_WORLD works on this program's own ranks
/// (pmpi.cpp substitutes it through the MPI profiling interface). MPI_Abort stays on the real world.
/// MPI_Finalize and MPI_Abort called by a solver library without announcement throw SolverStopped.
/// Where nothing can be thrown (exit(), a destructor, an exception in flight) they report, tell the
/// partner and end the process with exit code 3; so does any other exit before finalise().
///
/// One per process. A program started alone, without its partner, works too.
class OwnWorld {
 public:
  /// start_limit: for the other processes to start, s; who waits longer ends the process with exit code 4. 0:
  /// for ever. notes: the folder in which a failing process leaves the reason (failure.hpp); empty: none.
  OwnWorld(int& argc, char**& argv, Side side, double start_limit = 0,
           const std::filesystem::path& notes = {});
  ~OwnWorld();  // does not finalise MPI: finalise() does, once
  OwnWorld(const OwnWorld&) = delete;
  OwnWorld& operator=(const OwnWorld&) = delete;

  Side side() const { return side_; }
  /// The ranks of this program, for the coupler's own traffic: a duplicate, so that it cannot clash
  /// with a solver's, and one that returns errors. Solvers get MPI_COMM_WORLD.
  MPI_Comm comm() const { return comm_; }
  int rank() const { return rank_; }
  int size() const { return size_; }
  /// Ranks of the partner program in the real world; 0 when this program was started alone.
  int partner_size() const { return partner_size_; }
  /// Real-world rank of the partner's rank 0 (meaningless when alone).
  int partner_leader() const { return partner_leader_; }

  /// This process and those of the partner, as messages name them.
  const Process& self() const { return self_; }
  const Process& partner(int rank) const;

  /// Tells every other rank of the pair that this side fails, without waiting for an answer.
  void signal_failure(const std::string& reason) const noexcept;
  /// Ends this process before its time: says why (message), speaks the last words (failure.hpp), lets
  /// the partner hear of it, and exits with the code, without destructors. From the main thread.
  /// heard: the reason is what another rank said, to all of us.
  [[noreturn]] void fail(int exit_code, const std::string& message, bool heard = false) const;
  /// The orderly end, collective over both programs: finalises MPI, unless the pair is in a hurry. What
  /// a library does about the end of MPI later is without effect.
  void finalise();

  /// What the two programs share; for the link.
  struct Pair {
    MPI_Comm both = MPI_COMM_NULL;     // all ranks of both programs
    MPI_Comm partner = MPI_COMM_NULL;  // intercommunicator; null when alone
    std::vector<Process> processes;    // by rank in both
    std::unique_ptr<FailureSignal> failure_signal;
    std::unique_ptr<Watch> watch;
    bool in_a_hurry = false;  // a rank got SIGTERM (signals.hpp), as both sides agreed
  };
  Pair& pair() const { return *pair_; }

 private:
  bool heard_the_same(const std::string& reason) const;

  Side side_;
  MPI_Comm comm_ = MPI_COMM_NULL;
  int rank_ = 0, size_ = 1, partner_size_ = 0, partner_leader_ = -1;
  Process self_;
  std::unique_ptr<Pair> pair_;
};

}  // namespace demvof
