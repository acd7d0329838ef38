// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>

namespace demvof {

struct MachineFacts {
  std::string cpu;  // the processor's model name; "unknown" when the system does not tell
  int cores = 0;    // logical, as the system counts them
};
MachineFacts machine_facts();

/// Largest resident memory of this process so far, bytes.
std::int64_t peak_memory_bytes();

/// Version of demvof, with the source revision when it was known at configure time.
std::string version();

}  // namespace demvof
