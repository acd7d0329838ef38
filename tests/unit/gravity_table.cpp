// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/exchange/gravity_table.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace demvof {
namespace {

/// Up, along and down again, with knots at 1, 2, 4 s.
const GravityTable table{{{1, {0, 0, -10}}, {2, {4, 0, -10}}, {4, {0, -8, -6}}}};

void expect_same(const Vec3& a, const Vec3& b) {
  for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(a[axis], b[axis], 2e-15 * (1 + std::abs(b[axis]))) << axis;
}

TEST(GravityTable, IsLinearBetweenItsRowsAndConstantOutside) {
  expect_same(table.at(-3), {0, 0, -10});
  expect_same(table.at(1), {0, 0, -10});
  expect_same(table.at(1.25), {1, 0, -10});
  expect_same(table.at(2), {4, 0, -10});
  expect_same(table.at(3), {2, -4, -8});
  expect_same(table.at(4), {0, -8, -6});
  expect_same(table.at(400), {0, -8, -6});
}

// Areas of triangles and rectangles, by hand.
TEST(GravityTable, HasTheExactMeanOverRowsOfAnyNumber) {
  expect_same(table.mean(1, 2), {2, 0, -10});
  expect_same(table.mean(2, 4), {2, -4, -8});
  expect_same(table.mean(1.5, 2), {3, 0, -10});
  expect_same(table.mean(1.5, 3), {(1.5 + 3) / 1.5, -2 / 1.5, (-5.0 - 9) / 1.5});
  expect_same(table.mean(0, 5), {(2.0 + 4) / 5, (-8.0 - 8) / 5, (-10.0 - 10 - 16 - 6) / 5});
  expect_same(table.mean(-7, 0.5), {0, 0, -10});
  expect_same(table.mean(4, 9), {0, -8, -6});
}

TEST(GravityTable, GivesOverManyWindowsWhatItGivesOverAll) {
  Vec3 sum;
  const double window = 5.0 / 37;
  for (int n = 0; n < 37; ++n) sum += window * table.mean(n * window, (n + 1) * window);
  expect_same(sum / 5, table.mean(0, 5));
}

TEST(GravityTable, IsConstantToTheLastBit) {
  const Vec3 g{0.1, -0.7, -9.81};
  for (const GravityTable& same : {GravityTable{{{0, g}}}, GravityTable{{{0, g}, {0.3, g}, {0.77, g}}}})
    for (const double begin : {-0.1, 0.0, 0.29, 0.7, 3.3}) {
      const Vec3 mean = same.mean(begin, begin + 0.1);
      EXPECT_EQ(mean.x, g.x);
      EXPECT_EQ(mean.y, g.y);
      EXPECT_EQ(mean.z, g.z);
    }
}

}  // namespace
}  // namespace demvof
