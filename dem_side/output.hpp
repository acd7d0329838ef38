// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <mpi.h>

#include <filesystem>
#include <optional>

#include "coupler/output/vtk_series.hpp"
#include "coupler/transfer/averaging.hpp"
#include "dem_side/dem.hpp"
#include "dem_side/forces.hpp"

namespace demvof {

/// The particles, the surfaces that the script makes, and the bulk grid as series for ParaView.
class Output {
 public:
  /// continued_from: time from which an earlier run is continued, s. Collective.
  Output(const Dem& dem, const BulkGrid& grid, const std::filesystem::path& folder,
         std::optional<double> continued_from);

  /// Writes what the particles and the bulk cells are at the end of a window. fluids: what the window was
  /// simulated with. time, window: s. Collective.
  void write(double time, double window, const FluidForces& forces, const Averaging& averaging,
             const std::vector<CellValues<BulkFluid>>& fluids);

 private:
  const Dem& dem_;
  BulkGrid grid_;
  ParticleSeries particles_;
  std::optional<SurfaceSeries> surfaces_;
  BulkSeries bulk_;
};

}  // namespace demvof
