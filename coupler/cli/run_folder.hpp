// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "coupler/config/parameters.hpp"
#include "coupler/output/restart_point.hpp"
#include "coupler/output/run_lock.hpp"

namespace demvof {

/// The folder of one run: what is in it already, and what may be done to it.
class RunFolder {
 public:
  /// path: --out, or empty for `run` beside the case file.
  RunFolder(const CaseParameters& parameters, const std::filesystem::path& path);

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path fluid() const { return path_ / "fluid"; }
  std::filesystem::path prepare_log() const { return path_ / "prepare.log"; }

  /// Holds the prepared fluid case of these parameters, made after the last change of the original,
  /// and nothing of a run.
  bool ready() const;
  /// Throws InputError unless the run in the folder can go on with these parameters: it is that of the same
  /// fluid case, and has left a state that fits and is whole.
  /// from: after so many windows; absent: the latest. It may be divided for another number of fluid ranks.
  struct Continuable {
    RestartPoint point;
    std::vector<std::string> changes;  // in the case since, one key per line
  };
  Continuable require_continuable(std::optional<long> from) const;
  /// Makes the folder, or empties it of an earlier run. Throws InputError rather than lose data: when
  /// it holds something else, when it is where the case itself lives, or when it holds results or another
  /// preparation and force is false.
  void clear(bool force) const;
  /// Throws InputError when the solvers cannot name it.
  void require_name() const;
  /// Takes the folder for this process until its end. Throws InputError when a run is going on in it.
  void hold() const;
  /// Waits until no program of a run holds the folder any more, s at most.
  void wait_for_programs(double seconds) const;
  /// Marks the preparation as done.
  void mark_ready() const;

 private:
  bool has_results() const;
  std::string preparation(int ranks) const;

  const CaseParameters& parameters_;
  std::filesystem::path path_;
  mutable std::optional<RunLock> lock_;
};

}  // namespace demvof
