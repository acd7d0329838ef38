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

void outlive_readers() {
  signal(SIGPIPE, [](int) {});  // ignored, it would be for programs that are started here, too
}

void install_signal_handlers() {
  for (const int number : {SIGINT, SIGTERM, SIGUSR1, SIGXCPU}) {
    const bool once = number == SIGINT || number == SIGTERM;
    struct sigaction action = {};
    action.sa_handler = demvof_on_stop_signal;
    action.sa_flags = SA_RESTART | (once ? static_cast<int>(SA_RESETHAND) : 0);
    sigemptyset(&action.sa_mask);
    sigaction(number, &action, nullptr);
  }
  signal(SIGXFSZ, SIG_IGN);  // a file beyond the shell's limit: its write fails, as on a full disk
  install_crash_handlers();
}

bool stop_requested() {
  return requested;
}

bool in_a_hurry() {
  return hurry;
}

}  // namespace demvof
