// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/grid/touched_cells.hpp"

#include <algorithm>
#include <stdexcept>

#include "coupler/base/mpi_check.hpp"

namespace demvof {

void TouchedCells::Shares::find_starts() {
  for (std::size_t rank = 1; rank < counts.size(); ++rank) starts[rank] = starts[rank - 1] + counts[rank - 1];
}

TouchedCells::Shares TouchedCells::Shares::scaled(int width) const {
  Shares result = *this;
  for (int& count : result.counts) count *= width;
  for (int& start : result.starts) start *= width;
  return result;
}

TouchedCells::TouchedCells(MPI_Comm world, const BulkPartition& partition, std::vector<CellId> cells)
    : world_(world),
      cells_(std::move(cells)),
      to_owners_(partition.ranks()),
      from_touchers_(partition.ranks()) {
  int ranks = 0;
  check_mpi(MPI_Comm_size(world_, &ranks), "MPI_Comm_size");
  if (ranks != partition.ranks())
    throw std::invalid_argument("TouchedCells: the partition is of other ranks");

  // Owners hold contiguous blocks of cells, so sorted cells are sorted by owner.
  for (CellId cell : cells_) ++to_owners_.counts[partition.owner(cell)];
  to_owners_.find_starts();
  check_mpi(
      MPI_Alltoall(to_owners_.counts.data(), 1, MPI_INT, from_touchers_.counts.data(), 1, MPI_INT, world_),
      "MPI_Alltoall of cell counts");
  from_touchers_.find_starts();

  std::vector<CellId> touched(from_touchers_.total());
  check_mpi(MPI_Alltoallv(cells_.data(), to_owners_.counts.data(), to_owners_.starts.data(), MPI_INT64_T,
                          touched.data(), from_touchers_.counts.data(), from_touchers_.starts.data(),
                          MPI_INT64_T, world_),
            "MPI_Alltoallv of cell numbers");
  owned_ = touched;
  std::sort(owned_.begin(), owned_.end());
  owned_.erase(std::unique(owned_.begin(), owned_.end()), owned_.end());
  slot_.reserve(touched.size());
  for (CellId cell : touched)
    slot_.push_back(std::lower_bound(owned_.begin(), owned_.end(), cell) - owned_.begin());
}

std::vector<double> TouchedCells::sum_rows(const double* rows, int width) const {
  const Shares out = to_owners_.scaled(width), in = from_touchers_.scaled(width);
  std::vector<double> received(in.total());
  check_mpi(MPI_Alltoallv(rows, out.counts.data(), out.starts.data(), MPI_DOUBLE, received.data(),
                          in.counts.data(), in.starts.data(), MPI_DOUBLE, world_),
            "MPI_Alltoallv to owners");
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

  const Shares out = from_touchers_.scaled(width), in = to_owners_.scaled(width);
  std::vector<double> fetched(in.total());
  check_mpi(MPI_Alltoallv(answers.data(), out.counts.data(), out.starts.data(), MPI_DOUBLE, fetched.data(),
                          in.counts.data(), in.starts.data(), MPI_DOUBLE, world_),
            "MPI_Alltoallv from owners");
  return fetched;
}

}  // namespace demvof
