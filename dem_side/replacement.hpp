// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <mpi.h>

#include <functional>
#include <vector>

#include "coupler/exchange/crossing.hpp"
#include "coupler/grid/bulk_cells.hpp"
#include "coupler/grid/bulk_partition.hpp"
#include "coupler/transfer/fluid_at_particle.hpp"
#include "dem_side/dem.hpp"

namespace demvof {

/// Phase interchange `replacement` [43]: which particles are liquid on the fine mesh. A particle that hits
/// the interface (crossing.hpp) is replaced; once no interface is left in its bulk cells, on whichever
/// side, it takes its place back. In between it moves and is dragged as ever, but displaces nothing: its
/// volume is the liquid's. Calls with a communicator behind them are collective over dem_side.
class Replacement {
 public:
  /// Before the DEM is set up. least_speed: delta_C, m/s.
  Replacement(Dem& dem, double least_speed);

  /// Decides at the start of a window. seen: the interface at each local particle, sampled with the
  /// weights of its bulk cells; liquid: what of the liquid it feels. window: s. A drop starts with the
  /// velocity that it and its particle come to when they stick together, v m/(m + rho_1 V): its momentum
  /// comes out of the particle's.
  void begin_window(const std::function<BulkInterface(int)>& seen,
                    const std::function<FluidAtParticle(int)>& liquid, double window);

  /// What begin_window decided, brought to the owners of the bulk cells.
  CellValues<Droplet> droplets(const BulkGrid& grid, const BulkPartition& partition) const;

  /// Takes the solid volume of local particle i out of what it gives to the bulk grid if it is replaced;
  /// returns that, m3.
  double leave_out_replaced(int i, BulkParticles& contribution) const;

 private:
  Dem& dem_;
  double least_speed_;
  std::vector<Droplet> decided_;  // at the start of this window, local particles
};

}  // namespace demvof
