// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <mpi.h>

#include <vector>

#include "coupler/grid/bulk_cells.hpp"

namespace demvof {

/// The bulk cells that this rank reads or writes, and the way between them and the ranks of the
/// same program that own them. Only touched cells are stored or sent.
///
/// Construction and every call are collective over the communicator.
class TouchedCells {
 public:
  /// cells: sorted, without repeats.
  TouchedCells(MPI_Comm world, const BulkPartition& partition, std::vector<CellId> cells);

  const std::vector<CellId>& cells() const { return cells_; }

  /// Sums what all ranks hold for a cell onto its owner. touched[i] belongs to cells()[i].
  /// Returns the cells of this owner that at least one rank touches. The order of summation is the
  /// order of ranks, so that results are reproducible.
  template <class T>
  CellValues<T> sum_to_owners(const std::vector<T>& touched) const;

  /// The value of each touched cell as its owner has it; absent cells get the given default.
  /// owned: any subset of this rank's own cells.
  template <class T>
  std::vector<T> fetch_from_owners(const CellValues<T>& owned, const T& absent) const;

 private:
  CellValues<double> sum_rows(const double* rows, int width) const;
  std::vector<double> fetch_rows(const std::vector<CellId>& owned, const double* rows, int width,
                                 const double* absent) const;
  MPI_Comm world_;
  BulkPartition partition_;
  std::vector<CellId> cells_;
  // plan members are the implementer's choice
};

}  // namespace demvof
