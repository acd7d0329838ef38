// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "coupler/exchange/owed_pressure.hpp"
#include "coupler/output/results.hpp"
#include "foam_side/flow.hpp"
#include "foam_side/particles_to_fine.hpp"

namespace demvof {

/// Limits that acted, over the windows so far.
struct ActedLimits {
  long relieved_cells = 0, waiting_particles = 0, outside_particles = 0, negative_cells = 0;
  long full_cells = 0;
  long crossing_windows = 0;
  long soft_windows = 0;                            // with particles on springs that the drag outruns
  double holding_window = 0, mild_window = 0;       // s: the longest, the shortest
  OwedPressure::HeldBack held_back;                 // cells: over the windows; impulse: most in one
  ParticlesToFine::Beside beside;                   // likewise
  double drop_resolution = 1e9;                     // fewest cells per diameter
  double relieved_volume = 0, unplaced_volume = 0;  // m3
  double unplaced_left_over = 0;                    // N s
};

/// One line for every limit that acted in the run; counts are cells or particles times windows. gone_impulse:
/// that went with particles in the window in which they left, N s.
std::vector<std::string> run_warnings(const Flow& flow, const ActedLimits& limits, double gone_impulse,
                                      const std::vector<RunResults::ClosureUse>& closures);

}  // namespace demvof
