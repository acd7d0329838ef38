// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/output/machine.hpp"

#include <sys/resource.h>

#include <fstream>
#include <thread>

namespace demvof {

MachineFacts machine_facts() {
  MachineFacts facts{"unknown", static_cast<int>(std::thread::hardware_concurrency())};
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);) {
    const auto colon = line.find(": ");
    if (line.rfind("model name", 0) == 0 && colon != std::string::npos) {
      facts.cpu = line.substr(colon + 2);
      break;
    }
  }
  return facts;
}

std::int64_t peak_memory_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return std::int64_t{usage.ru_maxrss} * 1024;  // Linux counts in KiB
}

std::string version() {
  const std::string revision = DEMVOF_REVISION;
  return revision.empty() ? DEMVOF_VERSION : DEMVOF_VERSION " (" + revision + ")";
}

}  // namespace demvof
