// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "coupler/base/vec3.hpp"
#include "coupler/output/machine.hpp"
#include "coupler/output/state_files.hpp"

namespace demvof {

/// What a state of a run belongs to: a run that goes on from it has to have the same.
struct StateFrame {
  double window_length = 0;  // s; 0: windows have their own lengths
  Vec3 bulk_lower, bulk_upper;
  std::array<int, 3> bulk_cells{};
  int fluid_ranks = 1;  // for which its fluid case is divided; 0, where it is asked for: any
  std::array<int, 3>
      bulk_blocks{};     // whose owners wrote fluid.<rank>; 0: by demvof of before blocks; may change
  std::string schedule;  // what one side still owes the other is of another window; empty: not known
};

/// A state that a run can be continued from: the end of a window of which both programs have written
/// everything.
///
///   <run>/restart/<window>/particles     LIGGGHTS's own restart file
///   <run>/restart/<window>/fluid.<rank>  what the time folder of the fluid case does not hold, CBOR
///   <run>/restart/<window>/state.json    this; written when the files above and the fluid's time folder are
///                                        on the disk, with the size and the checksum of each
///   <run>/restart/latest.json            a copy of the newest state.json; replaced in one step after it
struct RestartPoint {
  long window = 0;         // windows done
  double time = 0;         // s
  std::string fluid_time;  // name of the time folder in the fluid case
  StateFrame frame;
  std::string configuration;  // of the run, JSON text
  StateFiles files;
  std::string written_by = version();  // of demvof
  std::string checksum = {};           // of all this; set by reading
};

/// Folder of the state at the end of a window.
std::filesystem::path restart_folder(const std::filesystem::path& run, long window);

/// Makes the state the latest one, and then removes all but the newest ones, kept in number; what is later
/// than this one belongs to a course that the run has not taken. Throws std::runtime_error when it cannot be
/// written.
void write_restart_point(const std::filesystem::path& run, const RestartPoint& point, int kept);

/// Moves a file of a run that is going to be continued out of the way: results.json becomes
/// earlier/results_1.json, or the next number that is free. Does nothing where there is no such file.
void keep_earlier(const std::filesystem::path& run, const std::string& file);

/// The latest state of a run, or that after a number of windows. Throws InputError when there is none, it
/// has been changed, it belongs to another frame, or there is nothing left to do before end_time.
RestartPoint read_restart_point(const std::filesystem::path& run, std::optional<long> window,
                                const StateFrame& now, double end_time);

/// Throws InputError when a wanted file of the state is not as it was written; it names the file, and the
/// newest state that is whole.
void require_whole(const std::filesystem::path& run, const RestartPoint& point,
                   const std::function<bool(const std::string& name)>& wanted);

/// From here on this state is the latest: those after it are given up.
void go_back_to(const std::filesystem::path& run, const RestartPoint& point);

/// "coupling.schedule: staggered, now concurrent": the keys of the case that are not as they were, one by
/// one. Both as JSON text.
std::vector<std::string> changed_keys(const std::string& before, const std::string& now);

}  // namespace demvof
