// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <condition_variable>
#include <mutex>
#include <thread>

#include "coupler/link/side.hpp"

namespace demvof {

/// Bounds the time in which MPI and the other processes have to answer for the first time: until then the
/// main thread sits in calls that wait for ever, for a partner that is stopped, no program of ours, or never
/// there. While this lives, a thread counts; at the end of the time it says so and ends the process with exit
/// code 4.
class StartLimit {
 public:
  /// seconds: 0: no limit.
  StartLimit(Side side, double seconds);
  ~StartLimit();
  StartLimit(const StartLimit&) = delete;
  StartLimit& operator=(const StartLimit&) = delete;

 private:
  std::mutex mutex_;
  std::condition_variable over_;
  bool started_ = false;
  std::thread thread_;
};

}  // namespace demvof
