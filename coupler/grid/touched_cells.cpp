// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/grid/touched_cells.hpp"

#include <algorithm>
#include <stdexcept>

#include "coupler/base/mpi_check.hpp"

namespace demvof {

TouchedCells::TouchedCells(MPI_Comm world, const BulkPartition& partition, std::vector<CellId> cells)
    : world_(world), cells_(std::move(cells)) {
  int ranks = 0;
  check_mpi(MPI_Comm_size(world_, &ranks), "MPI_Comm_size");
  if (ranks != partition.ranks())
    throw std::invalid_argument("TouchedCells: the partition is of other ranks");

  by_owner_ = rows_by_rank(cells_.size(), [&](std::size_t i) { return partition.owner(cells_[i]); });
  std::vector<Parcel> parcels;
  for (const RowsOfRank& owners : by_owner_.of_rank) {
    std::vector<double>& numbers = parcels.emplace_back(Parcel{owners.rank, {}}).numbers;
    for (std::size_t at = owners.first; at < owners.first + owners.count; ++at)
      numbers.push_back(static_cast<double>(cells_[by_owner_.rows[at]]));  // exact in a double
  }
  std::vector<CellId> touched;
  for (const Parcel& parcel : exchange_with_unknown(world_, std::move(parcels))) {
    from_touchers_.push_back({parcel.rank, touched.size(), parcel.numbers.size()});
    for (const double cell : parcel.numbers) touched.push_back(static_cast<CellId>(cell));
  }
  owned_ = touched;
  std::sort(owned_.begin(), owned_.end());
  owned_.erase(std::unique(owned_.begin(), owned_.end()), owned_.end());
  slot_.reserve(touched.size());
  for (CellId cell : touched)
    slot_.push_back(std::lower_bound(owned_.begin(), owned_.end(), cell) - owned_.begin());
}

std::vector<double> TouchedCells::sum_rows(const double* rows, int width) const {
  std::vector<double> sent, received(slot_.size() * width);
  sent.reserve(cells_.size() * width);
  for (const std::size_t row : by_owner_.rows)
    sent.insert(sent.end(), rows + row * width, rows + (row + 1) * width);
  exchange_with_known(world_, by_owner_.of_rank, sent.data(), from_touchers_, received.data(), width);
  std::vector<double> sums(owned_.size() * width, 0.0);
  for (std::size_t i = 0; i < slot_.size(); ++i)  // by rank
    for (int k = 0; k < width; ++k) sums[slot_[i] * width + k] += received[i * width + k];
  return sums;
}

std::vector<double> TouchedCells::fetch_rows(const std::vector<CellId>& owned, const double* rows, int width,
                                             const double* absent) const {
  std::vector<const double*> row_of;  // for each cell of owned_
  row_of.reserve(owned_.size());
  for (CellId cell : owned_) {
    const auto found = std::lower_bound(owned.begin(), owned.end(), cell);
    const bool present = found != owned.end() && *found == cell;
    row_of.push_back(present ? rows + width * (found - owned.begin()) : absent);
  }
  std::vector<double> answers;
  answers.reserve(slot_.size() * width);
  for (const std::size_t slot : slot_) answers.insert(answers.end(), row_of[slot], row_of[slot] + width);

  std::vector<double> received(cells_.size() * width), fetched(received.size());
  exchange_with_known(world_, from_touchers_, answers.data(), by_owner_.of_rank, received.data(), width);
  for (std::size_t at = 0; at < by_owner_.rows.size(); ++at)
    std::copy_n(&received[at * width], width, &fetched[by_owner_.rows[at] * width]);
  return fetched;
}

}  // namespace demvof
