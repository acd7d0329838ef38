// SPDX-License-Identifier: GPL-3.0-or-later
// Owners of bulk cells: a cell with no owner or two, blocks of unequal size, slabs in place of blocks, and
// numbers beyond 32 bits.
#include "coupler/grid/bulk_partition.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace demvof {
namespace {

using Cells = std::array<int, 3>;

constexpr RankOrder x = RankOrder::x_fastest, z = RankOrder::z_fastest;
constexpr Cells grids[] = {{1, 1, 1}, {7, 1, 1}, {1, 1, 13}, {5, 1, 9}, {2, 3, 2}, {12, 12, 12}, {31, 7, 16}};

TEST(BulkPartition, EveryCellHasOneOwnerAndAPlaceThere) {
  for (const Cells& grid : grids)
    for (const auto& [ranks, order] : {std::pair{1, x},
                                       {2, x},
                                       {3, z},
                                       {4, z},
                                       {5, x},
                                       {7, z},
                                       {8, x},
                                       {13, z},
                                       {16, z},
                                       {97, x},
                                       {5000, z}}) {
      const BulkPartition partition(grid, ranks, order);
      ASSERT_LE(partition.owners(), ranks);
      std::vector<CellId> all;
      for (int rank = 0; rank < ranks; ++rank) {
        const std::vector<CellId> own = partition.cells(rank);
        ASSERT_EQ(own.empty(), rank >= partition.owners());
        ASSERT_EQ(partition.block(rank).size(), static_cast<CellId>(own.size()));
        ASSERT_TRUE(std::is_sorted(own.begin(), own.end()));
        for (std::size_t place = 0; place < own.size(); ++place) {
          ASSERT_EQ(partition.owner(own[place]), rank) << own[place] << " on " << ranks << " ranks";
          ASSERT_EQ(partition.place(own[place]), static_cast<CellId>(place));
        }
        all.insert(all.end(), own.begin(), own.end());
      }
      std::sort(all.begin(), all.end());
      ASSERT_EQ(static_cast<CellId>(all.size()), partition.cell_count());
      for (std::size_t cell = 0; cell < all.size(); ++cell) ASSERT_EQ(all[cell], static_cast<CellId>(cell));
    }
}

TEST(BulkPartition, WithMoreRanksThanCellsEveryCellIsItsOwnersOnlyOne) {
  for (const Cells& grid : grids) {
    const auto cells = static_cast<int>(CellRange{{}, grid}.size());
    for (const int ranks : {cells, cells + 1, 3 * cells})
      EXPECT_EQ(BulkPartition(grid, ranks).owners(), cells);
  }
}

/// Largest over mean number of cells of a rank, ranks without a block counted, and the layer of cells around
/// the largest block over that around a cube of as many cells.
struct Shape {
  double balance, surface;
};
Shape shape(const Cells& grid, int ranks) {
  const BulkPartition partition(grid, ranks);
  double size = 1, with_layer = 1;
  for (int axis = 0; axis < 3; ++axis) {
    const double edge = (grid[axis] - 1) / partition.blocks()[axis] + 1;
    size *= edge;
    with_layer *= edge + 2;
  }
  const double cube = std::cbrt(size) + 2;
  return {size * ranks / static_cast<double>(partition.cell_count()),
          (with_layer - size) / (cube * cube * cube - size)};
}

TEST(BulkPartition, BlocksAreNearlyEqualAndNearlyCubes) {
  EXPECT_EQ(BulkPartition({64, 64, 64}, 4096).blocks(), (Cells{16, 16, 16}));
  EXPECT_EQ(BulkPartition({4, 4, 32}, 8).blocks(), (Cells{1, 1, 8}));
  EXPECT_EQ(BulkPartition({20, 1, 30}, 6).blocks(), (Cells{2, 1, 3}));
  Shape worst{0, 0}, mean{0, 0};
  constexpr int most = 4096;
  for (int ranks = 1; ranks <= most; ++ranks) {
    const Shape here = shape({100, 100, 100}, ranks);
    worst = {std::max(worst.balance, here.balance), std::max(worst.surface, here.surface)};
    mean.balance += here.balance / most;
    mean.surface += here.surface / most;
  }
  std::printf("100^3 cells on 1 to %d ranks: balance %.3f, at most %.3f; surface %.3f, at most %.3f\n", most,
              mean.balance, worst.balance, mean.surface, worst.surface);
  EXPECT_LT(mean.balance, 1.3);
  EXPECT_LT(worst.balance, 1.6);
  EXPECT_LT(mean.surface, 1.1);
  EXPECT_LT(worst.surface, 1.6);
}

TEST(BulkPartition, RanksFollowEachOtherAsTheSolversDo) {
  const BulkPartition fluid({8, 12, 16}, 24, x), particles({8, 12, 16}, 24, z);
  ASSERT_EQ(fluid.blocks(), (Cells{2, 3, 4}));
  EXPECT_EQ(fluid.place_among_blocks(1 + 2 * 2 + 3 * 6), (Cells{1, 2, 3}));
  EXPECT_EQ(particles.place_among_blocks(3 + 2 * 4 + 1 * 12), (Cells{1, 2, 3}));
  EXPECT_EQ(fluid.place_among_blocks(1), (Cells{1, 0, 0}));
  EXPECT_EQ(particles.place_among_blocks(1), (Cells{0, 0, 1}));
}

TEST(BulkPartition, HoldsForGridsBeyond32Bits) {
  constexpr int most = std::numeric_limits<int>::max();
  for (const Cells& grid : {Cells{1 << 20, 1 << 20, 1 << 20}, {most, 1, 1}, {most, most, 1}, {1, 3, most}})
    for (const int ranks : {1, 7, 1000, 65536}) {
      const BulkPartition partition(grid, ranks);
      ASSERT_GT(partition.cell_count(), 0);
      for (const int rank : {0, ranks / 2, partition.owners() - 1}) {
        const CellRange block = partition.block(rank);
        if (block.size() == 0) continue;
        const auto id = [&grid](const Cells& ijk) {
          return ijk[0] + CellId{grid[0]} * (ijk[1] + CellId{grid[1]} * ijk[2]);
        };
        const CellId first = id(block.begin),
                     last = id({block.end[0] - 1, block.end[1] - 1, block.end[2] - 1});
        EXPECT_EQ(partition.owner(first), rank);
        EXPECT_EQ(partition.owner(last), rank);
        EXPECT_EQ(partition.place(first), 0);
        EXPECT_EQ(partition.place(last), block.size() - 1);
      }
    }
}

/// Who has cells of a block and as far as `reach` around it, as a rank that holds that part of the mesh or of
/// the particles would.
int receivers(const BulkPartition& partition, const Cells& grid, int rank, int reach) {
  CellRange reached = partition.block(rank);
  for (int axis = 0; axis < 3; ++axis) {
    reached.begin[axis] = std::max(0, reached.begin[axis] - reach);
    reached.end[axis] = std::min(grid[axis], reached.end[axis] + reach);
  }
  return static_cast<int>(partition.owners_within(reached).size()) - 1;
}

TEST(BulkPartition, ABlockHasAtMost26NeighboursOnAnyNumberOfRanks) {
  for (const Cells& grid : {Cells{64, 64, 64}, {250, 64, 30}, {3000, 20, 20}, {800, 1, 600}})
    for (int ranks = 1; ranks <= 4096; ranks += ranks < 300 ? 1 : 37)
      for (const int reach : {1, 2}) {
        const BulkPartition partition(grid, ranks);
        int most = 0;
        for (int rank = 0; rank < partition.owners(); ++rank)
          most = std::max(most, receivers(partition, grid, rank, reach));
        ASSERT_LE(most, grid[1] == 1 ? 8 : 26) << ranks << " ranks, reach " << reach;
      }
}

TEST(BulkPartition, OwnersWithinARangeAreThoseOfItsCells) {
  const Cells grid{9, 6, 11};
  for (const int ranks : {1, 6, 11, 30})
    for (const CellRange& range :
         {CellRange{{0, 0, 0}, {9, 6, 11}}, {{2, 3, 4}, {3, 4, 5}}, {{1, 1, 1}, {7, 3, 9}}}) {
      const BulkPartition partition(grid, ranks, z);
      std::vector<int> expected;
      for (int k = range.begin[2]; k < range.end[2]; ++k)
        for (int j = range.begin[1]; j < range.end[1]; ++j)
          for (int i = range.begin[0]; i < range.end[0]; ++i)
            expected.push_back(partition.owner(i + 9 * (j + 6 * k)));
      std::sort(expected.begin(), expected.end());
      expected.erase(std::unique(expected.begin(), expected.end()), expected.end());
      EXPECT_EQ(partition.owners_within(range), expected);
    }
  EXPECT_TRUE(BulkPartition(grid, 4).owners_within({{3, 3, 3}, {3, 5, 5}}).empty());
}

}  // namespace
}  // namespace demvof
