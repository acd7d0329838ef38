// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/transfer/cell_neighbourhood.hpp"

#include <algorithm>

#include "coupler/base/mpi_check.hpp"

namespace demvof {
namespace {

std::vector<CellId> cells_of_this_rank(MPI_Comm world, const BulkPartition& partition) {
  int rank;
  check_mpi(MPI_Comm_rank(world, &rank), "MPI_Comm_rank");
  return partition.cells(rank);
}

CellId beside_face(const BulkGrid& grid, CellId cell, int face) {
  return grid.neighbour(grid.ijk(cell), face / 2, face % 2 ? 1 : -1);
}

std::vector<CellId> cells_around(const BulkGrid& grid, const std::vector<CellId>& own) {
  std::vector<CellId> cells;
  for (const CellId cell : own)
    for (int face = 0; face < 6; ++face)
      if (const CellId other = beside_face(grid, cell, face); other >= 0) cells.push_back(other);
  std::sort(cells.begin(), cells.end());
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  return cells;
}

}  // namespace

CellNeighbourhood::CellNeighbourhood(MPI_Comm world, const BulkGrid& grid, const BulkPartition& partition,
                                     const CellValues<BulkWalls>& walls)
    : partition_(partition),
      own_(cells_of_this_rank(world, partition)),
      touched_(world, partition, cells_around(grid, own_)) {
  const std::vector<BulkWalls> beside_walls = touched_.fetch_from_owners(walls, BulkWalls{});
  const auto slot = [this](CellId cell) {
    const std::vector<CellId>& cells = touched_.cells();
    return static_cast<int>(std::lower_bound(cells.begin(), cells.end(), cell) - cells.begin());
  };
  for (const CellId cell : own_) {
    Beside& cell_beside = beside_.emplace_back();
    const BulkWalls* own = find(walls, cell);
    for (int face = 0; face < 6; ++face) {
      const CellId other = beside_face(grid, cell, face);
      const bool upper = face % 2 == 1;
      const bool wall = other >= 0 && (upper ? beside_walls[slot(other)].towards_lower(face / 2)
                                             : own && own->towards_lower(face / 2));
      cell_beside[face] = other < 0 || wall ? -1 : slot(other);
    }
  }
}

}  // namespace demvof
