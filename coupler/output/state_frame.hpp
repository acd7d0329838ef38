// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "coupler/config/enum_names.hpp"
#include "coupler/config/parameters.hpp"
#include "coupler/grid/bulk_partition.hpp"
#include "coupler/output/restart_point.hpp"

namespace demvof {

/// What a state of this case belongs to.
inline StateFrame state_frame(const CaseParameters& parameters, int fluid_ranks) {
  StateFrame frame;
  frame.window_length = parameters.coupling.window;  // 0: each has its own
  frame.fluid_ranks = fluid_ranks;
  for (const auto& [schedule, name] : enum_names<Schedule>)
    if (schedule == parameters.coupling.schedule) frame.schedule = name;
  if (!parameters.bulk_grid) return frame;
  frame.bulk_lower = parameters.bulk_grid->lower;
  frame.bulk_upper = parameters.bulk_grid->upper;
  frame.bulk_cells = parameters.bulk_grid->cells;
  if (fluid_ranks > 0) frame.bulk_blocks = BulkPartition(frame.bulk_cells, fluid_ranks).blocks();
  return frame;
}

}  // namespace demvof
