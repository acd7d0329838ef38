// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <mpi.h>

#include <filesystem>

#include "coupler/output/vtk_series.hpp"
#include "dem_side/averaging.hpp"
#include "dem_side/dem.hpp"
#include "dem_side/forces.hpp"

namespace demvof {

/// The particles and the bulk grid as series for ParaView: at the start, at every interval, at the end.
class Output {
 public:
  /// interval: s; 0: start and end only. Collective.
  Output(const Dem& dem, const BulkGrid& grid, const std::filesystem::path& folder, double interval);

  /// Writes what the particles and the bulk cells are at the end of a window, if its time has come or
  /// it is the last. fluid: what the window was simulated with. time, window: s. Collective.
  void write(double time, double window, bool last, const FluidForces& forces, const Averaging& averaging,
             const CellValues<BulkFluid>& fluid);

 private:
  const Dem& dem_;
  BulkGrid grid_;
  double interval_;
  long next_ = 0;
  ParticleSeries particles_;
  BulkSeries bulk_;
};

}  // namespace demvof
