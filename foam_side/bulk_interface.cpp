// SPDX-License-Identifier: GPL-3.0-or-later
// What phase interchange asks of the bridge. replacement: where the interface is on the bulk grid, and what
// one particle displaces on the fine mesh. volume_adding: how the particles' volume moves there.

#include <algorithm>
#include <cmath>

#include "coupler/base/sphere.hpp"
#include "coupler/transfer/kernel_weights.hpp"
#include "foam_side/bridge.hpp"
#include "foam_side/fine_mesh.hpp"

namespace demvof {

namespace {

// Change of alpha across a fine cell from which on it holds interface: wisps and round-off do not.
constexpr double least_change = 0.1;

}  // namespace

CellValues<BulkInterface> Bridge::bulk_interface() const {
  const tmp<volVectorField> gradient = fvc::grad(flow_.alpha);
  std::vector<BulkInterface> sums(touched_.size());
  for (const Piece& piece : pieces_) {
    const Vec3 steepness = to_vec3(gradient()[piece.fine]);
    if (norm(steepness) * std::cbrt(flow_.mesh.V()[piece.fine]) < least_change) continue;
    const double area = norm(steepness) * piece.volume;
    BulkInterface& sum = sums[piece.slot];
    sum.area += area;
    sum.position += area * to_vec3(flow_.mesh.C()[piece.fine]);
    sum.velocity += area * to_vec3(flow_.U[piece.fine]);
    sum.gradient += piece.volume * steepness;
  }
  const CellValues<BulkInterface> owned = remap_->cells().sum_to_owners(sums);
  CellValues<BulkInterface> holding;
  for (std::size_t i = 0; i < owned.cells.size(); ++i) {
    if (owned.values[i].area == 0) continue;
    holding.cells.push_back(owned.cells[i]);
    holding.values.push_back(owned.values[i]);
  }
  return holding;
}

double Bridge::density(int cell) const {
  if (!flow_.ghost) return flow_.rho[cell];
  const double alpha = flow_.alpha[cell];
  return alpha * flow_.mixture.rho1().value() + (1 - alpha) * flow_.mixture.rho2().value();
}

Foam::vectorField Bridge::solid_flux_density() const {
  std::vector<Vec3> totals(touched_.size());
  for (std::size_t slot = 0; slot < totals.size(); ++slot) {
    const BulkParticles& cell = touched_[slot];
    if (cell.drag_factor > 0)  // mean velocity of its particles, weighted with their drag factors
      totals[slot] = cell.solid_volume / cell.drag_factor * cell.drag_weighted_velocity;
  }
  std::vector<double> rows(3 * totals.size());
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i] = totals[i / 3][static_cast<int>(i % 3)];
  const std::vector<double> density = remap_->to_fine(rows, 3);
  Foam::vectorField result(flow_.mesh.nCells());
  forAll(result, cell) result[cell] = {density[3 * cell], density[3 * cell + 1], density[3 * cell + 2]};
  return result;
}

scalarField Bridge::solid_fraction_of(const Vec3& position, double volume) const {
  const double radius = std::cbrt(3 * volume / (4 * pi));
  KernelWeights weights = kernel_weights(grid_, parameters_.coupling.averaging, {position}, {radius});
  const std::vector<CellId>& touched = remap_->cells().cells();
  std::vector<int> place(weights.cells.size(), -1);  // in touched; -1: no cell of this rank is near
  std::vector<double> share(weights.cells.size(), 0.0);
  for (std::size_t i = 0; i < weights.cells.size(); ++i) {
    const auto found = std::lower_bound(touched.begin(), touched.end(), weights.cells[i]);
    if (found == touched.end() || *found != weights.cells[i]) continue;
    place[i] = static_cast<int>(found - touched.begin());
    share[i] = remap_->bulk_volume()[place[i]] / grid_.cell_volume();
  }
  for (double& s : share) Foam::reduce(s, Foam::maxOp<double>());
  count_open_shares(share, weights);

  std::vector<double> totals(touched.size(), 0.0);
  for (std::size_t entry = 0; entry < weights.weight.size(); ++entry) {
    const int slot = place[weights.slot[entry]];
    if (slot >= 0) totals[slot] += volume * weights.weight[entry];
  }
  const std::vector<double> fraction = remap_->to_fine(totals, 1);
  scalarField result(flow_.mesh.nCells());
  std::copy(fraction.begin(), fraction.end(), result.begin());
  return result;
}

scalarField Bridge::void_fraction_before() const {
  Spread then;
  scalarField eps(void_fraction_of(solid_volume_before_, then));
  for (const Droplet& droplet : droplets_) {
    const double volume = sphere_volume(droplet.radius);
    eps += droplet.sign * solid_fraction_of(droplet.position, volume);
  }
  return eps;
}

}  // namespace demvof
