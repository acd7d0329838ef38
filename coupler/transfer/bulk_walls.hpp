// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "coupler/grid/bulk_cells.hpp"
#include "coupler/grid/bulk_grid.hpp"
#include "coupler/transfer/kernel_weights.hpp"

namespace demvof {

/// Walls of the fluid's mesh that lie on faces of a bulk cell, for the faces towards its lower neighbours: 1
/// where no fluid passes though both cells hold some, 0 elsewhere. Travels as a row of doubles.
struct BulkWalls {
  double x = 0, y = 0, z = 0;

  bool towards_lower(int axis) const { return (axis == 0 ? x : axis == 1 ? y : z) > 0; }
};

/// What the mesh leaves to the fluid of the bulk grid, on the owners' cells. A mesh that moves changes it.
struct Openings {
  CellValues<double> shares;    // of the cells that the mesh does not fill, in their volume, -
  CellValues<BulkWalls> walls;  // of the cells that have some
};

/// Takes the kernels' weights back that lie beyond a wall, as their mirror images: shares still add up to 1,
/// and particles spread evenly up to a wall stay even. The way to a cell leads from the particle's own along
/// x, then y, then z. walls: of the touched cells. positions: m, one per particle.
void mirror_at_walls(const BulkGrid& grid, const std::vector<BulkWalls>& walls, const Vec3* positions,
                     KernelWeights& weights);

}  // namespace demvof
