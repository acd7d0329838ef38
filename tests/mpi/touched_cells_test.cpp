// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/grid/touched_cells.hpp"

#include <map>
#include <random>
#include <stdexcept>

#include "both_sides.hpp"

namespace demvof {
namespace {

using test::world;

// A value that every rank can work out for every other rank and cell; a multiple of 1/8, so that sums
// are exact in any order.
Vec3 value(int rank, CellId cell, unsigned seed) {
  const auto c = static_cast<double>(cell);
  return {(rank + 1) * 0.125 + c, 1000.0 * rank - c, static_cast<double>(seed % 64) / 8};
}

// The cells a rank touches: a random subset, known to all ranks.
std::vector<CellId> touched_by(int rank, CellId count, double share, unsigned seed) {
  std::mt19937 random(1000 * seed + rank);
  std::bernoulli_distribution touches(share);
  std::vector<CellId> cells;
  for (CellId cell = 0; cell < count; ++cell)
    if (touches(random)) cells.push_back(cell);
  return cells;
}

void expect_same(const Vec3& a, const Vec3& b, CellId cell) {
  EXPECT_EQ(a.x, b.x) << "cell " << cell;
  EXPECT_EQ(a.y, b.y) << "cell " << cell;
  EXPECT_EQ(a.z, b.z) << "cell " << cell;
}

TEST(TouchedCells, SumsOntoOwners) {
  for (const std::array<int, 3> grid : {std::array{1, 1, 1}, {1, 2, 1}, {20, 5, 5}})
    for (const double share : {0.0, 0.1, 0.9}) {
      const BulkPartition partition(grid, world().size());
      const CellId count = partition.cell_count();
      const unsigned seed = static_cast<unsigned>(count + 10 * share);
      std::map<CellId, Vec3> expected;  // serial reference, for the cells of this owner
      for (int rank = 0; rank < world().size(); ++rank)
        for (CellId cell : touched_by(rank, count, share, seed))
          if (partition.owner(cell) == world().rank()) expected[cell] += value(rank, cell, seed);

      const TouchedCells touched(world().comm(), partition, touched_by(world().rank(), count, share, seed));
      std::vector<Vec3> mine;
      for (CellId cell : touched.cells()) mine.push_back(value(world().rank(), cell, seed));
      const auto sums = touched.sum_to_owners(mine);
      ASSERT_EQ(sums.cells.size(), expected.size());
      ASSERT_EQ(sums.values.size(), expected.size());
      auto reference = expected.begin();
      for (std::size_t i = 0; i < sums.cells.size(); ++i, ++reference) {
        ASSERT_EQ(sums.cells[i], reference->first);
        expect_same(sums.values[i], reference->second, sums.cells[i]);
      }
    }
}

TEST(TouchedCells, FetchesFromOwnersAndFillsWhatIsAbsent) {
  const Vec3 absent{-1, -2, -3};
  const BulkPartition partition({10, 6, 5}, world().size());
  const auto present = [](CellId cell) { return cell % 3 != 0; };
  CellValues<Vec3> owned;
  for (const CellId cell : partition.cells(world().rank()))
    if (present(cell)) {
      owned.cells.push_back(cell);
      owned.values.push_back(value(world().rank(), cell, 1));
    }
  const TouchedCells touched(world().comm(), partition, touched_by(world().rank(), 300, 0.5, 7));
  const auto fetched = touched.fetch_from_owners(owned, absent);
  ASSERT_EQ(fetched.size(), touched.cells().size());
  for (std::size_t i = 0; i < fetched.size(); ++i) {
    const CellId cell = touched.cells()[i];
    expect_same(fetched[i], present(cell) ? value(partition.owner(cell), cell, 1) : absent, cell);
  }
}

TEST(TouchedCells, SumsInTheOrderOfRanks) {
  // 1e17 - 1e17 + 1 is 1 in this order only: each rank adds its own part to the same cell.
  const BulkPartition partition({1, 1, 1}, world().size());
  const TouchedCells touched(world().comm(), partition, {0});
  const auto part = [](int rank) { return rank == 0 ? 1e17 : rank == 1 ? -1e17 : 1.0; };
  double expected = 0;
  for (int rank = 0; rank < world().size(); ++rank) expected += part(rank);
  const auto sums = touched.sum_to_owners(std::vector<double>{part(world().rank())});
  ASSERT_EQ(sums.values.size(), partition.owner(0) == world().rank() ? 1u : 0u);
  for (const double sum : sums.values) EXPECT_EQ(sum, expected);
}

TEST(TouchedCells, RefusesAPartitionOfOtherRanks) {
  EXPECT_THROW(TouchedCells(world().comm(), BulkPartition({10, 1, 1}, world().size() + 1), {}),
               std::invalid_argument);
}

}  // namespace
}  // namespace demvof

int main(int argc, char** argv) {
  return demvof::test::run_both_sides(argc, argv);
}
