// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "coupler/grid/bulk_grid.hpp"
#include "coupler/grid/cell_block.hpp"
#include "coupler/transfer/mapping_parameters.hpp"
#include "coupler/transfer/mesh_cut.hpp"

namespace demvof {

/// True for the mappings that take values at points: inverse_distance, cell_point, cell_point_face. They do
/// not keep integrals.
inline bool interpolates(Mapping mapping) {
  return mapping != Mapping::nearest && mapping != Mapping::conservative;
}

/// Values at the centres of fine cells from the means q of the bulk cells around them; the paper's
/// strategies (section 6), on a Cartesian grid.
///
///   inverse_distance  sum q_c / |x - X_c| / sum 1 / |x - X_c| over the bulk cell of x and its face
///   neighbours cell_point        linear in the pyramids of a bulk cell's centre and its faces, whose corner
///   values are
///                     means of the bulk cells that meet there. At a wall, where only cells on one side
///                     meet, a corner has the value of half a cell further in: of first order there
///   cell_point_face   the same with a fifth node in the middle of each face, and with the boundary check:
///                     faces and corners at a wall have the linear continuation from inside
///
/// The last two are continuous between full cells, exact for linear fields inside, and so is the last one up
/// to the wall. It can go below the smallest mean there. Cells without fluid count as absent.
class BulkInterpolation {
 public:
  BulkInterpolation() = default;
  /// block: marks the bulk cells, with their slots; all 26 neighbours of a cell that holds a subcell are in
  /// it. volume: of the fluid in each slot, m3. centre: of the fine cells, m; subcells: of these fine cells.
  BulkInterpolation(Mapping mapping, const BulkGrid& grid, const CellBlock& block,
                    const std::vector<double>& volume, const std::vector<Vec3>& centre,
                    const std::vector<Subcell>& subcells);

  /// means: slots x width. Returns fine cells x width.
  std::vector<double> evaluate(const std::vector<double>& means, int width) const;

 private:
  std::vector<std::size_t> first_;  // fine cell i has entries first_[i] .. first_[i+1]-1
  std::vector<int> slot_;
  std::vector<double> weight_;
};

}  // namespace demvof
