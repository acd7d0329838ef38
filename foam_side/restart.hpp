// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

#include "coupler/config/program_options.hpp"
#include "coupler/link/fluid_end.hpp"
#include "coupler/output/restart_point.hpp"
#include "foam_side/bridge.hpp"
#include "foam_side/run_record.hpp"

namespace demvof {

/// Windows of their own lengths, DEM steps: of the last one, and what the next one may have.
struct WindowSteps {
  long last = 0, next = 0;
};

/// The state at the end of a window, from which the run can be continued: the fields; what their folder does
/// not hold, one file per rank in restart_folder(); and when dem_side has written its part, too, that this is
/// the latest state. Collective. Throws RunError on all ranks when a file cannot be written on any.
void write_state(const std::filesystem::path& run, const CaseParameters& parameters, long window, Flow& flow,
                 const Bridge& bridge, const RunRecord& record, const WindowSteps& steps, FluidEnd& link,
                 const OwnWorld& world);

/// Where the run goes on, its files of this rank as they were written. Throws InputError otherwise.
RestartPoint open_state(const ProgramOptions& options, const CaseParameters& parameters,
                        const OwnWorld& world);

/// What the time folder does not hold, of this rank; of states that another number of ranks has left, or
/// owners of other bulk cells, its part of all. Throws InputError when a file is not what was written.
nlohmann::json read_fluid_restart(const std::filesystem::path& run, const RestartPoint& point,
                                  const Flow& flow, const BulkPartition& mine, const OwnWorld& world);

/// The surface as the particles of that state know it: with it the run goes on. Throws InputError.
CellValues<BulkSurface> seen_surface(const nlohmann::json& state);
/// And what the mesh leaves of the bulk grid.
OpeningsToBulk::State seen_openings(const nlohmann::json& state);

/// Gives it to a flow that open_flow has made from the time folder. particles: dem_side's first report.
/// Throws InputError.
WindowSteps go_on_from(const nlohmann::json& state, long window, Flow& flow, Bridge& bridge,
                       RunRecord& record, const ParticleReport& particles);

}  // namespace demvof
