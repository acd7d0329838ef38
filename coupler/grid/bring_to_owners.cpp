// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/grid/bring_to_owners.hpp"

#include <algorithm>
#include <numeric>

#include "coupler/base/mpi_check.hpp"

namespace demvof {

CellValues<std::vector<double>> bring_rows_to_owners(MPI_Comm world, const BulkPartition& partition,
                                                     const std::vector<CellId>& cells, const double* rows,
                                                     int width) {
  const int ranks = partition.ranks(), words = 1 + width;  // cell number (exact in a double), row
  std::vector<std::size_t> order(cells.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return cells[a] < cells[b]; });

  std::vector<double> out;
  std::vector<int> out_counts(ranks), out_starts(ranks), in_counts(ranks), in_starts(ranks);
  for (const std::size_t i : order) {
    out_counts[partition.owner(cells[i])] += words;
    out.push_back(static_cast<double>(cells[i]));
    out.insert(out.end(), rows + i * width, rows + (i + 1) * width);
  }
  check_mpi(MPI_Alltoall(out_counts.data(), 1, MPI_INT, in_counts.data(), 1, MPI_INT, world),
            "MPI_Alltoall of row counts");
  std::partial_sum(out_counts.begin(), out_counts.end() - 1, out_starts.begin() + 1);
  std::partial_sum(in_counts.begin(), in_counts.end() - 1, in_starts.begin() + 1);
  std::vector<double> in(in_starts.back() + in_counts.back());
  check_mpi(MPI_Alltoallv(out.data(), out_counts.data(), out_starts.data(), MPI_DOUBLE, in.data(),
                          in_counts.data(), in_starts.data(), MPI_DOUBLE, world),
            "MPI_Alltoallv of rows");

  order.resize(in.size() / words);
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return in[a * words] < in[b * words]; });
  CellValues<std::vector<double>> brought;
  for (const std::size_t i : order) {
    const double* row = in.data() + i * words;
    brought.cells.push_back(static_cast<CellId>(row[0]));
    brought.values.emplace_back(row + 1, row + words);
  }
  return brought;
}

}  // namespace demvof
