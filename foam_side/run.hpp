// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "coupler/config/program_options.hpp"
#include "coupler/link/own_world.hpp"

namespace demvof {

/// One run of the fluid side, from the case file to results.json. Returns the exit code.
/// Throws as guarded_main expects: InputError, PartnerLost, SolverStopped, RunError.
int run_fluid(const ProgramOptions& options, const OwnWorld& world);

}  // namespace demvof
