// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <ctime>

namespace demvof {

/// CPU time of this process, s.
inline double cpu_seconds() {
  timespec now;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace demvof
