// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/transfer/limit_solid.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numeric>
#include <random>

#include "tests/support/mpi_main.hpp"

namespace demvof {
namespace {

using Volumes = std::map<CellId, double>;

/// sum of q (R x) = sum of x (R^T q), and a uniform q stays uniform: particles gain what their cells lose.
void expect_transpose(MPI_Comm comm, const BulkGrid& grid, const BulkPartition& partition,
                      const Relocation& relocation) {
  int rank;
  MPI_Comm_rank(comm, &rank);
  struct Pair {
    double one = 0, other = 0;
  };
  CellValues<Pair> x, q;
  CellValues<double> uniform;
  for (const CellId cell : partition.cells(rank)) {
    const double number = static_cast<double>(cell);
    if (cell % 3 != 0) x.cells.push_back(cell), x.values.push_back({std::sin(number), std::cos(3 * number)});
    if (cell % 5 != 0) q.cells.push_back(cell), q.values.push_back({std::cos(number), std::sin(7 * number)});
    uniform.cells.push_back(cell), uniform.values.push_back(3);
  }
  const auto product = [comm](const CellValues<Pair>& a, const CellValues<Pair>& b) {
    Pair sum;
    for (std::size_t i = 0; i < a.cells.size(); ++i)
      if (const Pair* other = find(b, a.cells[i])) {
        sum.one += a.values[i].one * other->one;
        sum.other += a.values[i].other * other->other;
      }
    MPI_Allreduce(MPI_IN_PLACE, &sum.one, 2, MPI_DOUBLE, MPI_SUM, comm);
    return sum;
  };
  const Pair spread = product(relocation.spread(x), q), gathered = product(relocation.gather(q), x);
  EXPECT_NEAR(spread.one, gathered.one, 1e-12 * grid.cell_count());
  EXPECT_NEAR(spread.other, gathered.other, 1e-12 * grid.cell_count());
  for (const double value : relocation.gather(uniform).values) EXPECT_NEAR(value, 3, 1e-12);
}

/// Runs limit_solid on cells spread over the ranks of comm; all volumes afterwards, on every rank.
struct Outcome {
  Volumes volumes;
  SolidRelief relief;
};
Outcome limited(MPI_Comm comm, const BulkGrid& grid, double fraction, const Volumes& before,
                const Volumes& open_shares = {}) {
  int rank, ranks;
  MPI_Comm_rank(comm, &rank);
  MPI_Comm_size(comm, &ranks);
  const BulkPartition partition(grid.cells(), ranks);
  CellValues<BulkParticles> owned;
  for (const auto& [cell, volume] : before)
    if (partition.owner(cell) == rank) {
      owned.cells.push_back(cell);
      owned.values.emplace_back();
      owned.values.back().solid_volume = volume;
      owned.values.back().drag_factor = 7 * volume;
    }
  CellValues<double> open_share;
  for (const auto& [cell, share] : open_shares)
    if (partition.owner(cell) == rank) {
      open_share.cells.push_back(cell);
      open_share.values.push_back(share);
    }
  Outcome outcome;
  LimitedSolid limit = limit_solid(comm, grid, partition, fraction, open_share, owned);
  outcome.relief = limit.relief;
  if (!limit.relocation.empty()) {
    expect_transpose(comm, grid, partition, limit.relocation);
    owned = limit.relocation.spread(owned);
  }

  std::vector<double> all(grid.cell_count(), -1.0);
  CellId before_this = -1;
  for (std::size_t i = 0; i < owned.cells.size(); ++i) {
    EXPECT_LT(before_this, owned.cells[i]) << "sorted";
    before_this = owned.cells[i];
    EXPECT_EQ(partition.owner(owned.cells[i]), rank);
    all[owned.cells[i]] = owned.values[i].solid_volume;
    EXPECT_NEAR(owned.values[i].drag_factor, 7 * owned.values[i].solid_volume, 1e-12)
        << "what particles bring goes with their volume";
  }
  MPI_Allreduce(MPI_IN_PLACE, all.data(), static_cast<int>(all.size()), MPI_DOUBLE, MPI_MAX, comm);
  for (CellId cell = 0; cell < grid.cell_count(); ++cell)
    if (all[cell] >= 0) outcome.volumes[cell] = all[cell];
  return outcome;
}

double sum(const Volumes& volumes) {
  double total = 0;
  for (const auto& [cell, volume] : volumes) total += volume;
  return total;
}

TEST(LimitSolid, LeavesCellsBelowTheLimitAlone) {
  const BulkGrid grid({0, 0, 0}, {3, 3, 3}, {3, 3, 3});
  const Volumes before{{0, 0.74}, {13, 0.2}, {26, 0.5}};
  const Outcome outcome = limited(MPI_COMM_WORLD, grid, 0.74, before);
  EXPECT_EQ(outcome.volumes, before);
  EXPECT_EQ(outcome.relief.cells, 0);
  EXPECT_EQ(outcome.relief.volume, 0);
}

TEST(LimitSolid, TheExcessGoesInEqualSharesToNeighboursWithRoom) {
  const BulkGrid grid({0, 0, 0}, {3, 3, 3}, {3, 3, 3});
  const CellId centre = grid.id({1, 1, 1}), full = grid.id({2, 1, 1});
  const Outcome outcome =
      limited(MPI_COMM_WORLD, grid, 0.5, {{centre, 1.0}, {full, 0.5}, {grid.id({1, 0, 1}), 0.25}});
  EXPECT_EQ(outcome.volumes.size(), 7u);
  EXPECT_EQ(outcome.volumes.at(centre), 0.5);
  EXPECT_EQ(outcome.volumes.at(full), 0.5);
  EXPECT_DOUBLE_EQ(outcome.volumes.at(grid.id({0, 1, 1})), 0.1);
  EXPECT_DOUBLE_EQ(outcome.volumes.at(grid.id({1, 0, 1})), 0.35);
  EXPECT_DOUBLE_EQ(outcome.volumes.at(grid.id({1, 1, 2})), 0.1);
  EXPECT_EQ(outcome.relief.cells, 1);
  EXPECT_DOUBLE_EQ(outcome.relief.volume, 0.5);
  EXPECT_EQ(outcome.relief.not_placed, 0);
}

TEST(LimitSolid, ACellIsFullWhenItsOpenShareIs) {
  const BulkGrid grid({0, 0, 0}, {4, 1, 1}, {4, 1, 1});
  // A quarter of cell 1 is open, and nothing of cell 3.
  const Outcome outcome = limited(MPI_COMM_WORLD, grid, 0.5, {{1, 0.375}, {3, 0.25}}, {{1, 0.25}, {3, 0.0}});
  EXPECT_DOUBLE_EQ(outcome.volumes.at(0), 0.125);
  EXPECT_DOUBLE_EQ(outcome.volumes.at(1), 0.125);
  EXPECT_DOUBLE_EQ(outcome.volumes.at(2), 0.375);
  EXPECT_EQ(outcome.volumes.at(3), 0.0);
  EXPECT_EQ(outcome.relief.cells, 2);
  EXPECT_EQ(outcome.relief.not_placed, 0);
}

TEST(LimitSolid, ExcessInTheMiddleOfAFullRegionGetsOut) {
  const BulkGrid grid({0, 0, 0}, {7, 7, 7}, {7, 7, 7});
  Volumes before;
  for (int k = 1; k < 6; ++k)
    for (int j = 1; j < 6; ++j)
      for (int i = 1; i < 6; ++i) before[grid.id({i, j, k})] = 0.5;
  before[grid.id({3, 3, 3})] = 1.5;
  const Outcome outcome = limited(MPI_COMM_WORLD, grid, 0.5, before);
  EXPECT_EQ(outcome.relief.not_placed, 0);
  EXPECT_NEAR(sum(outcome.volumes), sum(before), 1e-12);
  for (const auto& [cell, volume] : outcome.volumes) EXPECT_LE(volume, 0.5 * (1 + 1e-12));
  // As symmetric as it began.
  for (const auto& [cell, volume] : outcome.volumes) {
    const auto [i, j, k] = grid.ijk(cell);
    EXPECT_NEAR(volume, outcome.volumes.at(grid.id({6 - i, k, j})), 1e-14);
  }
}

TEST(LimitSolid, RandomOverfullCellsConserveAndDoNotDependOnTheRanks) {
  for (const bool periodic : {false, true})
    for (const unsigned seed : {1u, 2u, 3u}) {
      const BulkGrid grid({0, 0, 0}, {1, 0.8, 1.2}, {10, 8, 12}, {periodic, periodic, false});
      std::mt19937 random(seed);
      std::uniform_real_distribution<> uniform(0, 1);
      Volumes before;
      for (CellId cell = 0; cell < grid.cell_count(); ++cell)
        if (uniform(random) < 0.4)
          before[cell] = grid.cell_volume() * (uniform(random) < 0.2 ? 4 : 0.6) * uniform(random);
      const Outcome spread = limited(MPI_COMM_WORLD, grid, 0.64, before);
      const Outcome alone = limited(MPI_COMM_SELF, grid, 0.64, before);
      EXPECT_EQ(spread.volumes, alone.volumes) << "to the last bit";
      EXPECT_GT(spread.relief.cells, 10);
      EXPECT_EQ(spread.relief.cells, alone.relief.cells);
      EXPECT_NEAR(sum(spread.volumes) / sum(before), 1, 1e-14);
      double excess = 0;
      for (const auto& [cell, volume] : before) excess += std::max(0.0, volume - 0.64 * grid.cell_volume());
      EXPECT_NEAR(spread.relief.volume / excess, 1, 1e-13);
      for (const auto& [cell, volume] : spread.volumes)
        EXPECT_LE(volume, 0.64 * grid.cell_volume() * (1 + 1e-12));
    }
}

/// Two cells of a film, overfull, with closed ones around them, and a full cell elsewhere that has room
/// beside it.
TEST(LimitSolid, NothingGoesWhereThereIsNoFluidOrRoundForEver) {
  const BulkGrid grid({0, 0, 0}, {8, 1, 1}, {8, 1, 1});
  const Volumes before{{1, 0.3}, {2, 0.2}, {6, 0.75}};
  const Volumes open{{0, 0.0}, {1, 0.25}, {2, 0.25}, {3, 0.0}, {4, 0.0}};
  const Outcome outcome = limited(MPI_COMM_WORLD, grid, 0.5, before, open);
  EXPECT_EQ(outcome.volumes.at(1), 0.3);
  EXPECT_EQ(outcome.volumes.at(2), 0.2);
  EXPECT_EQ(outcome.volumes.count(0) + outcome.volumes.count(3), 0u);
  EXPECT_DOUBLE_EQ(outcome.volumes.at(6), 0.5);
  EXPECT_DOUBLE_EQ(outcome.volumes.at(5), 0.125);
  EXPECT_DOUBLE_EQ(outcome.relief.volume, 0.25);
  EXPECT_DOUBLE_EQ(outcome.relief.not_placed, 0.25);
}

/// An overfull cell between a closed and a full one: all of it goes to the full one, and on to the next.
TEST(LimitSolid, AFullRegionGivesNothingToItsClosedNeighbours) {
  const BulkGrid grid({0, 0, 0}, {4, 1, 1}, {4, 1, 1});
  const Outcome outcome = limited(MPI_COMM_WORLD, grid, 0.5, {{1, 0.75}, {2, 0.5}}, {{0, 0.0}});
  EXPECT_EQ(outcome.volumes.count(0), 0u);
  EXPECT_NEAR(outcome.volumes.at(1), 0.5, 1e-12);
  EXPECT_NEAR(outcome.volumes.at(2), 0.5, 1e-12);
  EXPECT_NEAR(outcome.volumes.at(3), 0.25, 1e-12);
}

TEST(LimitSolid, SaysWhatTheGridHasNoRoomFor) {
  const BulkGrid grid({0, 0, 0}, {2, 1, 1}, {2, 1, 1});
  const Outcome outcome = limited(MPI_COMM_WORLD, grid, 0.5, {{0, 1.0}, {1, 0.25}});
  EXPECT_DOUBLE_EQ(outcome.relief.not_placed, 0.5);
  EXPECT_EQ(outcome.relief.volume, 0);
  EXPECT_EQ(outcome.volumes.at(0), 1.0);
}

}  // namespace
}  // namespace demvof
