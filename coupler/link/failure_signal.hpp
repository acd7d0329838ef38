// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <mpi.h>

#include <list>
#include <optional>
#include <string>
#include <vector>

#include "coupler/link/failure.hpp"

namespace demvof {

/// A word from a failing rank to every other rank of the pair.
class FailureSignal {
 public:
  struct Notice {
    int from;         // rank in the pair's communicator
    Failure failure;  // its exit code is the sender's
  };

  /// both: the communicator of all ranks of both programs; nothing else uses its messages' tag.
  explicit FailureSignal(MPI_Comm both) : both_(both) {}

  /// Does not wait and does not throw; flush gives it time to arrive.
  void send(const Failure& failure) noexcept;
  /// What was heard since the last call, if anything.
  std::optional<Notice> receive();
  /// Keeps MPI going until the notices are under way, at most this long.
  void flush(double seconds) noexcept;

 private:
  MPI_Comm both_;
  std::list<std::string> texts_;  // must outlive their requests
  std::vector<MPI_Request> requests_;
};

}  // namespace demvof
