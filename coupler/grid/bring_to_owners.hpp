// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <mpi.h>

#include <cstring>
#include <vector>

#include "coupler/grid/bulk_cells.hpp"
#include "coupler/grid/bulk_partition.hpp"

namespace demvof {

/// Rows of any number per cell, from the ranks that have them to the owners of the cells. Returned: sorted by
/// cell, rows of one cell in the order of ranks. Collective.
CellValues<std::vector<double>> bring_rows(MPI_Comm world, const BulkPartition& partition,
                                           const std::vector<CellId>& cells, const double* rows, int width);

/// The same for records; a cell stands in the list once per record.
template <class T>
CellValues<T> bring_to_owners(MPI_Comm world, const BulkPartition& partition, const CellValues<T>& mine) {
  const auto brought = bring_rows(world, partition, mine.cells,
                                  reinterpret_cast<const double*>(mine.values.data()), row_width<T>());
  CellValues<T> records{brought.cells, std::vector<T>(brought.cells.size())};
  for (std::size_t i = 0; i < records.cells.size(); ++i)
    std::memcpy(static_cast<void*>(&records.values[i]), brought.values[i].data(), sizeof(T));
  return records;
}

}  // namespace demvof
