// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "coupler/config/parameters.hpp"
#include "coupler/config/program_options.hpp"
#include "coupler/link/own_world.hpp"
#include "coupler/output/restart_point.hpp"
#include "dem_side/dem.hpp"

namespace demvof {

/// LIGGGHTS's restart file of the state at the end of a window.
std::filesystem::path restart_file(const std::filesystem::path& run, long window);

/// Writes it, and beside it what tells whether a script has read it; rank 0 returns these files. steps: per
/// window. Collective. Throws std::runtime_error when a file cannot be written.
StateFiles write_particle_restart(const std::filesystem::path& run, long window, Dem& dem, int steps);

/// Where the run goes on, its files of the particles as they were written. Throws InputError otherwise.
RestartPoint open_state(const ProgramOptions& options, const CaseParameters& parameters,
                        const OwnWorld& world);

/// What LIGGGHTS's restart file does not hold.
struct LastParticles {
  int steps;  // DEM steps per window
  RandomStates random;
};
/// Throws InputError when the script has not gone on from its restart file. Collective.
LastParticles read_particle_restart(const std::filesystem::path& run, long window, const Dem& dem,
                                    const std::string& script);

}  // namespace demvof
