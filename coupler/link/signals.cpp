// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/link/signals.hpp"

#include <signal.h>

#include "coupler/link/watch.hpp"

namespace demvof {
namespace {

volatile sig_atomic_t requested = 0;

extern "C" void demvof_on_stop_signal(int) {
  requested = 1;
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
}

bool stop_requested() {
  return requested != 0;
}

}  // namespace demvof
