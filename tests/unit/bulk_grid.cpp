// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/grid/bulk_grid.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace demvof {
namespace {

TEST(BulkGrid, NumbersCellsWithXFastest) {
  const BulkGrid grid({-1, 0, 2}, {3, 3, 4}, {4, 3, 2});
  EXPECT_EQ(grid.cell_count(), 24);
  EXPECT_DOUBLE_EQ(grid.cell_volume(), 1.0);
  CellId cell = 0;
  for (int k = 0; k < 2; ++k)
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 4; ++i, ++cell) {
        EXPECT_EQ(grid.id({i, j, k}), cell);
        EXPECT_EQ(grid.ijk(cell), (std::array<int, 3>{i, j, k}));
        EXPECT_EQ(grid.locate(grid.cell_centre({i, j, k})), (std::array<int, 3>{i, j, k}));
      }
  const Vec3 centre = grid.cell_centre({3, 0, 1});
  EXPECT_DOUBLE_EQ(centre.x, 2.5);
  EXPECT_DOUBLE_EQ(centre.y, 0.5);
  EXPECT_DOUBLE_EQ(centre.z, 3.5);
}

TEST(BulkGrid, PointsOutsideGoToTheNearestCell) {
  const BulkGrid grid({0, 0, 0}, {4, 4, 4}, {4, 4, 4});
  EXPECT_EQ(grid.locate({-1e30, 2.5, 7}), (std::array<int, 3>{0, 2, 3}));
  EXPECT_EQ(grid.locate({4, 0, std::numeric_limits<double>::infinity()}), (std::array<int, 3>{3, 0, 3}));
  EXPECT_TRUE(grid.contains({0, 4, 2}));
  EXPECT_FALSE(grid.contains({0, 4.001, 2}));
  EXPECT_FALSE(grid.contains({std::nan(""), 1, 2}));
}

TEST(BulkGrid, PeriodicDirectionsWrap) {
  const BulkGrid grid({0, 0, 0}, {4, 4, 4}, {4, 4, 4}, {true, false, true});
  EXPECT_EQ(grid.locate({-0.5, -0.5, 9.5}), (std::array<int, 3>{3, 0, 1}));
  EXPECT_EQ(grid.neighbour({0, 0, 0}, 0, -1), grid.id({3, 0, 0}));
  EXPECT_EQ(grid.neighbour({0, 0, 0}, 1, -1), -1);
  EXPECT_EQ(grid.neighbour({0, 0, 3}, 2, 1), grid.id({0, 0, 0}));
  EXPECT_EQ(grid.neighbour({0, 3, 0}, 1, 1), -1);
  EXPECT_EQ(grid.neighbour({1, 1, 1}, 1, 1), grid.id({1, 2, 1}));
}

TEST(BulkGrid, ImagesAreNearestWhereTheGridWraps) {
  const BulkGrid grid({0, 0, 0}, {4, 4, 4}, {4, 4, 4}, {true, false, true});
  const Vec3 image = grid.nearest_image({3.5, 3.5, 1}, {0.5, 0.5, 9.5});
  EXPECT_DOUBLE_EQ(image.x, -0.5);
  EXPECT_DOUBLE_EQ(image.y, 3.5);
  EXPECT_DOUBLE_EQ(image.z, 9);
}

TEST(BulkGrid, RejectsWhatIsNoGrid) {
  EXPECT_THROW(BulkGrid({0, 0, 0}, {1, 1, 1}, {1, 0, 1}), std::invalid_argument);
  EXPECT_THROW(BulkGrid({0, 0, 0}, {1, 1, 0}, {1, 1, 1}), std::invalid_argument);
  EXPECT_THROW(BulkGrid({0, 0, 0}, {1, std::nan(""), 1}, {1, 1, 1}), std::invalid_argument);
  EXPECT_THROW(BulkGrid({0, 0, 0}, {std::numeric_limits<double>::infinity(), 1, 1}, {1, 1, 1}),
               std::invalid_argument);
}

}  // namespace
}  // namespace demvof
