// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "coupler/exchange/exchange_parameters.hpp"
#include "foam_side/bulk_cut.hpp"
#include "foam_side/flow.hpp"
#include "foam_side/surface_to_bulk.hpp"

namespace demvof {

/// What the subcells of a bulk cell count in the force that they take from it and in what they tell it
/// (particles_to_fine.cpp, fluid_to_bulk.cpp), for the fluid as it is now. V: the volume of a subcell that
/// counts as fluid k, m3.
///
///                                                   force, velocity    density, viscosity    pressure
///                                                   gradient
///   mass, where the particles are                   psi rho V          psi V                 psi V
///   mass, elsewhere and where the surface cuts      eps rho_(k) V      eps V                 V
///   volume                                          V                  eps V                 V
///
/// psi = 1 - eps is the solid's own profile on the fine mesh: what the fluid of a bulk cell takes goes to
/// where the solid is that gives it, and the sum of psi V grad p is what the fluid's equations leave to the
/// particles. Where there is none (particles that have just come, no porosity) and where the surface cuts the
/// bulk cell, which has a flat profile there, every fine cell gets the same acceleration.
class SharingWeights {
 public:
  struct Of {
    double force = 0, property = 0, gradient = 0;
  };

  /// Collective over the fluid side.
  SharingWeights(const Flow& flow, const SurfaceToBulk& surface, const BulkCut& cut, Sharing sharing);

  /// Of a subcell, for fluid k.
  Of of(int k, const Subcell& subcell) const;
  /// Of a subcell, for the force on a fluid that has left the bulk cell: all that is there takes it.
  double of_any(const Subcell& subcell) const;

 private:
  double eps(const Subcell& subcell) const {
    return flow_.porosity ? flow_.porosity->eps[subcell.fine] : 1.0;
  }

  const Flow& flow_;
  const SurfaceToBulk& surface_;
  Sharing sharing_;
  std::vector<char> with_profile_;  // of the touched bulk cells
};

}  // namespace demvof
