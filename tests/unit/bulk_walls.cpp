// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/transfer/bulk_walls.hpp"

#include <gtest/gtest.h>

#include <map>

namespace demvof {
namespace {

using Wall = std::pair<std::array<int, 3>, int>;  // the cell above it, axis

/// Shares of one particle by cell, in a grid with walls.
std::map<std::array<int, 3>, double> shares(const BulkGrid& grid, Kernel kernel,
                                            const std::vector<Wall>& given, const Vec3& position) {
  AveragingParameters averaging;
  averaging.kernel = kernel;
  KernelWeights weights = kernel_weights(grid, averaging, {position}, {0.3});
  std::vector<BulkWalls> walls(weights.cells().size());
  for (const auto& [cell, axis] : given)
    for (std::size_t slot = 0; slot < walls.size(); ++slot)
      if (weights.cells()[slot] == grid.id(cell))
        (axis == 0 ? walls[slot].x : axis == 1 ? walls[slot].y : walls[slot].z) = 1;
  mirror_at_walls(grid, walls, &position, weights);
  std::map<std::array<int, 3>, double> result;
  double sum = 0;
  weights.for_each_cell(0, [&](int slot, double weight) {
    result[grid.ijk(weights.cells()[slot])] += weight;
    sum += weight;
  });
  EXPECT_NEAR(sum, 1, 1e-14);
  return result;
}

std::vector<Wall> plane(int i, const BulkGrid& grid) {
  std::vector<Wall> walls;
  for (int j = 0; j < grid.cells()[1]; ++j)
    for (int k = 0; k < grid.cells()[2]; ++k) walls.push_back({{i, j, k}, 0});
  return walls;
}

TEST(BulkWalls, LikeTheEndOfTheGrid) {
  const BulkGrid whole({0, 0, 0}, {6, 4, 4}, {6, 4, 4}), half({0, 0, 0}, {3, 4, 4}, {3, 4, 4});
  for (const Kernel kernel : {Kernel::volume, Kernel::linear, Kernel::gaussian})
    for (const double x : {2.99, 2.8, 2.5, 2.1, 1.4, 0.2}) {
      if (kernel == Kernel::volume && x > 2.7)
        continue;  // a sphere that a wall cuts: nothing to compare with
      const Vec3 position{x, 1.3, 2.2};
      auto walled = shares(whole, kernel, plane(3, whole), position);
      for (const auto& [cell, share] : shares(half, kernel, {}, position))
        EXPECT_NEAR(walled[cell], share, 1e-14) << cell[0] << ' ' << cell[1] << ' ' << cell[2] << " x " << x;
    }
}

TEST(BulkWalls, NothingArrivesOnTheOtherSide) {
  const BulkGrid grid({0, 0, 0}, {6, 4, 4}, {6, 4, 4});
  for (const Kernel kernel : {Kernel::volume, Kernel::linear, Kernel::gaussian})
    for (const double x : {3.01, 3.2, 2.99, 2.8, 4.1})
      for (const auto& [cell, share] : shares(grid, kernel, plane(3, grid), {x, 1.3, 2.2}))
        if ((cell[0] >= 3) != (x >= 3)) {
          EXPECT_EQ(share, 0);
        }
}

TEST(BulkWalls, ABaffleOfOneFace) {
  const BulkGrid grid({0, 0, 0}, {6, 4, 4}, {6, 4, 4});
  const std::vector<Wall> baffle{{{3, 1, 2}, 0}};
  const Vec3 position{2.9, 1.5, 2.5};
  auto open = shares(grid, Kernel::linear, {}, position),
       walled = shares(grid, Kernel::linear, baffle, position);
  EXPECT_GT((open[{3, 1, 2}]), 0.3);
  EXPECT_EQ((walled[{3, 1, 2}]), 0);
  EXPECT_NEAR((walled[{2, 1, 2}]), (open[{2, 1, 2}] + open[{3, 1, 2}]), 1e-14);
}

TEST(BulkWalls, BothSidesOfAChannelOneCellWide) {
  const BulkGrid grid({0, 0, 0}, {6, 4, 4}, {6, 4, 4});
  std::vector<Wall> walls = plane(2, grid);
  for (const Wall& wall : plane(3, grid)) walls.push_back(wall);
  for (const auto& [cell, share] : shares(grid, Kernel::gaussian, walls, {2.3, 2, 2}))
    if (cell[0] != 2) {
      EXPECT_EQ(share, 0);
    }
}

TEST(BulkWalls, AcrossAPeriodicEnd) {
  const BulkGrid grid({0, 0, 0}, {6, 4, 4}, {6, 4, 4}, {true, false, false});
  for (const auto& [cell, share] : shares(grid, Kernel::gaussian, plane(0, grid), {0.2, 2, 2}))
    if (cell[0] > 3) {
      EXPECT_EQ(share, 0);
    }
  auto through = shares(grid, Kernel::gaussian, plane(1, grid), {0.9, 2, 2});
  EXPECT_GT((through[{5, 2, 2}]), 0);
  EXPECT_EQ((through[{1, 2, 2}]), 0);
}

TEST(BulkWalls, NoWallsNoChange) {
  const BulkGrid grid({0, 0, 0}, {6, 4, 4}, {6, 4, 4});
  const std::vector<Vec3> positions{{1.2, 1.3, 1.4}, {5.9, 0.1, 2}};
  AveragingParameters averaging;
  KernelWeights weights = kernel_weights(grid, averaging, positions, {0.3, 0.3});
  const auto all = [&weights] {
    std::vector<double> found;
    for (int i = 0; i < 2; ++i)
      weights.for_each_cell(i, [&](int, double weight) { found.push_back(weight); });
    return found;
  };
  const std::vector<double> before = all();
  mirror_at_walls(grid, std::vector<BulkWalls>(weights.cells().size()), positions.data(), weights);
  EXPECT_EQ(all(), before);
}

}  // namespace
}  // namespace demvof
