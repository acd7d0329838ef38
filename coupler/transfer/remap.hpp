// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <vector>

#include "coupler/config/parameters.hpp"
#include "coupler/grid/bulk_cells.hpp"
#include "coupler/grid/touched_cells.hpp"

namespace demvof {

/// A polyhedral cell by its faces, each a list of corners ordered so that normals point outward.
struct Polyhedron {
  std::vector<std::vector<Vec3>> faces;
};

/// What the remap needs to know of this rank's fine mesh cells.
struct FineMesh {
  std::vector<double> volume;         // m3
  std::vector<Vec3> centre;           // centroid, m
  std::vector<Vec3> lower, upper;     // bounding box, m
  std::function<Polyhedron(int cell)> shape;  // called only for cells that straddle bulk cells
};

/// One piece: the part of a fine cell that lies in a bulk cell. The volumes of the pieces of a fine
/// cell add up to its volume to round-off.
struct Piece {
  int fine;       // fine cell
  int slot;       // index into Remap::cells().cells()
  double volume;  // m3
  Vec3 centroid;  // m
};

/// The way between this rank's fine mesh cells and the bulk grid. Built anew when the mesh changes.
///
/// Extensive data to the fine mesh keep their integral; means to the bulk grid are volume-weighted.
/// Construction and all calls are collective over the communicator of the fluid side.
class Remap {
 public:
  Remap(MPI_Comm world, const BulkGrid& grid, const BulkPartition& partition, const FineMesh& mesh,
        const MappingParameters& mapping);

  /// Bulk cells that this rank's fine cells overlap, and their face neighbours.
  const TouchedCells& cells() const { return cells_; }
  const std::vector<Piece>& pieces() const { return pieces_; }
  /// Fluid domain volume of each touched bulk cell (over all ranks), m3; 0 outside the mesh.
  const std::vector<double>& bulk_volume() const { return bulk_volume_; }

  /// Density field on the fine cells from cell totals on the bulk grid (per unit volume).
  /// totals[slot*width + m]: extensive amounts per touched bulk cell; returns fine cells x width.
  /// Mapping::nearest: constant in a bulk cell. Mapping::conservative: linear with limited slope and
  /// zero mean change. sum over fine cells of V * result = sum of totals, to round-off.
  std::vector<double> to_fine(const std::vector<double>& totals, int width) const;

  /// This rank's part of sum over pieces of volume * weight_fine * value_fine, per touched bulk cell
  /// (cells x width). The caller sums over ranks with cells().sum_to_owners.
  /// fine: fine cells x width; weight: per fine cell, or empty for 1.
  std::vector<double> partial_sums(const std::vector<double>& fine, int width,
                                   const std::vector<double>& weight) const;

 private:
  TouchedCells cells_;
  std::vector<Piece> pieces_;
  std::vector<double> bulk_volume_;
  // the rest is the implementer's choice
};

}  // namespace demvof
