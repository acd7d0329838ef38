// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "coupler/exchange/crossing.hpp"
#include "coupler/exchange/exchange_parameters.hpp"
#include "coupler/grid/bulk_cells.hpp"
#include "coupler/transfer/bulk_surface.hpp"
#include "coupler/transfer/bulk_walls.hpp"

namespace demvof {

/// What passes between the two programs in a run, and when. The fluid side makes it from its scene plan and
/// sends it after the handshake; nobody derives it anew.
struct WindowPlan {
  Schedule schedule = Schedule::staggered;
  int fluids = 1;           // 2: BulkSurface comes first; then one message for the liquid and one for the gas
  bool gradients = false;   // BulkFluidGradients follow BulkFluid
  bool mesh_moves = false;  // Openings come first in each window
  bool interface = false;   // BulkInterface follows them, and Droplet BulkParticles
  long windows = 0;         // from time 0 to the run's end; 0: not known
  long windows_before = 0;  // those to the time at which this run begins
  bool continues = false;   // an earlier run
  double window = 0;        // length of all, s; 0: each has its own, which the fluid says before it begins
  struct Steps {            // then times are counted in DEM steps
    double length = 0;      // of one, s
    long whole_run = 0, before = 0;
  } steps;
  double output_interval = 0;  // both sides write their state at its multiples, s; 0: at the end alone

  bool own_lengths() const { return window == 0; }
};

/// The fluid at the start of a window, on the active bulk cells; what the plan leaves out is not there.
struct FluidMessage {
  std::optional<Openings> openings;          // of a mesh that moves
  CellValues<BulkSurface> surface;           // with two fluids: where it is, and where it was before
  std::vector<CellValues<BulkFluid>> means;  // by fluid: liquid, gas
  std::vector<CellValues<BulkFluidGradients>> gradients;  // by fluid, or none
  std::optional<CellValues<BulkInterface>> interface;
};

/// What the particles did in a window.
struct ParticleMessage {
  std::vector<CellValues<BulkParticles>> sums;  // by fluid
  std::optional<CellValues<Droplet>> droplets;
};

}  // namespace demvof
