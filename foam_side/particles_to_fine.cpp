// SPDX-License-Identifier: GPL-3.0-or-later
// From the bulk grid to the fine mesh (paper, section 6; docs/theory.md).
//
//   force_f V_f = sum_b F_b w_f V_fb / W_b,   W_b = sum_f w_f V_fb      w: sharing_weights.hpp
//
// The velocity that the particles feel may differ from the mean that the implicit part of the force works on,
// sum w V u_f / W (a linear profile in the fine cells, a value at a point: fluid_to_bulk.cpp); the difference
// is taken from its reference:
//
//   F_b = -J/dt + C (u_ref - (u_told - u_mean) - u)
//
// and a steady state is still not shifted by it. Impulses are exchanged by pieces with every mapping.

#include "foam_side/particles_to_fine.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "coupler/base/errors.hpp"
#include "coupler/base/sphere.hpp"
#include "coupler/exchange/momentum_exchange.hpp"
#include "coupler/transfer/kernel_weights.hpp"
#include "foam_side/fine_mesh.hpp"
#include "foam_side/sharing_weights.hpp"

namespace demvof {

namespace {

// Below this the drag and pressure terms of the porous equations lose their meaning (closest packing
// of spheres of one size leaves 0.26).
constexpr double smallest_void_fraction = 0.05;

}  // namespace

ParticlesToFine::ParticlesToFine(Flow& flow, const BulkCut& cut, const CouplingParameters& coupling)
    : flow_(flow), cut_(cut), coupling_(coupling) {
  distribute();
}

void ParticlesToFine::take(CellValues<BulkParticles> particles, CellValues<Vec3> felt_shift) {
  particles_ = std::move(particles);
  felt_shift_ = std::move(felt_shift);
  solid_volume_before_ = std::move(solid_volume_);
  solid_volume_ = {particles_.cells, std::vector<double>(particles_.values.size())};
  for (std::size_t i = 0; i < particles_.values.size(); ++i)
    solid_volume_.values[i] = particles_.values[i].solid_volume;
  distribute();
}

void ParticlesToFine::go_on_from(CellValues<BulkParticles> particles, CellValues<Vec3> felt_shift) {
  particles_ = std::move(particles);
  felt_shift_ = std::move(felt_shift);
  distribute();
}

void ParticlesToFine::distribute() {
  const TouchedCells& cells = cut_.cells();
  touched_ = cells.fetch_from_owners(particles_, BulkParticles{});
  if (cut_.shifts_velocity()) felt_shift_here_ = cells.fetch_from_owners(felt_shift_, Vec3{});
  coefficient_part_.assign(cut_.pieces().size(), 0.0);
}

scalarField ParticlesToFine::void_fraction_of(const CellValues<double>& solid_volume, Spread& spread) const {
  const std::vector<double> solid_fraction =
      cut_.remap().to_fine(cut_.cells().fetch_from_owners(solid_volume, 0.0), 1);
  scalarField eps(flow_.mesh.nCells());
  spread = {};
  forAll(eps, cell) {
    spread.negative_cells += solid_fraction[cell] < 0;
    eps[cell] = 1 - std::max(solid_fraction[cell], 0.0);
    spread.solid_volume += (1 - eps[cell]) * flow_.mesh.V()[cell];
    if (eps[cell] >= smallest_void_fraction) continue;
    const vector& at = flow_.mesh.C()[cell];
    throw RunError(fmt::format(
        "void fraction {:.3g} in the fine cell at ({:.5g} {:.5g} {:.5g}) m leaves no room for the fluid "
        "(smallest possible: {}). Try a coarser bulk_grid, a larger coupling.averaging.width or a smaller "
        "coupling.averaging.maximum_solid_fraction.",
        eps[cell], at.x(), at.y(), at.z(), smallest_void_fraction));
  }
  Foam::reduce(spread.solid_volume, Foam::sumOp<double>());
  Foam::reduce(spread.negative_cells, Foam::sumOp<long>());
  return eps;
}

scalarField ParticlesToFine::void_fraction_before() const {
  Spread then;
  scalarField eps(void_fraction_of(solid_volume_before_, then));
  for (const Droplet& droplet : droplets_) {
    const double volume = sphere_volume(droplet.radius);
    eps += droplet.sign * solid_fraction_of(droplet.position, volume);
  }
  return eps;
}

scalarField ParticlesToFine::solid_fraction_of(const Vec3& position, double volume) const {
  const double radius = std::cbrt(3 * volume / (4 * pi));
  KernelWeights weights = kernel_weights(cut_.grid(), coupling_.averaging, {position}, {radius});
  const std::vector<CellId>& touched = cut_.cells().cells();
  std::vector<int> place(weights.cells.size(), -1);  // in touched; -1: no cell of this rank is near
  std::vector<double> share(weights.cells.size(), 0.0);
  for (std::size_t i = 0; i < weights.cells.size(); ++i) {
    const auto found = std::lower_bound(touched.begin(), touched.end(), weights.cells[i]);
    if (found == touched.end() || *found != weights.cells[i]) continue;
    place[i] = static_cast<int>(found - touched.begin());
    share[i] = cut_.remap().bulk_volume()[place[i]] / cut_.grid().cell_volume();
  }
  for (double& s : share) Foam::reduce(s, Foam::maxOp<double>());
  count_open_shares(share, weights);

  std::vector<double> totals(touched.size(), 0.0);
  for (std::size_t entry = 0; entry < weights.weight.size(); ++entry) {
    const int slot = place[weights.slot[entry]];
    if (slot >= 0) totals[slot] += volume * weights.weight[entry];
  }
  const std::vector<double> fraction = cut_.remap().to_fine(totals, 1);
  scalarField result(flow_.mesh.nCells());
  std::copy(fraction.begin(), fraction.end(), result.begin());
  return result;
}

Foam::vectorField ParticlesToFine::solid_flux_density() const {
  std::vector<Vec3> totals(touched_.size());
  for (std::size_t slot = 0; slot < totals.size(); ++slot) {
    const BulkParticles& cell = touched_[slot];
    if (cell.drag_factor > 0)  // mean velocity of its particles, weighted with their drag factors
      totals[slot] = cell.solid_volume / cell.drag_factor * cell.drag_weighted_velocity;
  }
  std::vector<double> rows(3 * totals.size());
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i] = totals[i / 3][static_cast<int>(i % 3)];
  const std::vector<double> density = cut_.remap().to_fine(rows, 3);
  Foam::vectorField result(flow_.mesh.nCells());
  forAll(result, cell) result[cell] = {density[3 * cell], density[3 * cell + 1], density[3 * cell + 2]};
  return result;
}

void ParticlesToFine::spread_sources() {
  const std::vector<Piece>& pieces = cut_.pieces();
  const std::vector<double> weight = sharing_weights(flow_, coupling_.sharing);
  std::vector<double> total(touched_.size());  // sum w V over the fine cells of a bulk cell
  for (const Piece& piece : pieces) total[piece.slot] += weight[piece.fine] * piece.volume;
  total = cut_.cells().fetch_from_owners(cut_.cells().sum_to_owners(total), 0.0);
  std::vector<FluidSource> sources(touched_.size());
  for (std::size_t slot = 0; slot < sources.size(); ++slot) {
    sources[slot] = fluid_source(coupling_.exchange, touched_[slot], coupling_.window);
    if (cut_.shifts_velocity()) sources[slot].reference_velocity -= felt_shift_here_[slot];
  }

  ParticleSource& source = *flow_.source;
  source.force = Foam::dimensionedVector(source.force.dimensions(), Foam::Zero);
  source.coefficient = dimensionedScalar(source.coefficient.dimensions(), Foam::Zero);
  source.reference = Foam::dimensionedVector(source.reference.dimensions(), Foam::Zero);
  const auto& volume = flow_.mesh.V();
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const Piece& piece = pieces[i];
    const FluidSource& bulk = sources[piece.slot];
    const double share = weight[piece.fine] * piece.volume / (total[piece.slot] * volume[piece.fine]);
    coefficient_part_[i] = share * bulk.coefficient;
    source.force[piece.fine] += share * to_foam(bulk.explicit_force);
    source.coefficient[piece.fine] += coefficient_part_[i];
    source.reference[piece.fine] += coefficient_part_[i] * to_foam(bulk.reference_velocity);
  }
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const double whole = source.coefficient[pieces[i].fine];
    coefficient_part_[i] = whole > 0 ? coefficient_part_[i] / whole : 0;
  }
  forAll(source.coefficient, cell) if (source.coefficient[cell] > 0) source.reference[cell] /=
      source.coefficient[cell];
}

CellValues<Vec3> ParticlesToFine::collect_impulse() {
  volVectorField::Internal& given = flow_.source->implicit_impulse;
  const auto& volume = flow_.mesh.V();
  forAll(given, cell) collected_sum_ += volume[cell] * to_vec3(given[cell]);
  CellValues<Vec3> taken;
  if (hands_back_left_over(coupling_.exchange)) {
    const std::vector<Piece>& pieces = cut_.pieces();
    std::vector<Vec3> impulse(touched_.size());
    for (std::size_t i = 0; i < pieces.size(); ++i)
      impulse[pieces[i].slot] -=
          coefficient_part_[i] * volume[pieces[i].fine] * to_vec3(given[pieces[i].fine]);
    taken = cut_.cells().sum_to_owners(impulse);
  }
  given = Foam::dimensionedVector(given.dimensions(), Foam::Zero);
  return taken;
}

void ParticlesToFine::end_window() {
  implicit_impulse_ = std::exchange(collected_sum_, Vec3{});
}

ParticlesToFine::Impulses ParticlesToFine::impulses() const {
  const ParticleSource& source = *flow_.source;
  vector explicit_force = vector::zero, implicit_impulse = to_foam(implicit_impulse_);
  forAll(source.force, cell) explicit_force += flow_.mesh.V()[cell] * source.force[cell];
  Foam::reduce(explicit_force, Foam::sumOp<vector>());
  Foam::reduce(implicit_impulse, Foam::sumOp<vector>());
  return {coupling_.window * to_vec3(explicit_force), to_vec3(implicit_impulse)};
}

}  // namespace demvof
