// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "coupler/link/side.hpp"

namespace demvof {

/// Signals by which the kernel or the C library ends a program that computes nonsense or has lost its way:
/// SIGFPE, SIGSEGV, SIGBUS, SIGILL, SIGABRT. The thread that has crashed cannot tell anybody, it may hold any
/// lock: it wakes the watch (watch.hpp), which tells and ends the process. A library's handler of
/// failing allocations is taken out, too: they throw. Part of install_signal_handlers().
void install_crash_handlers();

/// The signal by which this process has crashed; 0: it has not.
int crash_signal();
/// What it means, and what to try.
std::string describe_crash(int number, Side side);

}  // namespace demvof
