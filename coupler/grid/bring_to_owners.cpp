// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/grid/bring_to_owners.hpp"

#include <algorithm>
#include <numeric>

#include "coupler/grid/sparse_exchange.hpp"

namespace demvof {

CellValues<std::vector<double>> bring_rows(MPI_Comm world, const std::function<int(CellId)>& rank_of,
                                           const std::vector<CellId>& cells, const double* rows, int width) {
  const int words = 1 + width;  // cell number (exact in a double), row
  std::vector<std::size_t> order(cells.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return cells[a] < cells[b]; });

  std::vector<Parcel> parcels;
  for (const std::size_t i : order) {
    const int rank = rank_of(cells[i]);
    if (parcels.empty() || parcels.back().rank != rank) parcels.push_back({rank, {}});
    std::vector<double>& out = parcels.back().numbers;
    out.push_back(static_cast<double>(cells[i]));
    out.insert(out.end(), rows + i * width, rows + (i + 1) * width);
  }
  std::vector<double> in;
  for (const Parcel& parcel : exchange_with_unknown(world, std::move(parcels)))
    in.insert(in.end(), parcel.numbers.begin(), parcel.numbers.end());

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
