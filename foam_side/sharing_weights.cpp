// SPDX-License-Identifier: GPL-3.0-or-later
#include "foam_side/sharing_weights.hpp"

#include <algorithm>

namespace demvof {

namespace {

// Solid fraction of a bulk cell from which on it has a profile; less is round-off of the void fraction, or
// nothing that feels a force worth its place.
constexpr double least_solid = 1e-6;

}  // namespace

SharingWeights::SharingWeights(const Flow& flow, const SurfaceToBulk& surface, const BulkCut& cut,
                               Sharing sharing)
    : flow_(flow), surface_(surface), sharing_(sharing), with_profile_(cut.cells().cells().size(), 0) {
  if (sharing == Sharing::volume || !flow.porosity) return;
  struct Sums {
    double solid = 0, volume = 0;
  };
  std::vector<Sums> sums(with_profile_.size());
  for (const Subcell& subcell : cut.subcells()) {
    sums[subcell.slot].solid += std::max(0.0, 1 - eps(subcell)) * subcell.volume;
    sums[subcell.slot].volume += subcell.volume;
  }
  sums = cut.cells().fetch_from_owners(cut.cells().sum_to_owners(sums), Sums{});
  for (std::size_t slot = 0; slot < sums.size(); ++slot)
    with_profile_[slot] =
        sums[slot].solid > least_solid * sums[slot].volume && !surface.is_cut(static_cast<int>(slot));
}

SharingWeights::Of SharingWeights::of(int k, const Subcell& subcell) const {
  const double v = surface_.share(k, subcell) * subcell.volume, rho = flow_.rho[subcell.fine];
  if (with_profile_[subcell.slot]) {
    const double solid = std::max(0.0, 1 - eps(subcell)) * v;
    return {solid * rho, solid, solid};
  }
  const double fluid = eps(subcell) * v;
  if (sharing_ == Sharing::volume) return {v, fluid, v};
  return {surface_.is_cut(subcell.slot) ? fluid : rho * fluid, fluid, v};
}

double SharingWeights::of_any(const Subcell& subcell) const {
  return (sharing_ == Sharing::volume ? 1.0 : eps(subcell) * flow_.rho[subcell.fine]) * subcell.volume;
}

}  // namespace demvof
