// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "coupler/exchange/crossing.hpp"
#include "coupler/exchange/exchange_parameters.hpp"
#include "coupler/grid/bulk_cells.hpp"

namespace demvof {

/// What passes between the two programs in a run, and when. The fluid side makes it from its scene plan and
/// sends it after the handshake; nobody derives it anew.
struct WindowPlan {
  Schedule schedule = Schedule::staggered;
  bool gradients = false;      // BulkFluidGradients follow BulkFluid
  bool interface = false;      // BulkInterface follows them, and Droplet BulkParticles
  long windows = 0;            // of the whole run
  long windows_before = 0;     // done by the run that this one continues
  double window = 0;           // length, s
  double output_interval = 0;  // both sides write their state at its multiples, s; 0: at the end alone
};

/// The fluid at the start of a window, on the active bulk cells; what the plan leaves out is not there.
struct FluidMessage {
  CellValues<BulkFluid> means;
  std::optional<CellValues<BulkFluidGradients>> gradients;
  std::optional<CellValues<BulkInterface>> interface;
};

/// What the particles did in a window.
struct ParticleMessage {
  CellValues<BulkParticles> sums;
  std::optional<CellValues<Droplet>> droplets;
};

}  // namespace demvof
