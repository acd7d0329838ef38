// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <memory>

#include "coupler/link/own_world.hpp"
#include "foam_side/openfoam.hpp"

namespace demvof {

/// From here on what OpenFOAM prints goes to the log file (rank 0; the other ranks are silent).
void send_output_to(const std::filesystem::path& log, int rank);
/// Throws RunError when not all of it has come there.
void require_whole_log();

/// OpenFOAM's view of a prepared case folder, parallel when this side has several ranks. Throws InputError
/// when the folder is not a prepared case or is decomposed for another number of ranks. The result is never
/// destroyed in a failing run: its destructor ends the program.
Foam::argList* open_case(const std::filesystem::path& folder, const OwnWorld& world);

}  // namespace demvof
