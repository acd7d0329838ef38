// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace demvof {

/// In the folder of a run.
constexpr const char* lock_file = ".lock";

/// One run, one folder: each of its programs holds its part of the lock file while it lives. The
/// kernel takes the lock from a process that ends, however it ends: there is none that is left over.
class RunLock {
 public:
  enum class Part : long { command = 0, fluid = 1, particles = 2 };  // bytes of the file

  /// Throws InputError when another process holds the part: it names the process. On a file system without
  /// locks nothing is held. The folder exists.
  RunLock(const std::filesystem::path& run, Part part);
  ~RunLock();
  RunLock(const RunLock&) = delete;
  RunLock& operator=(const RunLock&) = delete;

  /// Whether any other process holds a part: "process 4711 on host". From a process that holds a part itself
  /// only by this object (closing the file anywhere else in the process would give the lock back).
  std::optional<std::string> other_holder() const;

 private:
  std::optional<std::string> holder(long part) const;

  int file_ = -1;
};

}  // namespace demvof
