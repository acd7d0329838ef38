// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "coupler/output/restart_point.hpp"
#include "foam_side/bridge.hpp"
#include "foam_side/run_record.hpp"

namespace demvof {

// What the time folder of the fluid case does not hold: one file per rank in restart_folder().

/// Writes it. Call at the end of a window, on every rank, when the time folder has been written.
/// Throws std::runtime_error when a file cannot be written.
void write_fluid_restart(const std::filesystem::path& run, long window, const Flow& flow,
                         const ForceParameters& forces, const Bridge& bridge, const RunRecord& record);

/// Reads it into a flow that open_flow has made from the time folder. particles: dem_side's first report.
/// Throws InputError when a file is not there or not what was written.
void read_fluid_restart(const std::filesystem::path& run, long window, Flow& flow, Bridge& bridge,
                        RunRecord& record, const ParticleReport& particles);

}  // namespace demvof
