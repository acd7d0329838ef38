// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "coupler/link/process.hpp"

namespace demvof {

/// Tells a process that works from one that is stopped or stuck: it uses CPU time, or waits for a disk.
/// Processes of other hosts cannot be seen, and count as alive.
class SignsOfLife {
 public:
  SignsOfLife(const Process& self, const std::vector<Process>& others);

  /// For how long the stillest of them has given no sign, s. Looks once a second at most.
  double silence();

 private:
  struct Seen {
    Process process;
    double cpu_seconds, time;  // at the last sign
  };
  std::vector<Seen> seen_;
  double last_look_ = 0, silence_ = 0;
};

}  // namespace demvof
