// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "coupler/closures/force_parameters.hpp"
#include "coupler/exchange/crossing.hpp"
#include "coupler/exchange/exchange_parameters.hpp"
#include "foam_side/bulk_cut.hpp"
#include "foam_side/flow.hpp"
#include "foam_side/sample_fluid.hpp"

namespace demvof {

/// The fluid of the fine mesh on the active bulk cells. All calls are collective over the fluid side and
/// return cells owned by this rank.
class FluidToBulk {
 public:
  FluidToBulk(const Flow& flow, const BulkCut& cut, const ForceParameters& forces, Sharing sharing);

  /// When the mesh has been cut anew.
  void renew();

  /// left_over is not filled in. shift: velocity told minus the mean that the exchange works on, m/s.
  CellValues<BulkFluid> means(CellValues<Vec3>& shift) const;

  /// Derivatives, for the forces that need them (need_gradients), on the same cells.
  CellValues<BulkFluidGradients> gradients() const;

  /// The interface, in the cells that hold one (phase interchange `replacement`).
  CellValues<BulkInterface> interface() const;

 private:
  void sample_points(const Foam::vectorField& gradient, const scalarField& viscosity,
                     CellValues<BulkFluid>& fluid) const;

  const Flow& flow_;
  const BulkCut& cut_;
  ForceParameters forces_;
  Sharing sharing_;
  std::unique_ptr<FluidSampler> sampler_;  // only for a mapping to the bulk grid that takes values at points
};

}  // namespace demvof
