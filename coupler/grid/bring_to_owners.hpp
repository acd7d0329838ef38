// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <mpi.h>

#include <cstring>
#include <functional>
#include <vector>

#include "coupler/grid/bulk_cells.hpp"

namespace demvof {

/// Rows of any number per cell, from the ranks that have them to a rank for each cell. rank_of: of a cell; it
/// must not fall with the cell's number. Returned: sorted by cell, rows of one cell in the order of ranks.
/// Collective.
CellValues<std::vector<double>> bring_rows(MPI_Comm world, const std::function<int(CellId)>& rank_of,
                                           const std::vector<CellId>& cells, const double* rows, int width);

/// The same for records; a cell stands in the list once per record.
template <class T>
CellValues<T> bring_to(MPI_Comm world, const std::function<int(CellId)>& rank_of, const CellValues<T>& mine) {
  const auto brought = bring_rows(world, rank_of, mine.cells,
                                  reinterpret_cast<const double*>(mine.values.data()), row_width<T>());
  CellValues<T> records{brought.cells, std::vector<T>(brought.cells.size())};
  for (std::size_t i = 0; i < records.cells.size(); ++i)
    std::memcpy(static_cast<void*>(&records.values[i]), brought.values[i].data(), sizeof(T));
  return records;
}

/// To the owners of the cells.
template <class T>
CellValues<T> bring_to_owners(MPI_Comm world, const BulkPartition& partition, const CellValues<T>& mine) {
  return bring_to(
      world, [&](CellId cell) { return partition.owner(cell); }, mine);
}

}  // namespace demvof
