// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/grid/bring_to_owners.hpp"

#include "both_sides.hpp"

namespace demvof {
namespace {

using test::world;

struct Mark {
  double rank, number;
};

// Rank r has (7 r + 3) % 5 records for each third cell, in falling order of cells.
CellValues<Mark> marks_of(int rank, CellId count) {
  CellValues<Mark> marks;
  for (CellId cell = count - 1; cell >= 0; --cell)
    for (int i = 0; cell % 3 == rank % 3 && i < (7 * rank + 3) % 5; ++i) {
      marks.cells.push_back(cell);
      marks.values.push_back({static_cast<double>(rank), static_cast<double>(i)});
    }
  return marks;
}

TEST(BringToOwners, BringsEveryRecordOnceInTheOrderOfRanks) {
  const int ranks = world().size(), me = world().rank();
  for (const std::array<int, 3> grid : {std::array{1, 1, 1}, {2, 1, 1}, {4, 5, 5}}) {
    const BulkPartition partition(grid, ranks);
    const CellId count = partition.cell_count();
    const auto brought = bring_to_owners(world().comm(), partition, marks_of(me, count));
    CellValues<Mark> expected;
    for (const CellId cell : partition.cells(me))
      for (int rank = 0; rank < ranks; ++rank) {
        const CellValues<Mark> theirs = marks_of(rank, count);
        for (std::size_t i = 0; i < theirs.cells.size(); ++i)
          if (theirs.cells[i] == cell) {
            expected.cells.push_back(cell);
            expected.values.push_back(theirs.values[i]);
          }
      }
    ASSERT_EQ(brought.cells, expected.cells);
    for (std::size_t i = 0; i < expected.cells.size(); ++i) {
      EXPECT_EQ(brought.values[i].rank, expected.values[i].rank);
      EXPECT_EQ(brought.values[i].number, expected.values[i].number);
    }
  }
}

}  // namespace
}  // namespace demvof

int main(int argc, char** argv) {
  return demvof::test::run_both_sides(argc, argv);
}
