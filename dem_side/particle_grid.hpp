// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "coupler/config/parameters.hpp"
#include "coupler/grid/bulk_grid.hpp"
#include "dem_side/dem.hpp"

namespace demvof {

/// The bulk grid as the particles see it: it wraps around where their box does. Collective.
/// Throws InputError when a periodic direction of the box is not that of the grid, or when a particle
/// lies outside the grid.
BulkGrid particle_grid(const BulkGridParameters& parameters, const Dem& dem);

}  // namespace demvof
