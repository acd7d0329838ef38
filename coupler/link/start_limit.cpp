// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/link/start_limit.hpp"

#include <fmt/format.h>
#include <pthread.h>
#include <signal.h>

#include <chrono>
#include <string>

#include "coupler/link/failure.hpp"

namespace demvof {
namespace {

[[noreturn]] void give_up(Side side, double seconds) {
  const std::string text = fmt::format(
      "{} waited {:g} s for the other processes of the run to start, and gave up.\n"
      "What to try: see that each program on the mpirun line is foam_side or dem_side, that none is stopped, "
      "and that the machine has memory for all; raise coupling.time_out if starting takes that long.",
      program_name(side), seconds);
  if (claim_failure()) report_failure(failure_here(side, exit_partner_lost, text), text);
  end_now(exit_partner_lost);
}

}  // namespace

StartLimit::StartLimit(Side side, double seconds) {
  if (seconds <= 0) return;
  sigset_t all, before;  // signals are for the main thread
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before);
  thread_ = std::thread([this, side, seconds] {
    std::unique_lock<std::mutex> lock(mutex_);
    if (!over_.wait_for(lock, std::chrono::duration<double>(seconds), [this] { return started_; }))
      give_up(side, seconds);
  });
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

StartLimit::~StartLimit() {
  if (!thread_.joinable()) return;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    started_ = true;
  }
  over_.notify_one();
  thread_.join();
}

}  // namespace demvof
