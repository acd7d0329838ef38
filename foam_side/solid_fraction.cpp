// SPDX-License-Identifier: GPL-3.0-or-later
// Solid fraction of the fine mesh, from the solid volume of the bulk cells (docs/theory.md).
//
// Where the surface cuts a bulk cell, what is wet is in the liquid and what is dry in the gas; a cell of one
// fluid has the profile of coupling.mapping.to_fine, and one goes over into the other.

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "coupler/base/sphere.hpp"
#include "coupler/exchange/solid_in_fluids.hpp"
#include "coupler/transfer/fluid_weights.hpp"
#include "foam_side/fine_mesh.hpp"
#include "foam_side/particles_to_fine.hpp"

namespace demvof {
namespace {

// Below this the drag and pressure terms of the porous equations lose their meaning (closest packing
// of spheres of one size leaves 0.26).
constexpr double smallest_void_fraction = 0.05;
constexpr double round_off = 1e-13;  // of a solid fraction

/// The fluid that most of a cut bulk cell is full of.
int main_fluid(const std::vector<double>& liquid, const std::vector<double>& gas, int slot) {
  return liquid[slot] >= gas[slot] ? 0 : 1;
}

}  // namespace

CellValues<double> solid_volume(const CellValues<BulkParticles>& particles) {
  CellValues<double> volume{particles.cells, {}};
  for (const BulkParticles& cell : particles.values) volume.values.push_back(cell.solid_volume);
  return volume;
}

/// Per subcell of cut cells, -: of `rise`, the slope that the bulk cell would have without the surface, what
/// is in the fluid that most of it is full of, about the middle of that one, so that each fluid keeps its
/// solid; less and less of it towards a cell half full. A surface that comes or goes then takes the profile
/// away, or brings it, as slowly as it moves: at once, the fluid would have to move within a window.
/// Elsewhere rise stays.
void ParticlesToFine::keep_in_main_fluid(std::vector<double>& rise, const std::vector<double>& mean,
                                         const std::vector<SolidInFluids>& inside,
                                         const std::vector<double>& liquid,
                                         const std::vector<double>& gas) const {
  const std::vector<Subcell>& subcells = cut_.remap().subcells();
  std::vector<double> middle(mean.size(), 0.0);
  const auto amount = [&](const Subcell& subcell) {
    return surface_.share(main_fluid(liquid, gas, subcell.slot), subcell) * subcell.volume;
  };
  for (std::size_t i = 0; i < subcells.size(); ++i)
    if (surface_.is_cut(subcells[i].slot)) middle[subcells[i].slot] += amount(subcells[i]) * rise[i];
  middle = cut_.cells().fetch_from_owners(cut_.cells().sum_to_owners(middle), 0.0);
  for (std::size_t i = 0; i < subcells.size(); ++i) {
    const int slot = subcells[i].slot, k = main_fluid(liquid, gas, slot);
    if (!surface_.is_cut(slot)) continue;
    const double most = std::max(liquid[slot], gas[slot]),
                 solid = k == 0 ? inside[slot].liquid : inside[slot].gas;
    const double here = middle[slot] / most;
    const double part = mean[slot] == 0 ? 0
                                        : (2 * most / (liquid[slot] + gas[slot]) - 1) *
                                              std::min(1.0, solid / (mean[slot] + std::max(here, 0.0)));
    rise[i] = part * surface_.share(k, subcells[i]) * (rise[i] - here);
  }
}

/// volumes: solid volume by fluid and touched cell, m3.
ParticlesToFine::SolidInSubcells ParticlesToFine::solid_in_subcells(
    const std::vector<std::vector<double>>& volumes) const {
  const std::vector<Subcell>& subcells = cut_.remap().subcells();
  const std::vector<double>& room = cut_.remap().bulk_volume();
  const bool two = volumes.size() == 2;
  std::vector<double> mean(room.size(), 0.0);
  for (std::size_t slot = 0; slot < room.size(); ++slot)
    if (room[slot] > 0) mean[slot] = (volumes[0][slot] + (two ? volumes[1][slot] : 0)) / room[slot];
  std::vector<double> rise = cut_.remap().rises(subcells, mean, 1, Remap::Slope::limited);
  std::vector<SolidInFluids> inside(two ? room.size() : 0);
  std::vector<double> liquid, gas;
  if (two) {
    liquid = surface_.volumes(0), gas = surface_.volumes(1);
    for (std::size_t slot = 0; slot < inside.size(); ++slot)
      if (surface_.is_cut(static_cast<int>(slot)) && mean[slot] > 0)
        inside[slot] = solid_in_fluids(volumes[0][slot], volumes[1][slot], liquid[slot], gas[slot],
                                       coupling_.averaging.maximum_solid_fraction);
    keep_in_main_fluid(rise, mean, inside, liquid, gas);
  }
  SolidInSubcells solid;
  solid.by_fluid.assign(volumes.size(), std::vector<double>(subcells.size(), 0.0));
  for (std::size_t i = 0; i < subcells.size(); ++i) {
    const Subcell& subcell = subcells[i];
    const int slot = subcell.slot;
    if (two && surface_.is_cut(slot)) {
      const std::array<double, 2> in = {inside[slot].liquid, inside[slot].gas};
      for (int k = 0; k < 2; ++k) solid.by_fluid[k][i] = subcell.volume * surface_.share(k, subcell) * in[k];
      solid.by_fluid[main_fluid(liquid, gas, slot)][i] += subcell.volume * rise[i];
      if (mean[slot] > 0) solid.moved += inside[slot].moved * subcell.volume / room[slot];
    } else if (mean[slot] > 0) {
      for (std::size_t k = 0; k < volumes.size(); ++k)
        solid.by_fluid[k][i] =
            subcell.volume * (mean[slot] + rise[i]) * volumes[k][slot] / (mean[slot] * room[slot]);
    }
  }
  return solid;
}

/// volumes: solid volume by fluid and touched cell, m3.
std::vector<double> ParticlesToFine::solid_fraction(const std::vector<std::vector<double>>& volumes) {
  if (volumes.size() == 1) return cut_.remap().to_fine(volumes[0], 1);
  surface_.look();
  const std::vector<double>& room = cut_.remap().bulk_volume();
  std::vector<double> whole(room.size());
  std::vector<char> flat(room.size());
  for (std::size_t slot = 0; slot < whole.size(); ++slot) {
    whole[slot] = volumes[0][slot] + volumes[1][slot];
    flat[slot] = surface_.is_cut(static_cast<int>(slot));
  }
  std::vector<double> fraction = cut_.remap().to_fine(whole, 1, flat);
  const SolidInSubcells solid = solid_in_subcells(volumes);  // in cut cells in place of their mean
  const std::vector<Subcell>& subcells = cut_.remap().subcells();
  for (std::size_t i = 0; i < subcells.size(); ++i) {
    const Subcell& subcell = subcells[i];
    if (!flat[subcell.slot] || whole[subcell.slot] == 0) continue;
    fraction[subcell.fine] += (solid.by_fluid[0][i] + solid.by_fluid[1][i] -
                               subcell.volume * whole[subcell.slot] / room[subcell.slot]) /
                              flow_.mesh.V()[subcell.fine];
  }
  spread_.moved_volume += solid.moved;
  return fraction;
}

std::vector<std::vector<double>> ParticlesToFine::solid_volumes(double part) const {
  std::vector<std::vector<double>> volumes;
  for (std::size_t k = 0; k < state_.size(); ++k) {
    std::vector<double> here;
    for (const BulkParticles& cell : touched_[k]) here.push_back(cell.solid_volume);
    if (part < 1) {
      const std::vector<double> then = cut_.cells().fetch_from_owners(state_[k].before, 0.0);
      for (std::size_t slot = 0; slot < here.size(); ++slot)
        here[slot] = (1 - part) * then[slot] + part * here[slot];
    }
    volumes.push_back(std::move(here));
  }
  return volumes;
}

scalarField ParticlesToFine::void_fraction(double part) {
  spread_ = {};
  const std::vector<double> solid = solid_fraction(solid_volumes(part));
  scalarField eps(flow_.mesh.nCells());
  forAll(eps, cell) {
    spread_.negative_cells += solid[cell] < -round_off;
    eps[cell] = 1 - std::max(solid[cell], 0.0);
    spread_.full_cells += eps[cell] < smallest_void_fraction;
    eps[cell] = std::max(eps[cell], smallest_void_fraction);
    spread_.solid_volume += (1 - eps[cell]) * flow_.mesh.V()[cell];
  }
  Foam::reduce(spread_.solid_volume, Foam::sumOp<double>());
  Foam::reduce(spread_.negative_cells, Foam::sumOp<long>());
  Foam::reduce(spread_.full_cells, Foam::sumOp<long>());
  Foam::reduce(spread_.moved_volume, Foam::sumOp<double>());
  for (const Droplet& droplet : droplets_)
    if (part < 1)
      eps += (1 - part) * droplet.sign * solid_fraction_of(droplet.position, sphere_volume(droplet.radius));
  return eps;
}

scalarField ParticlesToFine::solid_fraction_of(const Vec3& position, double volume) const {
  const double radius = std::cbrt(3 * volume / (4 * pi));
  const KernelWeights weights = kernel_weights(cut_.grid(), coupling_.averaging, {position}, {radius});
  const std::vector<CellId>& touched = cut_.cells().cells();
  std::vector<int> place(weights.cells().size(), -1);  // in touched; -1: no cell of this rank is near
  std::vector<double> share(weights.cells().size(), 0.0);
  for (std::size_t i = 0; i < weights.cells().size(); ++i) {
    const auto found = std::lower_bound(touched.begin(), touched.end(), weights.cells()[i]);
    if (found == touched.end() || *found != weights.cells()[i]) continue;
    place[i] = static_cast<int>(found - touched.begin());
    share[i] = cut_.remap().bulk_volume()[place[i]] / cut_.grid().cell_volume();
  }
  for (double& s : share) Foam::reduce(s, Foam::maxOp<double>());
  FluidWeights open;
  open.set(weights, std::move(share));
  if (!open.reaches(0)) open.set(weights);

  std::vector<double> totals(touched.size(), 0.0);
  open.for_each_cell(0, [&](int slot, double weight) {
    if (place[slot] >= 0) totals[place[slot]] += volume * weight;
  });
  const std::vector<double> fraction = cut_.remap().to_fine(totals, 1);
  scalarField result(flow_.mesh.nCells());
  std::copy(fraction.begin(), fraction.end(), result.begin());
  return result;
}

}  // namespace demvof
