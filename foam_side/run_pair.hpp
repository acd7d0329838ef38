// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "coupler/config/program_options.hpp"
#include "coupler/grid/bulk_grid.hpp"
#include "coupler/link/fluid_end.hpp"
#include "coupler/link/own_world.hpp"
#include "coupler/output/restart_point.hpp"
#include "foam_side/run_record.hpp"

namespace demvof {

/// The fluid's windows beside the particles, from the start or from where an earlier run has ended, to the
/// plan's end or until one side asks for a stop. Collective over the fluid side.
RunStatus run_pair(Flow& flow, const ProgramOptions& options, const CaseParameters& parameters,
                   const RestartPoint* start, const BulkGrid& grid, FluidEnd& link, const OwnWorld& world,
                   RunRecord& record);

}  // namespace demvof
