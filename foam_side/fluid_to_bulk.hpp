// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "coupler/closures/force_parameters.hpp"
#include "coupler/exchange/crossing.hpp"
#include "coupler/exchange/exchange_parameters.hpp"
#include "foam_side/bulk_cut.hpp"
#include "foam_side/flow.hpp"
#include "foam_side/sample_fluid.hpp"
#include "foam_side/surface_to_bulk.hpp"

namespace demvof {

/// The fluid of the fine mesh on the active bulk cells. All calls are collective over the fluid side and
/// return cells owned by this rank.
class FluidToBulk {
 public:
  FluidToBulk(Flow& flow, const BulkCut& cut, const SurfaceToBulk& surface, const ForceParameters& forces,
              Sharing sharing);

  /// When the mesh has been cut anew.
  void renew();

  /// One of the fluids on the active bulk cells that hold it.
  struct Means {
    CellValues<BulkFluid> fluid;       // left_over is not filled in
    std::vector<Vec3> shift;           // velocity told minus the mean that the exchange works on, m/s
    std::vector<double> fluid_volume;  // of fluid k between the particles, m3
  };
  std::vector<Means> means() const;  // liquid, gas; or one fluid

  /// Derivatives, for the forces that need them (need_gradients), on the same cells.
  std::vector<CellValues<BulkFluidGradients>> gradients() const;

  /// The interface, in the cells that hold one (phase interchange `replacement`).
  CellValues<BulkInterface> interface() const;

 private:
  void sample_points(const Foam::vectorField& gradient, const scalarField& viscosity, Means& means) const;

  Flow& flow_;
  const BulkCut& cut_;
  const SurfaceToBulk& surface_;
  ForceParameters forces_;
  Sharing sharing_;
  std::unique_ptr<FluidSampler> sampler_;  // only for a mapping to the bulk grid that takes values at points
};

}  // namespace demvof
