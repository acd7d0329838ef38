// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <vector>

#include "coupler/grid/bulk_grid.hpp"

namespace demvof {

/// The bulk cells with indices begin <= ijk < end in each direction.
struct CellRange {
  std::array<int, 3> begin{}, end{};
  CellId size() const;
};

/// Along which axis ranks of a program follow each other: parts of OpenFOAM's `simple` along x, LIGGGHTS's
/// along z. Where a solver cuts as the blocks are cut, a rank then owns what its own part is in.
enum class RankOrder { x_fastest, z_fastest };

/// Which rank of one program owns which bulk cell: blocks, as near to cubes as the numbers of cells allow,
/// the first ranks one each. Everything follows from the grid's cells and the number of ranks, so
/// that each of two programs knows the other's owners as well. Ranks for which there is no block own nothing.
class BulkPartition {
 public:
  /// cells: of the grid, per direction, each >= 1. ranks: >= 1.
  BulkPartition(const std::array<int, 3>& cells, int ranks, RankOrder order = RankOrder::x_fastest);

  int ranks() const { return ranks_; }
  /// Number of blocks per direction, and of all: ranks 0 to owners() - 1 have one.
  const std::array<int, 3>& blocks() const { return blocks_; }
  int owners() const { return blocks_[0] * blocks_[1] * blocks_[2]; }
  CellId cell_count() const { return CellRange{{}, cells_}.size(); }

  /// Where a rank's block stands among the blocks, and its cells; of a rank without cells: none.
  std::array<int, 3> place_among_blocks(int rank) const;
  CellRange block(int rank) const;
  /// Its cells, sorted.
  std::vector<CellId> cells(int rank) const;
  int owner(CellId cell) const;
  /// Place of a cell among the sorted ones of its owner.
  CellId place(CellId cell) const;
  /// Owners of any of the cells of a range inside the grid, sorted.
  std::vector<int> owners_within(const CellRange& range) const;

 private:
  std::array<int, 3> ijk(CellId cell) const;
  std::array<int, 3> block_of(const std::array<int, 3>& ijk) const;
  CellRange range_of(const std::array<int, 3>& block) const;
  int rank_of(const std::array<int, 3>& block) const;

  std::array<int, 3> cells_, blocks_;
  std::array<int, 3> stride_;  // of ranks, from a block to the next one along each axis
  int ranks_;
};

}  // namespace demvof
