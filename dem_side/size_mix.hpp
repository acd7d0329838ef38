// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "coupler/closures/size_mix.hpp"
#include "coupler/transfer/averaging_in_fluid.hpp"
#include "dem_side/forces.hpp"
#include "dem_side/particle_arrays.hpp"

namespace demvof {

/// The mixture of sizes around each local particle in fluid k: sums of V, V/d and V d of what lies in that
/// fluid, on the bulk grid, with the weights of the last deposit there and back. Collective.
std::vector<SizeMix> sizes_around(const ParticleArrays& particles, const FluidForces& forces, int k,
                                  AveragingInFluid& averaging);

}  // namespace demvof
