// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/grid/bulk_partition.hpp"

#include <algorithm>

namespace demvof {
namespace {

/// Of all numbers of blocks that there are ranks and cells for, those whose largest block with one layer of
/// cells around it, which is what its owner holds, is smallest. Where several are, the one with most blocks.
std::array<int, 3> numbers_of_blocks(const std::array<int, 3>& cells, int ranks) {
  const auto edge = [&cells](int axis, int blocks) { return 3.0 + (cells[axis] - 1) / blocks; };
  std::array<int, 3> best{};
  double smallest = 0;
  for (int x = 1; x <= std::min(ranks, cells[0]); ++x)
    for (int y = 1; y <= std::min(ranks / x, cells[1]); ++y) {
      const int z = std::min(ranks / x / y, cells[2]);
      const double size = edge(0, x) * edge(1, y) * edge(2, z);
      const bool more_blocks = x * y * z > best[0] * best[1] * best[2];
      if (best[0] > 0 && !(size < smallest || (size == smallest && more_blocks))) continue;
      best = {x, y, z};
      smallest = size;
    }
  return best;
}

}  // namespace

CellId CellRange::size() const {
  CellId size = 1;
  for (int axis = 0; axis < 3; ++axis) size *= std::max(0, end[axis] - begin[axis]);
  return size;
}

BulkPartition::BulkPartition(const std::array<int, 3>& cells, int ranks, RankOrder order)
    : cells_(cells), blocks_(numbers_of_blocks(cells, ranks)), ranks_(ranks) {
  const auto [x, y, z] = blocks_;
  stride_ = order == RankOrder::x_fastest ? std::array{1, x, x * y} : std::array{y * z, z, 1};
}

int BulkPartition::rank_of(const std::array<int, 3>& block) const {
  return block[0] * stride_[0] + block[1] * stride_[1] + block[2] * stride_[2];
}

std::array<int, 3> BulkPartition::ijk(CellId cell) const {
  const CellId row = cell / cells_[0];
  return {static_cast<int>(cell % cells_[0]), static_cast<int>(row % cells_[1]),
          static_cast<int>(row / cells_[1])};
}

/// The last block that begins at or before the cell: floor(cells block / blocks) < index + 1.
std::array<int, 3> BulkPartition::block_of(const std::array<int, 3>& ijk) const {
  std::array<int, 3> block;
  for (int axis = 0; axis < 3; ++axis)
    block[axis] = static_cast<int>((blocks_[axis] * (CellId{ijk[axis]} + 1) - 1) / cells_[axis]);
  return block;
}

CellRange BulkPartition::range_of(const std::array<int, 3>& block) const {
  CellRange range;
  for (int axis = 0; axis < 3; ++axis) {
    range.begin[axis] = static_cast<int>(CellId{cells_[axis]} * block[axis] / blocks_[axis]);
    range.end[axis] = static_cast<int>(CellId{cells_[axis]} * (block[axis] + 1) / blocks_[axis]);
  }
  return range;
}

std::array<int, 3> BulkPartition::place_among_blocks(int rank) const {
  std::array<int, 3> place;
  for (int axis = 0; axis < 3; ++axis) place[axis] = rank / stride_[axis] % blocks_[axis];
  return place;
}

CellRange BulkPartition::block(int rank) const {
  return rank < owners() ? range_of(place_among_blocks(rank)) : CellRange{};
}

std::vector<CellId> BulkPartition::cells(int rank) const {
  const CellRange own = block(rank);
  std::vector<CellId> cells;
  cells.reserve(own.size());
  for (int k = own.begin[2]; k < own.end[2]; ++k)
    for (int j = own.begin[1]; j < own.end[1]; ++j)
      for (int i = own.begin[0]; i < own.end[0]; ++i)
        cells.push_back(i + CellId{cells_[0]} * (j + CellId{cells_[1]} * k));
  return cells;
}

int BulkPartition::owner(CellId cell) const {
  return rank_of(block_of(ijk(cell)));
}

CellId BulkPartition::place(CellId cell) const {
  const std::array<int, 3> at = ijk(cell);
  const CellRange own = range_of(block_of(at));
  CellId place = 0;
  for (int axis = 2; axis >= 0; --axis)
    place = place * (own.end[axis] - own.begin[axis]) + at[axis] - own.begin[axis];
  return place;
}

std::vector<int> BulkPartition::owners_within(const CellRange& range) const {
  std::vector<int> owners;
  if (range.size() == 0) return owners;
  const std::array<int, 3> first = block_of(range.begin),
                           last = block_of({range.end[0] - 1, range.end[1] - 1, range.end[2] - 1});
  for (int k = first[2]; k <= last[2]; ++k)
    for (int j = first[1]; j <= last[1]; ++j)
      for (int i = first[0]; i <= last[0]; ++i) owners.push_back(rank_of({i, j, k}));
  std::sort(owners.begin(), owners.end());
  return owners;
}

}  // namespace demvof
