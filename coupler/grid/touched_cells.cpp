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

  // Owners hold contiguous blocks of cells, so sorted cells are sorted by owner.
  std::vector<Parcel> parcels;
  for (std::size_t first = 0; first < cells_.size(); first += to_owners_.back().count) {
    const int owner = partition.owner(cells_[first]);
    const auto begin = cells_.begin() + static_cast<std::ptrdiff_t>(first);
    const auto end = std::lower_bound(begin, cells_.end(), partition.end(owner));
    to_owners_.push_back({owner, first, static_cast<std::size_t>(end - begin)});
    parcels.push_back({owner, std::vector<double>(begin, end)});  // cell numbers are exact in a double
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
  std::vector<double> received(slot_.size() * width);
  exchange_with_known(world_, to_owners_, rows, from_touchers_, received.data(), width);
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

  std::vector<double> fetched(cells_.size() * width);
  exchange_with_known(world_, from_touchers_, answers.data(), to_owners_, fetched.data(), width);
  return fetched;
}

}  // namespace demvof
