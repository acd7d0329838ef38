// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/link/signals.hpp"

#include <signal.h>

#include <atomic>

#include "coupler/link/crash.hpp"
#include "coupler/link/watch.hpp"

namespace demvof {
namespace {

std::atomic<bool> requested{false}, hurry{false};
static_assert(std::atomic<bool>::is_always_lock_free);  // fit for a signal handler

extern "C" void demvof_on_stop_signal(int number) {
  requested = true;
  if (number == SIGTERM) hurry = true;
  Watch::look_now();
}

}  // namespace

void install_signal_handlers() {
  for (const int number : {SIGINT, SIGTERM, SIGUSR1}) {
    struct sigaction action = {};
    action.sa_handler = demvof_on_stop_signal;
    action.sa_flags = SA_RESTART | (number == SIGUSR1 ? 0 : static_cast<int>(SA_RESETHAND));
    sigemptyset(&action.sa_mask);
    sigaction(number, &action, nullptr);
  }
  install_crash_handlers();
}

bool stop_requested() {
  return requested;
}

bool in_a_hurry() {
  return hurry;
}

}  // namespace demvof
