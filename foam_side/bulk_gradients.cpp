// SPDX-License-Identifier: GPL-3.0-or-later
// Derivatives of the fluid on the bulk grid, for the forces that need them. Acceleration and vorticity belong
// to the velocity and are averaged like it, with w = eps rho or 1 (bridge.cpp), so that density times
// acceleration is that of the mixture; the stress force is a force per volume like grad p, averaged with V.

#include "foam_side/bridge.hpp"
#include "foam_side/fine_mesh.hpp"
#include "foam_side/fluid_gradients.hpp"

namespace demvof {
namespace {

/// Sums over the fine cells of a bulk cell.
struct GradientSums {
  BulkFluidGradients weighted;
  double weight = 0, volume = 0;  // sum w V, sum V
};

}  // namespace

CellValues<BulkFluidGradients> Bridge::bulk_fluid_gradients() {
  const FluidGradients fine = fluid_gradients(flow_, parameters_.forces);
  const std::vector<double> weight = fine_weights();
  std::vector<GradientSums> sums(touched_.size());
  for (const Piece& piece : pieces_) {
    GradientSums& sum = sums[piece.slot];
    const double v = piece.volume, w = weight[piece.fine] * v;
    sum.weighted.stress_force += v * to_vec3(fine.stress_force[piece.fine]);
    sum.weighted.acceleration += w * to_vec3(fine.acceleration[piece.fine]);
    sum.weighted.vorticity += w * to_vec3(fine.vorticity[piece.fine]);
    sum.weight += w;
    sum.volume += v;
  }
  const CellValues<GradientSums> owned = remap_->cells().sum_to_owners(sums);
  CellValues<BulkFluidGradients> bulk;
  for (std::size_t i = 0; i < owned.cells.size(); ++i) {
    const GradientSums& sum = owned.values[i];
    if (!(sum.volume > 0)) continue;  // as in bulk_fluid
    Told& told = told_.values[bulk.cells.size()];
    bulk.cells.push_back(owned.cells[i]);
    bulk.values.push_back({sum.weighted.stress_force / sum.volume, sum.weighted.acceleration / sum.weight,
                           sum.weighted.vorticity / sum.weight});
    Vec3& acceleration = bulk.values.back().acceleration;
    const double omega = relaxation_[bulk.cells.size() - 1];
    if (omega < 1) acceleration = told.acceleration + omega * (acceleration - told.acceleration);
    told.acceleration = acceleration;
  }
  return bulk;
}

}  // namespace demvof
