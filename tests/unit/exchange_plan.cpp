// SPDX-License-Identifier: GPL-3.0-or-later
// Who of one program talks to whom of the other: pairs that one side does not see, a rank that nobody talks
// to, cells that go no way or two.
#include "coupler/link/exchange_plan.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <utility>

namespace demvof {
namespace {

using Pairs = std::set<std::pair<int, int>>;  // rank here, rank there

Pairs seen_by(const BulkPartition& mine, const BulkPartition& theirs) {
  Pairs pairs;
  for (int rank = 0; rank < mine.ranks(); ++rank) {
    const std::vector<int> others = counterparts(mine, rank, theirs);
    EXPECT_FALSE(others.empty()) << "every rank hears from the partner";
    EXPECT_TRUE(std::is_sorted(others.begin(), others.end()));
    for (const int other : others) EXPECT_TRUE(pairs.emplace(rank, other).second);
  }
  return pairs;
}

Pairs turned(const Pairs& pairs) {
  Pairs back;
  for (const auto& [here, there] : pairs) back.emplace(there, here);
  return back;
}

CellId shared(const CellRange& a, const CellRange& b) {
  CellRange both;
  for (int axis = 0; axis < 3; ++axis) {
    both.begin[axis] = std::max(a.begin[axis], b.begin[axis]);
    both.end[axis] = std::min(a.end[axis], b.end[axis]);
  }
  return both.size();
}

void check(const std::array<int, 3>& grid, int here, int there) {
  SCOPED_TRACE(testing::Message() << grid[0] << " x " << grid[1] << " x " << grid[2] << " cells, " << here
                                  << " and " << there << " ranks");
  const BulkPartition mine(grid, here), theirs(grid, there, RankOrder::z_fastest);
  const Pairs pairs = seen_by(mine, theirs);
  EXPECT_EQ(pairs, turned(seen_by(theirs, mine)));
  CellId cells = 0;
  for (const auto& [a, b] : pairs) {
    const CellId both = shared(mine.block(a), theirs.block(b));
    EXPECT_TRUE(both > 0 || a >= mine.owners() || b >= theirs.owners()) << a << " has nothing for " << b;
    cells += both;
  }
  EXPECT_EQ(cells, mine.cell_count()) << "each cell goes one way";
}

TEST(ExchangePlan, EachCellGoesOneWayThatBothSidesKnow) {
  for (const std::array<int, 3>& grid : {std::array{1, 1, 1}, {3, 1, 1}, {1, 2, 5}, {4, 3, 2}, {7, 7, 7}})
    for (int here = 1; here <= 9; ++here)
      for (int there = 1; there <= 9; ++there) check(grid, here, there);
  for (const auto& [here, there] : {std::pair{4096, 1}, {1, 4093}, {4096, 4093}, {4096, 512}, {1009, 2048}})
    check({64, 48, 80}, here, there);
}

TEST(ExchangePlan, CellsMeetTheirOwner) {
  const BulkPartition mine({7, 5, 9}, 6), theirs({7, 5, 9}, 11);
  const Pairs pairs = seen_by(mine, theirs);
  for (CellId cell = 0; cell < mine.cell_count(); ++cell)
    EXPECT_EQ(pairs.count({mine.owner(cell), theirs.owner(cell)}), 1u) << cell;
}

TEST(ExchangePlan, AsManyRanksTalkToTheirLikesAlone) {
  for (const int ranks : {1, 7, 64, 4093})
    for (const auto& [here, there] :
         seen_by(BulkPartition({64, 64, 64}, ranks), BulkPartition({64, 64, 64}, ranks)))
      EXPECT_EQ(here % BulkPartition({64, 64, 64}, ranks).owners(),
                there % BulkPartition({64, 64, 64}, ranks).owners());
}

/// Twice as many ranks there, or a few more: still a few counterparts each.
TEST(ExchangePlan, CounterpartsDoNotGrowWithTheRanks) {
  for (const auto& [here, there] : {std::pair{512, 1024}, {2000, 4096}, {4096, 4093}, {1000, 1024}}) {
    const BulkPartition mine({128, 128, 128}, here), theirs({128, 128, 128}, there);
    for (int rank = 0; rank < here; ++rank) EXPECT_LE(counterparts(mine, rank, theirs).size(), 27u);
  }
}

}  // namespace
}  // namespace demvof
