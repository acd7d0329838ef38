// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <mpi.h>

#include <cstring>
#include <vector>

#include "coupler/grid/bulk_cells.hpp"
#include "coupler/grid/bulk_partition.hpp"
#include "coupler/grid/sparse_exchange.hpp"

namespace demvof {

/// The bulk cells that this rank reads or writes, and the way between them and the ranks of the
/// same program that own them. Only touched cells are stored or sent, and only to the ranks concerned.
///
/// Construction and every call are collective over the communicator. Throws RunError when an MPI call
/// fails.
class TouchedCells {
 public:
  /// world: the ranks of the partition. cells: sorted, without repeats, any cells of the grid.
  TouchedCells(MPI_Comm world, const BulkPartition& partition, std::vector<CellId> cells);

  const std::vector<CellId>& cells() const { return cells_; }

  /// Sums what all ranks hold for a cell onto its owner. touched[i] belongs to cells()[i].
  /// Returns the cells of this owner that at least one rank touches. The order of summation is the
  /// order of ranks, so that results are reproducible.
  template <class T>
  CellValues<T> sum_to_owners(const std::vector<T>& touched) const {
    return {owned_, to_records<T>(sum_rows(to_rows(touched), row_width<T>()))};
  }

  /// The value of each touched cell as its owner has it; absent cells get the given default, which
  /// must be the same on all ranks. owned: any subset of this rank's own cells.
  template <class T>
  std::vector<T> fetch_from_owners(const CellValues<T>& owned, const T& absent) const {
    return to_records<T>(fetch_rows(owned.cells, to_rows(owned.values), row_width<T>(),
                                    reinterpret_cast<const double*>(&absent)));
  }

 private:
  template <class T>
  static const double* to_rows(const std::vector<T>& records) {
    return reinterpret_cast<const double*>(records.data());
  }
  template <class T>
  static std::vector<T> to_records(const std::vector<double>& rows) {
    std::vector<T> records(rows.size() / row_width<T>());
    if (!rows.empty())
      std::memcpy(static_cast<void*>(records.data()), rows.data(), sizeof(double) * rows.size());
    return records;
  }
  std::vector<double> sum_rows(const double* rows, int width) const;
  std::vector<double> fetch_rows(const std::vector<CellId>& owned, const double* rows, int width,
                                 const double* absent) const;

  MPI_Comm world_;
  std::vector<CellId> cells_;
  RowsByRank by_owner_;                    // the touched cells of this rank
  std::vector<RowsOfRank> from_touchers_;  // the cells of this rank as owner, by the rank that touches them
  std::vector<CellId> owned_;              // the union of those
  std::vector<std::size_t> slot_;          // of each of those in owned_
};

}  // namespace demvof
