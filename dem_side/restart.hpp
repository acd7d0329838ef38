// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "dem_side/dem.hpp"

namespace demvof {

/// LIGGGHTS's restart file of the state at the end of a window.
std::filesystem::path restart_file(const std::filesystem::path& run, long window);

/// Writes it, and beside it what tells whether a script has read it. steps: per window. Collective.
/// Throws std::runtime_error when a file cannot be written.
void write_particle_restart(const std::filesystem::path& run, long window, Dem& dem, int steps);

/// DEM steps per window of the run that is continued. Throws InputError when the script has not gone on from
/// its restart file. Collective.
int steps_of_continued(const std::filesystem::path& run, long window, const Dem& dem,
                       const std::string& script);

}  // namespace demvof
