// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "tests/mpi/averaging_kernels.hpp"

namespace demvof::test {
namespace {

TEST_F(AveragingKernels, DiffusionLeavesOutWhatTheMeshDoesNotFill) {
  const BulkGrid grid({0, 0, 0}, {6, 5, 7}, {6, 5, 7}, {false, true, false});
  int rank, ranks;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  const BulkPartition partition(grid.cells(), ranks);
  Diffusion diffusion(MPI_COMM_WORLD, grid, partition, 3);
  std::mt19937 random(7);
  std::uniform_real_distribution<> uniform(0, 1);
  CellValues<double> share, given, field;
  for (CellId cell = 0; cell < grid.cell_count(); ++cell) {
    const double open = uniform(random) < 0.5 ? 1 : std::max(0.0, uniform(random) - 0.3);
    const double value = uniform(random), other = uniform(random);
    if (partition.owner(cell) != rank) continue;
    share.cells.push_back(cell);
    share.values.push_back(open);
    given.values.push_back(value);
    field.values.push_back(other);
  }
  given.cells = field.cells = share.cells;
  diffusion.set_open_shares(share);
  const std::vector<double> spread = diffusion.spread(given).values,
                            gathered = diffusion.gather(field).values;
  double sums[4] = {};  // given, spread, <spread, field>, <given, gathered>
  for (std::size_t i = 0; i < spread.size(); ++i) {
    EXPECT_EQ(spread[i] > 0, share.values[i] > 0) << "nothing goes where nothing is open";
    sums[0] += given.values[i];
    sums[1] += spread[i];
    sums[2] += spread[i] * field.values[i];
    sums[3] += given.values[i] * gathered[i];
  }
  MPI_Allreduce(MPI_IN_PLACE, sums, 4, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
  EXPECT_NEAR(sums[2] / sums[3], 1, 1e-12);
  record([&](Record& r) {
    r.at_most("diffusion, cells in part outside the mesh: sum over what was deposited, less 1",
              std::abs(sums[1] / sums[0] - 1), 4.4e-15);
    r.at_most("diffusion, cells in part outside the mesh: sample against transposed deposit",
              std::abs(sums[2] / sums[3] - 1), 1e-12);
  });
}

TEST_F(AveragingKernels, DiffusionStaysBehindWalls) {
  int rank, ranks;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  std::mt19937 random(5);
  std::uniform_real_distribution<> uniform(0, 1);
  // Alone, and with cells that the fluid fills in part, as beside a surface.
  for (const int run : {0, 1, 2, 3}) {
    const bool periodic = run % 2 == 1, partly = run >= 2;
    const BulkGrid grid({0, 0, 0}, {0.08, 0.05, 0.06}, {8, 5, 6}, {periodic, false, periodic});
    const BulkPartition partition(grid.cells(), ranks);
    Diffusion diffusion(MPI_COMM_WORLD, grid, partition, 0.03);
    CellValues<BulkWalls> walls;
    CellValues<double> given, field, side, share;
    for (CellId cell = 0; cell < grid.cell_count(); ++cell) {
      const auto ijk = grid.ijk(cell);
      BulkWalls here;
      here.x = ijk[0] == 3 || ijk[0] == 0 || uniform(random) < 0.05;  // two rooms, and baffles
      here.y = uniform(random) < 0.1;
      const double value = uniform(random), other = uniform(random),
                   open = std::max(0.0, uniform(random) - 0.2);
      if (partition.owner(cell) != rank) continue;
      walls.cells.push_back(cell);
      walls.values.push_back(here);
      given.values.push_back(value);
      field.values.push_back(other);
      side.values.push_back(ijk[0] < 3);
      share.values.push_back(open);
    }
    given.cells = field.cells = side.cells = share.cells = walls.cells;
    const std::vector<double> without = diffusion.spread(given).values;
    diffusion.set_walls(walls);
    if (partly) diffusion.set_open_shares(share);
    const std::vector<double> spread = diffusion.spread(given).values,
                              gathered = diffusion.gather(field).values;
    double sums[6] = {};  // given, spread, in one room each; <spread, field>, <given, gathered>
    for (std::size_t i = 0; i < spread.size(); ++i) {
      sums[side.values[i] > 0 ? 0 : 2] += given.values[i];
      sums[side.values[i] > 0 ? 1 : 3] += spread[i];
      sums[4] += spread[i] * field.values[i];
      sums[5] += given.values[i] * gathered[i];
    }
    MPI_Allreduce(MPI_IN_PLACE, sums, 6, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
    EXPECT_NEAR(sums[1] / sums[0], 1, 1e-12);
    EXPECT_NEAR(sums[3] / sums[2], 1, 1e-12);
    EXPECT_NEAR(sums[4] / sums[5], 1, 1e-12);
    if (partly) continue;
    diffusion.set_walls({});
    EXPECT_EQ(diffusion.spread(given).values, without) << "walls that are gone";
  }
}

TEST_F(AveragingKernels, DiffusionInAFluidThatIsNowhereOrFarAway) {
  int rank, ranks;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  const BulkGrid grid({0, 0, 0}, {4, 1, 1}, {400, 2, 2}, {false, false, false});
  const BulkPartition partition(grid.cells(), ranks);
  for (const int wet : {0, 1, 4}) {  // cells along x that hold some
    Diffusion diffusion(MPI_COMM_WORLD, grid, partition, 0.01);
    CellValues<double> share, given, field;
    double total = 0;
    for (CellId cell = 0; cell < grid.cell_count(); ++cell) {
      const bool in_it = grid.ijk(cell)[0] < wet;
      total += in_it;
      if (partition.owner(cell) != rank) continue;
      share.cells.push_back(cell);
      share.values.push_back(in_it ? 0.5 : 0);
      given.values.push_back(in_it);
      field.values.push_back(3);
    }
    given.cells = field.cells = share.cells;
    diffusion.set_open_shares(share);
    double sum = 0;
    for (const double value : diffusion.spread(given).values) sum += value;
    MPI_Allreduce(MPI_IN_PLACE, &sum, 1, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
    EXPECT_NEAR(sum, total, 1e-12);
    const std::vector<double> gathered = diffusion.gather(field).values;
    for (std::size_t i = 0; i < gathered.size(); ++i)
      EXPECT_TRUE(share.values[i] > 0 ? std::abs(gathered[i] - 3) < 1e-12
                                      : gathered[i] >= 0 && gathered[i] < 4)
          << gathered[i];
  }
}

TEST_F(AveragingKernels, DiffusionIsMirroredAtWallsAndNearTheGaussian) {
  std::mt19937 random(2);
  for (const double strength : {1e-3, 0.3, 40.0, 1e5})
    for (const int n : {1, 2, 7, 50}) {
      std::vector<double> row(n), twice(2 * n);
      for (int i = 0; i < n; ++i)
        row[i] = twice[i] = twice[2 * n - 1 - i] = std::uniform_real_distribution<>(0, 1)(random);
      const std::vector<double> before = row;
      RowDiffusion(n, strength, false).step(row.data(), 1);
      RowDiffusion(2 * n, strength, true).step(twice.data(), 1);
      for (int i = 0; i < n; ++i) {
        EXPECT_NEAR(row[i], twice[i], 1e-13);
        const double left = row[std::max(i - 1, 0)], right = row[std::min(i + 1, n - 1)];
        EXPECT_NEAR((1 + 2 * strength) * row[i] - strength * (left + right), before[i],
                    1e-13 * (1 + strength));
      }
    }

  // Distance from the Gaussian, half the integral of |difference|, on cells of a tenth of a standard
  // deviation.
  const int half = 60, n = 2 * half + 1;
  std::vector<double> steps, one, three;
  for (const int count : {1, 2, 3, 4, 6, 8, 12, 16}) {
    std::vector<double> row(n, 0.0), gauss(n);
    row[half] = 1;
    for (int step = 0; step < count; ++step) RowDiffusion(n, 50.0 / count, false).step(row.data(), 1);
    for (int i = 0; i < n; ++i)
      gauss[i] = 0.1 / std::sqrt(2 * pi) * std::exp(-0.005 * (i - half) * (i - half));
    double along = 0, in_space = 0;
    for (int i = 0; i < n; ++i) {
      along += 0.5 * std::abs(row[i] - gauss[i]);
      for (int j = 0; j < n; ++j)
        for (int k = 0; k < n; ++k)
          in_space += 0.5 * std::abs(row[i] * row[j] * row[k] - gauss[i] * gauss[j] * gauss[k]);
    }
    steps.push_back(count);
    one.push_back(along);
    three.push_back(in_space);
    if (count == diffusion_steps)
      record([&](Record& r) {
        r.at_most("diffusion: part of a particle that is elsewhere than in the Gaussian, in space", in_space,
                  0.15);
      });
  }
  record([&](Record& r) {
    r.note("diffusion: implicit steps", diffusion_steps);
    r.curve("diffusion: distance from the Gaussian", "implicit steps", "part that is elsewhere, -",
            "along an axis", steps, one, "xy");
    r.curve("diffusion: distance from the Gaussian", "implicit steps", "part that is elsewhere, -",
            "in space", steps, three, "xy");
  });
}

}  // namespace
}  // namespace demvof::test
