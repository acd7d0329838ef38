// SPDX-License-Identifier: GPL-3.0-or-later
// Solid fraction of the fine mesh, from the solid volume of the bulk cells (docs/theory.md).
//
// Where the surface cuts a bulk cell, what is wet is in the liquid and what is dry in the gas; a cell of one
// fluid has the profile of coupling.mapping.to_fine, and one goes over into the other.

#include <algorithm>
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

}  // namespace

CellValues<double> solid_volume(const CellValues<BulkParticles>& particles) {
  CellValues<double> volume{particles.cells, {}};
  for (const BulkParticles& cell : particles.values) volume.values.push_back(cell.solid_volume);
  return volume;
}

/// Per subcell of cut cells, -: the slope that the bulk cell would have without the surface, in the fluid
/// that most of it is full of and about the middle of that one, so that each fluid keeps its solid; less and
/// less of it towards a cell half full. A surface that comes or goes then takes the profile away, or brings
/// it, as slowly as it moves: at once, the fluid would have to move within a window.
std::vector<double> ParticlesToFine::profile_in_main_fluid(const std::vector<double>& whole,
                                                           const std::vector<SolidInFluids>& inside,
                                                           const std::vector<double>& liquid,
                                                           const std::vector<double>& gas) const {
  const std::vector<Subcell>& subcells = cut_.remap().subcells();
  const std::vector<double>& room = cut_.remap().bulk_volume();
  std::vector<double> mean(room.size(), 0.0), middle(room.size(), 0.0);
  for (std::size_t slot = 0; slot < room.size(); ++slot)
    if (room[slot] > 0) mean[slot] = whole[slot] / room[slot];
  std::vector<double> rise = cut_.remap().rises(subcells, mean, 1, Remap::Slope::limited);
  const auto main_fluid = [&](int slot) { return liquid[slot] >= gas[slot] ? 0 : 1; };
  const auto amount = [&](const Subcell& subcell) {
    return surface_.share(main_fluid(subcell.slot), subcell) * subcell.volume;
  };
  for (std::size_t i = 0; i < subcells.size(); ++i)
    if (surface_.is_cut(subcells[i].slot)) middle[subcells[i].slot] += amount(subcells[i]) * rise[i];
  middle = cut_.cells().fetch_from_owners(cut_.cells().sum_to_owners(middle), 0.0);
  for (std::size_t i = 0; i < subcells.size(); ++i) {
    const int slot = subcells[i].slot, k = main_fluid(slot);
    if (!surface_.is_cut(slot) || mean[slot] == 0) {
      rise[i] = 0;
      continue;
    }
    const double most = std::max(liquid[slot], gas[slot]),
                 solid = k == 0 ? inside[slot].liquid : inside[slot].gas;
    const double here = middle[slot] / most;
    const double part =
        (2 * most / room[slot] - 1) * std::min(1.0, solid / (mean[slot] + std::max(here, 0.0)));
    rise[i] = part * surface_.share(k, subcells[i]) * (rise[i] - here);
  }
  return rise;
}

/// volumes: solid volume by fluid and touched cell, m3.
std::vector<double> ParticlesToFine::solid_fraction(const std::vector<std::vector<double>>& volumes) {
  if (volumes.size() == 1) return cut_.remap().to_fine(volumes[0], 1);
  surface_.look();
  const std::vector<double>& room = cut_.remap().bulk_volume();
  const std::vector<double> liquid = surface_.volumes(0), gas = surface_.volumes(1);
  std::vector<double> whole(room.size());
  std::vector<char> flat(room.size());
  for (std::size_t slot = 0; slot < whole.size(); ++slot) {
    whole[slot] = volumes[0][slot] + volumes[1][slot];
    flat[slot] = surface_.is_cut(static_cast<int>(slot));
  }
  std::vector<double> fraction = cut_.remap().to_fine(whole, 1, flat);

  // In cut cells: solid fraction in liquid and gas less the mean of both, and the profile.
  std::vector<SolidInFluids> inside(room.size());
  for (std::size_t slot = 0; slot < inside.size(); ++slot) {
    if (!flat[slot] || whole[slot] == 0) continue;
    inside[slot] = solid_in_fluids(volumes[0][slot], volumes[1][slot], liquid[slot], gas[slot],
                                   coupling_.averaging.maximum_solid_fraction);
  }
  const std::vector<double> profile = profile_in_main_fluid(whole, inside, liquid, gas);
  const std::vector<Subcell>& subcells = cut_.remap().subcells();
  for (std::size_t i = 0; i < subcells.size(); ++i) {
    const Subcell& subcell = subcells[i];
    const SolidInFluids& solid = inside[subcell.slot];
    if (!flat[subcell.slot] || whole[subcell.slot] == 0) continue;
    const double share = subcell.volume / flow_.mesh.V()[subcell.fine];
    fraction[subcell.fine] +=
        share * (surface_.share(0, subcell) * solid.liquid + surface_.share(1, subcell) * solid.gas -
                 whole[subcell.slot] / room[subcell.slot] + profile[i]);
    spread_.moved_volume += solid.moved * subcell.volume / room[subcell.slot];
  }
  return fraction;
}

scalarField ParticlesToFine::void_fraction(double part) {
  spread_ = {};
  std::vector<std::vector<double>> volumes;
  for (std::size_t k = 0; k < state_.size(); ++k) {
    std::vector<double> here = cut_.cells().fetch_from_owners(solid_volume(state_[k].particles), 0.0);
    if (part < 1) {
      const std::vector<double> then = cut_.cells().fetch_from_owners(state_[k].before, 0.0);
      for (std::size_t slot = 0; slot < here.size(); ++slot)
        here[slot] = (1 - part) * then[slot] + part * here[slot];
    }
    volumes.push_back(std::move(here));
  }
  const std::vector<double> solid = solid_fraction(volumes);
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
