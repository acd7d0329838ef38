// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/grid/bring_to_owners.hpp"

#include <algorithm>
#include <numeric>

#include "coupler/grid/sparse_exchange.hpp"

namespace demvof {

CellValues<std::vector<double>> bring_rows(MPI_Comm world, const BulkPartition& partition,
                                           const std::vector<CellId>& cells, const double* rows, int width) {
  const int words = 1 + width;  // cell number (exact in a double), row
  const RowsByRank by_owner =
      rows_by_rank(cells.size(), [&](std::size_t i) { return partition.owner(cells[i]); });
  std::vector<Parcel> parcels;
  for (const RowsOfRank& owners : by_owner.of_rank) {
    std::vector<double>& out = parcels.emplace_back(Parcel{owners.rank, {}}).numbers;
    for (std::size_t at = owners.first; at < owners.first + owners.count; ++at) {
      const std::size_t i = by_owner.rows[at];
      out.push_back(static_cast<double>(cells[i]));
      out.insert(out.end(), rows + i * width, rows + (i + 1) * width);
    }
  }
  std::vector<double> in;
  for (const Parcel& parcel : exchange_with_unknown(world, std::move(parcels)))
    in.insert(in.end(), parcel.numbers.begin(), parcel.numbers.end());

  std::vector<std::size_t> order(in.size() / words);
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
