// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "coupler/grid/bulk_cells.hpp"
#include "coupler/grid/cell_block.hpp"
#include "coupler/grid/touched_cells.hpp"
#include "coupler/transfer/bulk_interpolation.hpp"
#include "coupler/transfer/limited_slopes.hpp"
#include "coupler/transfer/mapping_parameters.hpp"
#include "coupler/transfer/mesh_cut.hpp"

namespace demvof {

/// The way between this rank's fine mesh cells and the bulk grid. Built anew when the mesh changes.
///
/// mapping.to_fine   nearest       constant in each bulk cell; keeps the integral
///                   conservative  linear with limited slopes; keeps the integral
///                   others        interpolated to the fine cells' centres (bulk_interpolation.hpp); does not
/// mapping.to_bulk   nearest       fine cells stay whole, in the bulk cell of their centre
///                   others        fine cells are cut into subcells along the bulk grid, exactly
///
/// With `nearest` for both this is the paper's MAP. Sums over subcells keep the integral with every mapping.
///
/// Construction is collective over the communicator of the fluid side; the calls after it are local.
class Remap {
 public:
  Remap(MPI_Comm world, const BulkGrid& grid, const BulkPartition& partition, const FineMesh& mesh,
        const MappingParameters& mapping);

  /// Bulk cells that this rank's fine cells overlap, and all cells around these (faces, edges, corners).
  const TouchedCells& cells() const { return cells_; }
  /// In the order of the fine cells.
  const std::vector<Subcell>& subcells() const { return subcells_; }
  /// Fluid domain volume of each touched bulk cell (over all ranks), m3; 0 outside the mesh.
  const std::vector<double>& bulk_volume() const { return bulk_volume_; }
  /// Centroid of that domain, m; the cell's centre outside the mesh.
  const std::vector<Vec3>& bulk_centroid() const { return bulk_centroid_; }

  /// Density field on the fine cells from cell totals on the bulk grid (per unit volume).
  /// totals[slot*width + m]: extensive amounts per touched bulk cell, the same on every rank that touches
  /// the cell; returns fine cells x width. Over all ranks, sum over fine cells of V * result = sum of
  /// totals, and the subcells of each bulk cell receive exactly its total, to round-off. Totals of cells
  /// without fluid (bulk_volume 0) are not given to anybody. An interpolating mapping keeps none of these
  /// sums. Mapping::conservative: second order for smooth data; no value outside the range of the means in
  /// the bulk cell and the cells around it, so that totals >= 0 give a result >= 0.
  /// flat: per touched bulk cell, not 0: its subcells get its mean (conservative); empty: nowhere.
  std::vector<double> to_fine(const std::vector<double>& totals, int width,
                              const std::vector<char>& flat = {}) const;

  /// Of fields on the bulk cells (slots x width), how much each of some subcells is above its bulk cell's
  /// mean (subcells x width) by the mean slope of the cells around, or by that of to_fine. 0 where a bulk
  /// cell is a single subcell, and with other mappings than conservative.
  enum class Slope { mean, limited };
  std::vector<double> rises(const std::vector<Subcell>& subcells, const std::vector<double>& means, int width,
                            Slope kind = Slope::mean) const;

  /// This rank's part of sum over subcells of volume * weight_fine * value_subcell, per touched bulk cell
  /// (cells x width). The caller sums over ranks with cells().sum_to_owners.
  ///   value_subcell = value_fine + gradient_fine . offset of the subcell
  /// fine: fine cells x width; weight: per fine cell, or empty for 1; gradient: fine cells x width, or empty
  /// for 0. The sum over all bulk cells does not depend on the gradient; with it, each is of second order.
  std::vector<double> partial_sums(const std::vector<double>& fine, int width,
                                   const std::vector<double>& weight,
                                   const std::vector<Vec3>& gradient = {}) const;
  /// True when a fine cell of this rank lies in several bulk cells: only then a gradient changes anything.
  bool straddles() const { return straddles_; }

 private:
  struct Overlap {
    CutMesh cut;
    CellBlock block;
    std::vector<CellId> cells;
  };
  static Overlap find_overlap(const BulkGrid& grid, const FineMesh& mesh, Mapping to_bulk);
  Remap(MPI_Comm world, const BulkGrid& grid, const BulkPartition& partition, const FineMesh& mesh,
        Mapping to_fine, Overlap overlap);

  TouchedCells cells_;
  std::vector<Subcell> subcells_;
  std::vector<double> inverse_volume_;  // of the fine cells, 1/m3
  std::vector<double> bulk_volume_;
  std::vector<Vec3> bulk_centroid_;  // of the fluid domain in each touched bulk cell, m
  std::vector<int> slope_of_;        // slot -> index of its slope in slopes_, -1 for none
  LimitedSlopes slopes_;
  BulkInterpolation interpolation_;
  bool interpolates_, straddles_ = false;
};

}  // namespace demvof
