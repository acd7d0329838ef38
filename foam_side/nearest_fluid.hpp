// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "coupler/grid/bulk_cells.hpp"

namespace demvof {

/// Force on the fluid of a bulk cell. Travels as a row of doubles.
struct ForceOnCell {
  double cell = -1;
  Vec3 force;  // N
};

/// Forces of particles in bulk cells without fluid: the mesh has left them since. The fluid of the nearest
/// cell that has some takes each of them; nothing where there is none. alone, with_fluid: cells owned by this
/// rank. Collective over the fluid side; the same on every rank.
std::vector<ForceOnCell> to_nearest_fluid(const BulkGrid& grid, const std::vector<ForceOnCell>& alone,
                                          const std::vector<CellId>& with_fluid);

}  // namespace demvof
