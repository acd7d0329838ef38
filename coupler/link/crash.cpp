// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/link/crash.hpp"

#include <fmt/format.h>
#include <signal.h>
#include <time.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <new>
#include <string_view>

#include "coupler/link/failure.hpp"
#include "coupler/link/run_stage.hpp"
#include "coupler/link/watch.hpp"

namespace demvof {
namespace {

std::atomic<int> crashed_by{0};
static_assert(std::atomic<int>::is_always_lock_free);  // fit for a signal handler

std::array<char, 65536> stack_of_handler;  // the thread's own may be what has run over

extern "C" void demvof_on_crash(int number) {
  int none = 0;
  if (!crashed_by.compare_exchange_strong(none, number)) _exit(exit_failed);
  Watch::look_now();
  const timespec turn{0, 100000000};
  for (int i = 0; i < 50; ++i) nanosleep(&turn, nullptr);  // the watch ends the process before that
  _exit(exit_failed);
}

const char* meaning(int number) {
  switch (number) {
    case SIGFPE:
      return "a division by zero, an overflow, or a number that is none (SIGFPE)";
    case SIGABRT:
      return "the program gave itself up, or the machine has no more memory (SIGABRT)";
    default:
      return "an access to memory that is not there (SIGSEGV)";
  }
}

}  // namespace

void install_crash_handlers() {
  std::set_new_handler(nullptr);  // no memory: std::bad_alloc, not a library's own way to give up
  stack_t stack = {};
  stack.ss_sp = stack_of_handler.data();
  stack.ss_size = stack_of_handler.size();
  sigaltstack(&stack, nullptr);
  for (const int number : {SIGFPE, SIGSEGV, SIGBUS, SIGILL, SIGABRT}) {
    struct sigaction action = {};
    action.sa_handler = demvof_on_crash;
    action.sa_flags = SA_ONSTACK;
    sigemptyset(&action.sa_mask);
    sigaction(number, &action, nullptr);
  }
}

int crash_signal() {
  return crashed_by;
}

std::string describe_crash(int number, Side side) {
  const std::string_view stage = run_stage().stage();
  if (stage == "start" || stage == "particle script" || stage == "reading the fluid case")
    return fmt::format(
        "{}.\nWhat to try: this was before the first step, while {} was read: something in it that cannot "
        "be, and "
        "is not looked for. Begin with one of the cases in 'cases' and change one thing at a time; {} says "
        "how "
        "far it came.",
        meaning(number), side == Side::fluid ? "the fluid case" : "the particles' script",
        side == Side::fluid ? "fluid.log" : "particles.log");
  return fmt::format(
      "{}.\nWhat to try: {} says what came before. Mostly the flow or the particles had left what is "
      "physical: "
      "smaller time steps (maxCo in controlDict, coupling.window, the script's timestep), and values within "
      "their ranges.",
      meaning(number), side == Side::fluid ? "fluid.log" : "particles.log");
}

}  // namespace demvof
