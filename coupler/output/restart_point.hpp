// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <filesystem>
#include <string>

#include "coupler/config/parameters.hpp"

namespace demvof {

/// A state that a run can be continued from: the end of a window of which both programs have written
/// everything.
///
///   <run>/restart/latest.json          this; replaced in one step, after the files below
///   <run>/restart/<window>/particles   LIGGGHTS's own restart file
///   <run>/restart/<window>/fluid.<rank>  what the time folder of the fluid case does not hold, CBOR
struct RestartPoint {
  long window = 0;           // windows done
  double time = 0;           // s
  std::string fluid_time;    // name of the time folder in the fluid case
  double window_length = 0;  // s
  std::array<int, 3> bulk_cells{};
  int fluid_ranks = 1;
};

/// Folder of the state at the end of a window.
std::filesystem::path restart_folder(const std::filesystem::path& run, long window);

/// Makes the state the latest one, and then removes the folders of those before it.
/// Throws std::runtime_error when it cannot be written.
void write_restart_point(const std::filesystem::path& run, const RestartPoint& point);

/// Moves a file of a run that is going to be continued out of the way: results.json becomes
/// earlier/results_1.json, or the next number that is free. Does nothing where there is no such file.
void keep_earlier(const std::filesystem::path& run, const std::string& file);

/// The latest state of a run, for the case as it is now: window, bulk grid and fluid ranks have to be
/// those of the run. Throws InputError when there is none, or it does not fit.
RestartPoint read_restart_point(const std::filesystem::path& run, const CaseParameters& parameters);

}  // namespace demvof
