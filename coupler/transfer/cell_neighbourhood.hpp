// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <mpi.h>

#include <array>
#include <utility>
#include <vector>

#include "coupler/grid/bulk_cells.hpp"
#include "coupler/grid/touched_cells.hpp"
#include "coupler/transfer/bulk_walls.hpp"

namespace demvof {

/// All bulk cells of one rank, and the cells of other ranks beside them. Construction and share() are
/// collective.
class CellNeighbourhood {
 public:
  /// walls: faces that nothing goes through, of this rank's cells.
  CellNeighbourhood(MPI_Comm world, const BulkGrid& grid, const BulkPartition& partition,
                    const CellValues<BulkWalls>& walls);

  const std::vector<CellId>& cells() const { return own_; }
  /// Of one of them, in this list.
  std::size_t place(CellId cell) const { return static_cast<std::size_t>(partition_.place(cell)); }
  /// Slots of the face neighbours (-x, +x, -y, ...) of each of them, -1 beyond a wall or the grid's end.
  using Beside = std::array<int, 6>;
  const std::vector<Beside>& beside() const { return beside_; }
  /// Values of all own cells to values by slot.
  template <class T>
  std::vector<T> share(std::vector<T> own_values) const {
    return touched_.fetch_from_owners(CellValues<T>{own_, std::move(own_values)}, T{});
  }

 private:
  BulkPartition partition_;
  std::vector<CellId> own_;
  TouchedCells touched_;
  std::vector<Beside> beside_;
};

}  // namespace demvof
