// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "coupler/link/process.hpp"

namespace demvof {

/// Looks after the other processes of the pair on this host, from a thread of its own: the main
/// thread may be deep inside a solver when one of them is killed. The kernel wakes it when one ends.
///
/// When this process itself crashes (crash.hpp), the watch tells so and ends it with exit code 3.
///
/// When one has ended, a main thread that waits for the partner throws PartnerLost (check); one that
/// computes is not waited for: the watch itself reports, speaks the last words and ends the process
/// with exit code 4; a note that the dead process has left (failure.hpp) says why. Of a side without a
/// partner, whose ranks wait for each other inside the solver, it does the same when one of them is stopped.
/// mpirun kills the rest of a job one or two seconds after the first death. Processes on other hosts cannot
/// be seen: their loss shows when the link's time-out passes.
class Watch {
 public:
  /// others: processes to look after; those that cannot be seen from here are left out.
  /// longest_stop: of one of them, s; 0: others look after that.
  Watch(const Process& self, const std::vector<Process>& others, double longest_stop);
  ~Watch();
  Watch(const Watch&) = delete;
  Watch& operator=(const Watch&) = delete;

  /// Throws PartnerLost, naming the process, when one has ended. Costs one atomic read.
  void check() const;
  /// The main thread tells when it waits and so will call check() within milliseconds.
  void main_thread_waits(bool waits) { main_waits_ = waits; }
  /// From now on other processes may end.
  void stand_down() { standing_down_ = true; }
  bool someone_lost() const { return lost_; }

  /// Makes the watch look now rather than at its next turn. Async-signal-safe.
  static void look_now();

 private:
  void keep_watch();
  void wait_for_news() const;
  const Process* find_ended() const;
  const Process* find_stopped();
  void handle_loss(const Process& ended);
  void handle_stop(const Process& stopped);
  void handle_crash(int number);
  void pause(long milliseconds);

  struct Watched {
    Process process;
    int end;             // a file that can be read when it has ended; -1: none
    double stopped = 0;  // s so far, of which this process was not stopped itself
  };

  Process self_;
  double longest_stop_, looked_ = 0;  // s
  std::vector<Watched> watched_;
  std::string loss_;              // written once before lost_ is set
  std::optional<int> loss_code_;  // of a fellow that left a note; likewise
  std::atomic<bool> lost_{false}, main_waits_{false}, standing_down_{false}, quit_{false};
  std::thread thread_;
};

}  // namespace demvof
